// Every command and every name of an algorithm in the documentation is one that the program knows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/modules/file_word.h"
#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> documents() {
  const fs::path root = project_folder;
  std::vector<fs::path> all = {root / "README.md"};
  for (const char* folder : {"datasets", "results", "plots"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string path = entry.path().string();
      const bool is_ours = path.find("/local/") == std::string::npos &&
                           path.find("/node_modules/") == std::string::npos;
      if (entry.path().extension() == ".md" && is_ours) all.push_back(entry.path());
    }
  }
  return all;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The words of a line of the shell, without its quotes.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  char quote = 0;
  bool is_open = false;
  for (const char c : line) {
    if (c == '\\') continue;
    if (quote == 0 && (c == ' ' || c == '\n' || c == '\t')) {
      is_open = false;
      continue;
    }
    if (!is_open) words.emplace_back();
    is_open = true;
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else {
      words.back() += c;
    }
  }
  return words;
}

// What follows `touchstone` in code, within a line or in lines of their own.
std::vector<std::vector<std::string>> commands_in(const std::string& text) {
  static const std::regex inside("`(\\./)?touchstone +([^`]+)`");
  static const std::regex own_line("(^|\n)    (\\./)?touchstone +((.*\\\\\n)*.*)");
  std::vector<std::vector<std::string>> commands;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), inside);
       at != std::sregex_iterator(); ++at) {
    commands.push_back(words_of((*at)[2]));
  }
  for (auto at = std::sregex_iterator(text.begin(), text.end(), own_line);
       at != std::sregex_iterator(); ++at) {
    commands.push_back(words_of((*at)[3]));
  }
  return commands;
}

// The names of algorithms, of groups of them, of files of modules, and none.
bool is_known_name(const std::string& name) {
  static const std::set<std::string> names = [] {
    std::set<std::string> all = {"all", "ours", "libraries", "peers", "oracle", "modules", "none"};
    registry::for_each_kind([&]<class Entry>() {
      for (const Entry& entry : registry::entries<Entry>()) all.insert(entry.info.name);
    });
    return all;
  }();
  // Capitals are what a reader puts in.
  const bool is_placeholder = std::ranges::all_of(
      name, [](unsigned char c) { return std::isupper(c) != 0 || c == '_' || c == '.'; });
  return is_placeholder || modules::is_file(name) || names.contains(name);
}

void expect_names(const std::string& list, const std::string& where) {
  static const std::regex between("[,+]");
  for (auto at = std::sregex_token_iterator(list.begin(), list.end(), between, -1);
       at != std::sregex_token_iterator(); ++at) {
    EXPECT_TRUE(is_known_name(*at)) << *at << " in " << where;
  }
}

const std::string& help_of(const std::string& command) {
  static std::map<std::string, std::string> known;
  const auto [at, is_new] = known.try_emplace(command);
  if (is_new) {
    const Ran ran = run_program(command + " --help");
    EXPECT_EQ(ran.status, 0) << command;
    at->second = ran.text;
  }
  return at->second;
}

bool has_word(const std::string& text, const std::string& word) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const auto is_part = [&](std::size_t i) {
      return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 ||
                                 text[i] == '-' || text[i] == '_');
    };
    if (!is_part(at - 1) && !is_part(at + word.size())) return true;
  }
  return false;
}

TEST(DocumentedCommands, AreThoseOfTheProgram) {
  static const std::set<std::string> of_launcher = {"test", "setup", "bench"};
  static const std::set<std::string> takes_names = {
      "--with", "--narrow",     "--broad", "--concave", "--cast",
      "--ccd",  "--scene-rays", "--mid",   "--parts",   "--algorithm"};
  static const std::set<std::string> holds_others = {
#define TOUCHSTONE_NESTED(command, name, takes, about) #command,
#include "harness/commands/commands.inl"
  };
  int commands = 0, options = 0;
  for (const fs::path& file : documents()) {
    for (const std::vector<std::string>& words : commands_in(text_of(file))) {
      const std::string where = fmt::format("{}: {}", file.string(), fmt::join(words, " "));
      std::string command = words[0];
      if (of_launcher.contains(command) || !std::islower(static_cast<unsigned char>(command[0]))) {
        continue;
      }
      ++commands;
      if (!has_word(help_of(""), command)) {
        ADD_FAILURE() << "no such command: " << where;
        continue;
      }
      if (holds_others.contains(command)) {
        if (words.size() < 2 || !has_word(help_of(command), words[1])) {
          ADD_FAILURE() << "no such command of " << command << ": " << where;
          continue;
        }
        command += " " + words[1];
      }
      for (std::size_t i = 1; i < words.size(); ++i) {
        if (words[i].starts_with("datasets/")) {
          EXPECT_TRUE(fs::exists(fs::path(project_folder) / words[i])) << where;
        }
        if (!words[i].starts_with("--") || words[i].starts_with("--benchmark_")) continue;
        ++options;
        const std::string option = words[i].substr(0, words[i].find('='));
        EXPECT_TRUE(has_word(help_of(command), option)) << option << " in " << where;
        const bool is_of_names =
            takes_names.contains(option) ||
            (command == "check" && (option == "--rays" || option == "--points"));
        if (is_of_names && i + 1 < words.size()) expect_names(words[i + 1], where);
      }
    }
  }
  EXPECT_GT(commands, 80);
  EXPECT_GT(options, 60);
}

// In TOML: narrow = "certified", or broad = ["ours", "bullet"].
TEST(DocumentedCommands, FilesNameAlgorithmsThatExist) {
  static const std::regex key(
      "\\b(narrow|broad|concave|cast|casts|ccd|rays|points|scene-rays|mid_phases|algorithms|than)"
      " = (\"[^\"]*\"|\\[[^\\]]*\\])");
  static const std::regex quoted("\"([^\"]*)\"");
  int names = 0;
  for (const fs::path& file : documents()) {
    const std::string text = text_of(file);
    for (auto at = std::sregex_iterator(text.begin(), text.end(), key);
         at != std::sregex_iterator(); ++at) {
      const std::string value = (*at)[2];
      for (auto name = std::sregex_iterator(value.begin(), value.end(), quoted);
           name != std::sregex_iterator(); ++name) {
        ++names;
        expect_names((*name)[1], file.string() + ": " + at->str());
      }
    }
  }
  EXPECT_GT(names, 8);
}

}  // namespace
}  // namespace touchstone
