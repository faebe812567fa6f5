// Rules of the documentation: links lead to files, maps name files that are there, and results stay small.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "tests/project_folder.h"

namespace {

namespace fs = std::filesystem;

const fs::path root = touchstone::project_folder;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// True for folders that a build or a run fills.
bool is_made(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name == "local" || name == "node_modules" || name == "build" || name.starts_with(".");
}

// The files below the folder, relative to the project, whose names end so.
std::vector<fs::path> files_below(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator at(root / folder), end; at != end; ++at) {
    if (at->is_directory() && is_made(at->path())) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file() && at->path().string().ends_with(ending)) {
      files.push_back(fs::relative(at->path(), root));
    }
  }
  return files;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> all = {"README.md"};
  for (const char* folder : {"algorithms", "harness", "tests", "datasets", "plots", "results"}) {
    const std::vector<fs::path> below = files_below(folder, ".md");
    all.insert(all.end(), below.begin(), below.end());
  }
  return all;
}

TEST(Pages, LinksLeadToFiles) {
  const std::regex code("```[^`]*```");
  const std::regex link(R"re(\]\(([^)\s#]+)(#[^)\s]*)?\))re");
  std::size_t links = 0;
  for (const fs::path& page : pages()) {
    const std::string text = std::regex_replace(text_of(root / page), code, "");
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      const std::string target = (*at)[1];
      if (target.find("://") != std::string::npos) continue;
      ++links;
      EXPECT_TRUE(fs::exists(root / page.parent_path() / target)) << page << " links to " << target;
    }
  }
  EXPECT_GT(links, 100u);
}

// The last field of a row of a map is `code` names of files, below the row's room or beside the map.
TEST(Pages, MapsNameFilesThatAreThere) {
  const std::regex row(R"re(^\| `([a-z_/]+)`[^|]*\|.*\| ([^|]*`) \|$)re");
  const std::regex name("`([^`]+)`");
  for (const char* folder : {"harness", "tests"}) {
    std::ifstream map(root / folder / "README.md");
    std::size_t names = 0;
    for (std::string line; std::getline(map, line);) {
      std::smatch fields;
      if (!std::regex_match(line, fields, row)) continue;
      const std::string room = fields[1], files = fields[2];
      for (std::sregex_iterator at(files.begin(), files.end(), name), end; at != end; ++at) {
        ++names;
        const std::string file = (*at)[1];
        EXPECT_TRUE(fs::exists(root / folder / room / file) || fs::exists(root / folder / file))
            << folder << "/README.md, " << room << ": " << file;
      }
    }
    EXPECT_GT(names, 10u) << folder;
  }
}

TEST(Pages, ResultsAreOnTheirPageAndSmall) {
  const std::string page = text_of(root / "results/README.md");
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(root / "results")) {
    if (is_made(entry.path()) || entry.path().filename() == "README.md") continue;
    const std::string name = entry.path().filename().string();
    EXPECT_NE(page.find("](" + name), std::string::npos) << "results/" << name;
  }
  for (const fs::path& file : files_below("results", "")) bytes += fs::file_size(root / file);
  EXPECT_LE(bytes, 20'000'000u);
}

}  // namespace
