// The main function that both executables share.
#include "harness/commands/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/base/error.h"
#include "harness/base/names.h"
#include "harness/base/nearest_name.h"
#include "harness/commands/commands.h"
#include "harness/process/standard_output.h"
#include "harness/record/build_info.h"
#include "harness/record/machine.h"

namespace touchstone::commands {
namespace {

std::string
    launcher;  // the file of what started this program; empty where that was not the launcher

bool is_whole = false;  // this program has all commands: it is `touchstone_more`, or installed

// Keeps the launcher from the programs that this one starts: another tree has another.
void take_launcher() {
  if (const char* const file = std::getenv("TOUCHSTONE_LAUNCHER")) launcher = file;
  unsetenv("TOUCHSTONE_LAUNCHER");
}

struct CommandRow {
  std::string_view program, name, heading, about;
};

constexpr std::array all_commands = std::to_array<CommandRow>({
#define TOUCHSTONE_COMMAND(program, name, takes, heading, about) {#program, #name, heading, about},
#include "harness/commands/commands.inl"
});

// Sets whether the program has every command that is not the launcher's.
void look_at_own(std::initializer_list<OwnCommand> own) {
  is_whole = std::ranges::all_of(all_commands, [&](const CommandRow& row) {
    return row.program == "launcher" ||
           std::ranges::find(own, row.name, &OwnCommand::name) != own.end();
  });
}

// Refuses a command that only the launcher has.
void refuse_launchers(std::string_view word) {
  const auto* const row = std::ranges::find(all_commands, word, &CommandRow::name);
  if (row == all_commands.end() || row->program != "launcher") return;
  throw base::InputError(
      fmt::format("`{}` needs the source tree; expected `./touchstone {}` there", word, word));
}

bool is_command(std::string_view word) {
  const auto* const row = std::ranges::find(all_commands, word, &CommandRow::name);
  return row != all_commands.end() && row->program != "launcher";
}

// Returns what to write instead of a command that was renamed, as its row has it, or an empty text.
std::string_view new_name([[maybe_unused]] std::string_view word) {
#define TOUCHSTONE_RENAMED(name, line) \
  if (word == #name) return line;
#include "harness/commands/commands.inl"
  return {};
}

std::vector<std::string> words_in(std::string_view text) {
  std::istringstream stream{std::string(text)};
  return {std::istream_iterator<std::string>(stream), {}};
}

// Returns whether the word is this option, alone or with its value.
bool is_option(std::string_view word, std::string_view option) {
  return word == option || (word.starts_with(option) && word.substr(option.size())[0] == '=');
}

// Returns the line to write instead of a renamed command and the words behind it.
std::string new_line(std::string_view name, std::vector<std::string> words) {
  const std::string_view row = new_name(name);
  if (row.find("...") == std::string_view::npos) return std::string(row);
  for (std::string& word : words) {
    const auto rename = [&](std::string_view options) {
      const std::vector<std::string> names = words_in(options);
      if (is_option(word, names[0])) word.replace(0, names[0].size(), names[1]);
    };
#define TOUCHSTONE_RENAMED_OPTION(old_name, options) \
  if (name == #old_name) rename(options);
#include "harness/commands/commands.inl"
  }
  std::string line;
  const auto add = [&](const std::string& word) { line += (line.empty() ? "" : " ") + word; };
  for (const std::string& part : words_in(row)) {
    if (part == "...") {
      for (const std::string& word : words) add(base::shell_word(word));
      continue;
    }
    const bool is_given =
        part.starts_with("--") &&
        std::ranges::any_of(words, [&](const auto& word) { return is_option(word, part); });
    if (!is_given) add(part);
  }
  return line;
}

// Removes the word that names the build of the program that runs this one, and compares the two.
void take_other_build(std::vector<std::string>& words) {
  if (words.empty() || !words.front().starts_with(record::of_build_option)) return;
  const std::string other = words.front().substr(record::of_build_option.size());
  if (other != record::build().id) {
    throw base::InputError(
        std::filesystem::read_symlink("/proc/self/exe").string(), 0,
        fmt::format("was built from other sources than the program that runs it (build {}, and not "
                    "{}); expected both of one build: the launcher, or `ninja touchstone "
                    "touchstone_more`, makes them",
                    record::build().id, other));
  }
  words.erase(words.begin());
}

// The version of the project, and the commit of the sources.
std::string version_text() {
  const record::Build& build = record::build();
  std::string text = fmt::format("touchstone {}", record::version);
  if (std::string_view(build.commit) == "unknown") return text;
  return fmt::format("{} (commit {:.12}{})", text, build.commit,
                     std::string_view(build.tree) == "changed" ? ", changed" : "");
}

int run_command(std::vector<std::string> words, std::initializer_list<OwnCommand> own) {
  take_other_build(words);
  const auto own_command = [&](std::string_view name) {
    return std::ranges::find(own, name, &OwnCommand::name);
  };
  const auto command = std::ranges::find_if(
      words, [](const std::string& word) { return is_command(word) || !new_name(word).empty(); });
  if (command != words.end()) {
    if (!is_command(*command)) {
      throw base::InputError(fmt::format("`{}` is now `touchstone {}`", *command,
                                         new_line(*command, {std::next(command), words.end()})));
    }
    if (own_command(*command) == own.end()) hand_over();
  } else if (!words.empty() && !words.front().starts_with('-')) {
    refuse_launchers(words.front());
    std::vector<std::string_view> names;
    for (const CommandRow& row : all_commands) names.push_back(row.name);
    throw base::InputError(base::unknown_name("command", words.front(), names));
  }

  CommandLine line("Touchstone: a benchmark of collision detection that checks what it measures");
  line.version(version_text());
  std::string isa_name = "best";
  Arguments everywhere = line.everywhere();
  everywhere
      .text("--isa", isa_name, "Vector instructions: best of this machine, or at most this level")
      .among({"baseline", "avx2", "avx512", "best"})
      .show_default();
  everywhere.before_commands([&] {
    if (isa_name == "baseline") limit_isa(Isa::baseline);
    if (isa_name == "avx2") limit_isa(Isa::avx2);
  });
  for (const CommandRow& row : all_commands) {
    if (row.program == "launcher") continue;
    const Arguments arguments =
        line.add_command(std::string(row.name), std::string(row.about), std::string(row.heading));
    const auto at = own_command(row.name);
    if (at != own.end()) at->add(arguments);
  }
  return line.run(words);
}

}  // namespace

std::string more_program() {
  if (is_whole) return std::filesystem::read_symlink("/proc/self/exe");
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "touchstone_more";
}

std::string more_first_word() {
  return fmt::format("{}{}", record::of_build_option, record::build().id);
}

void hand_over() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  std::string first = launcher.empty() ? more_first_word() : "--more";
  std::vector<char*> words;
  for (std::size_t i = 0; i < text.size(); i = text.find('\0', i) + 1) {
    words.push_back(&text[i]);
    if (i == 0) words.push_back(first.data());
  }
  words.push_back(nullptr);
  if (is_whole) {
    throw base::InputError("found a command of `touchstone`; expected another");
  }
  const std::string program = launcher.empty() ? more_program() : launcher;
  std::fflush(stdout);
  execv(program.c_str(), words.data());
  throw base::InputError(
      program, 0,
      fmt::format("cannot be run ({}); expected the second program of this build, which the "
                  "launcher makes",
                  std::strerror(errno)));
}

int run_program(int argc, char** argv, const record::Build& build,
                std::initializer_list<OwnCommand> own) {
  take_launcher();
  look_at_own(own);
  record::set_build(build);
  process::escape_output();
  try {
    const int status = run_command(std::vector<std::string>(argv + 1, argv + argc), own);
    return process::finish_output() ? status : exit_bad_request;
  } catch (const std::bad_alloc&) {
    std::fputs("touchstone: out of memory\n", stderr);
  } catch (const std::exception& error) {
    // fmt would throw if the write fails.
    std::fprintf(stderr, "touchstone: %s\n", error.what());
  }
  return exit_bad_request;
}

}  // namespace touchstone::commands
