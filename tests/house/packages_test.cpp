// Rules of packages from npm: each is locked by its hash, and no script of one runs when it is installed.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/project_folder.h"

namespace {

namespace fs = std::filesystem;

const fs::path whole_tree = touchstone::project_folder;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The folders whose packages a lock file names.
std::vector<fs::path> locked_folders() {
  std::vector<fs::path> folders = {whole_tree / "plots/page"};
  for (const auto& entry : fs::directory_iterator(whole_tree / "datasets/adapters")) {
    if (fs::exists(entry.path() / "package.json")) folders.push_back(entry.path());
  }
  return folders;
}

// Whether the dependency names one version, such as "1.2.3" or "npm:name@1.2.3".
bool is_one_version(const std::string& dependency) {
  return std::regex_match(dependency, std::regex(R"((npm:.*@)?\d+\.\d+\.\d+[-.\w]*)"));
}

TEST(Packages, AreLockedByTheirHashes) {
  std::size_t packages = 0;
  for (const fs::path& folder : locked_folders()) {
    SCOPED_TRACE(folder);
    ASSERT_TRUE(fs::exists(folder / "package-lock.json"));
    const auto lock = nlohmann::json::parse(content_of(folder / "package-lock.json"));
    for (const auto& [place, package] : lock.at("packages").items()) {
      if (place.empty()) continue;
      ++packages;
      EXPECT_TRUE(package.value("integrity", "").starts_with("sha512-")) << place;
      const std::string from = package.value("resolved", "https://registry.npmjs.org/");
      EXPECT_TRUE(from.starts_with("https://registry.npmjs.org/")) << place << " from " << from;
    }
  }
  EXPECT_GT(packages, 50U);
}

TEST(Packages, OfAdaptersAreOneVersionEach) {
  std::size_t dependencies = 0;
  for (const fs::path& folder : locked_folders()) {
    if (folder.filename() == "page") continue;
    const auto package = nlohmann::json::parse(content_of(folder / "package.json"));
    for (const auto& [name, version] : package.at("dependencies").items()) {
      ++dependencies;
      EXPECT_TRUE(is_one_version(version)) << folder << " " << name << " " << version;
    }
  }
  EXPECT_GT(dependencies, 10U);
  EXPECT_FALSE(is_one_version("^1.2.3"));
  EXPECT_FALSE(is_one_version("npm:name@latest"));
}

TEST(Packages, RunNoScriptsWhenTheyAreInstalled) {
  std::vector<fs::path> files = {whole_tree / "plots/page/make"};
  for (const auto& entry : fs::directory_iterator(whole_tree / "datasets/adapters")) {
    for (const char* name : {"peer.toml", "README.md"}) {
      if (fs::exists(entry.path() / name)) files.push_back(entry.path() / name);
    }
  }
  files.push_back(whole_tree / "datasets/adapters/README.md");
  files.push_back(whole_tree / "results/versions.md");
  std::size_t lines = 0;
  for (const fs::path& file : files) {
    const std::string text = content_of(file);
    for (std::size_t at = 0; (at = text.find("npm ci", at)) != std::string::npos; ++at) {
      ++lines;
      EXPECT_EQ(text.substr(at, 23), "npm ci --ignore-scripts") << file;
    }
    EXPECT_EQ(text.find("npm install"), std::string::npos) << file << " installs without a lock";
  }
  EXPECT_GT(lines, 7U);
}

}  // namespace
