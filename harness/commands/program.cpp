// The main function that both executables share.
#include "harness/commands/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/base/error.h"
#include "harness/commands/commands.h"
#include "harness/process/standard_output.h"

namespace touchstone::commands {
namespace {

struct CommandName {
  const char* name;
  const char* about;
};

constexpr std::array all_commands = std::to_array<CommandName>({
    {"run", "Run a campaign: every scene through every algorithm, compared and timed"},
    {"compare", "Compare two results, or two builds of this program: is B slower than A?"},
    {"tables",
     "Write the tables of a results folder, or see whether those of a reference hold here"},
    {"check", "Grade every algorithm against exact answers, in regimes that are hard"},
    {"soak", "Count verdicts by the million against exact ones, in regimes that are hard"},
    {"stress",
     "Drive every narrow phase to where it breaks: scale, proportions, distance, gap, ..."},
    {"report", "Make a page of results and scenes that opens in a browser"},
    {"list", "List the algorithms, built or not"},
    {"query", "Ask narrow phases about pairs of bodies"},
    {"manifold", "The contact points of bodies that lie on each other"},
    {"rays", "Cast rays at a mesh or a scene"},
    {"points", "Find closest points of a mesh, and what is inside"},
    {"ccd",
     "When moving vertices, faces and edges meet: the contacts that are missed, and the time"},
    {"cast", "Ask casts when two moving bodies first touch"},
    {"pairs", "Find the pairs of boxes that overlap"},
    {"draw", "Draw a frame of a scene as a PNG"},
    {"record", "Write a scene's boxes as a recording"},
    {"trade", "Speed against accuracy on a scene: every configuration, and the Pareto front"},
    {"advise", "The cheapest configuration for a scene that is right enough, by measuring"},
    {"plan", "Cut a campaign, a check or a soak into shards for many machines"},
    {"status", "How far the shards of a plan are, and which failed"},
    {"merge", "Join the shards of a plan"},
    {"represent", "What stands for a scene's bodies, from ball to mesh, and how far off it is"},
});

bool is_command(std::string_view word) {
  return std::ranges::find(all_commands, word, &CommandName::name) != all_commands.end();
}

int run_command(const std::vector<std::string>& words, std::initializer_list<OwnCommand> own) {
  const auto command = std::ranges::find_if(words, is_command);
  const auto own_command = [&](std::string_view name) {
    return std::ranges::find(own, name, &OwnCommand::name);
  };
  if (command != words.end() && own_command(*command) == own.end()) hand_over();

  CommandLine line("Touchstone: a benchmark of collision detection that checks what it measures");
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
  for (const CommandName& name : all_commands) {
    const Arguments arguments = line.add_command(name.name, name.about);
    const auto at = own_command(name.name);
    if (at != own.end()) at->add(arguments);
  }
  return line.run(words);
}

}  // namespace

void hand_over() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  std::vector<char*> words;
  for (std::size_t i = 0; i < text.size(); i = text.find('\0', i) + 1) words.push_back(&text[i]);
  words.push_back(nullptr);
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path program = self.parent_path() / "touchstone_more";
  if (self == program) throw base::InputError("found a command of `touchstone`; expected another");
  std::fflush(stdout);
  execv(program.c_str(), words.data());
  throw base::InputError(
      program.string(), 0,
      fmt::format("cannot be run ({}); expected the executable of this command, which "
                  "the launcher builds",
                  std::strerror(errno)));
}

int run_program(int argc, char** argv, std::initializer_list<OwnCommand> own) {
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
