// Rules of packages. Those from npm are locked by their hashes, and no script of one runs when it is installed. Those from
// Debian are in the table of licences.
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

// Finds the names behind each match of `from`, and expects them in the table.
std::size_t expect_licences(const std::string& table, const fs::path& file,
                            const std::regex& from) {
  static const std::regex word("[a-z0-9.+-]+");
  std::size_t packages = 0;
  const std::string text = content_of(file);
  for (std::sregex_iterator at(text.begin(), text.end(), from), end; at != end; ++at) {
    const std::string names = (*at)[1];
    for (std::sregex_iterator one(names.begin(), names.end(), word); one != end; ++one) {
      ++packages;
      EXPECT_NE(table.find("\n" + one->str() + ","), std::string::npos)
          << one->str() << " of " << file << " is not in harness/packaging/packages.csv";
    }
  }
  return packages;
}

TEST(Packages, HaveALicence) {
  const std::string table = content_of(whole_tree / "harness/packaging/packages.csv");
  EXPECT_GT(expect_licences(table, whole_tree / "touchstone",
                            std::regex("\n  '([a-z0-9.+-]+) +(?:header:|program:|matplotlib)")),
            30U);
  std::size_t named = 0;
  for (const char* folder : {"algorithms", "harness", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(whole_tree / folder)) {
      if (entry.path().filename() != "CMakeLists.txt") continue;
      named += expect_licences(table, entry.path(), std::regex(R"(\(Debian: ([a-z0-9.+, -]+)\))"));
    }
  }
  EXPECT_GT(named, 5U);
  std::size_t of_adapters = 0;
  for (const auto& entry : fs::directory_iterator(whole_tree / "datasets/adapters")) {
    if (!fs::exists(entry.path() / "peer.toml")) continue;
    of_adapters += expect_licences(table, entry.path() / "peer.toml",
                                   std::regex(R"re(\ninstall = "apt-get install ([^"]+)")re"));
  }
  EXPECT_GT(of_adapters, 1U);
}

}  // namespace
