// The rule of who may include whom, and how a file opens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct SourceFile {
  std::string path;  // from the project's root
  std::string text;
  std::vector<std::string> own;    // included with quotes
  std::vector<std::string> other;  // included with angle brackets
};

const std::vector<SourceFile>& files() {
  static const std::vector<SourceFile> all = [] {
    std::vector<SourceFile> list;
    const fs::path root = TOUCHSTONE_SOURCE_DIR;
    static const std::regex include(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
    for (const char* folder : {"algorithms", "harness", "tests"}) {
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".h" && ending != ".cpp" && ending != ".inl") continue;
        SourceFile file{fs::relative(entry.path(), root).string(), "", {}, {}};
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);) {
          file.text += line + "\n";
          std::smatch match;
          if (std::regex_search(line, match, include)) {
            (match[1] == "\"" ? file.own : file.other).push_back(match[2]);
          }
        }
        list.push_back(std::move(file));
      }
    }
    return list;
  }();
  return all;
}

bool in(const std::string& path, const std::string& folder) {
  return path.starts_with(folder + "/");
}

bool is_contract(const std::string& path) {
  return path == "algorithms/broad_phase.h" || path == "algorithms/narrow_phase.h" ||
         path == "algorithms/contact_manifold.h" || path == "algorithms/algorithm_info.h" ||
         path == "algorithms/limit.h";
}

// Whether a file may include one of the project's own.
bool may_include(const std::string& from, const std::string& to) {
  if (in(to, "algorithms/core")) return true;
  if (in(from, "algorithms/oracle")) {
    return in(to, "algorithms/oracle") || (is_contract(to) && from.ends_with("/exact.cpp"));
  }
  if (in(from, "algorithms/core")) return false;
  if (is_contract(to)) return !in(from, "algorithms/kernels");
  if (is_contract(from)) return false;
  // Asks the oracle where its doubles prove nothing. What the oracle grades is then its own answer:
  // that the doubles are never wrong is what is left to check of it.
  if (from == "algorithms/narrow_phase/certified.cpp" && to == "algorithms/oracle/answer.h") {
    return true;
  }
  if (in(from, "algorithms/kernels") || in(from, "algorithms/broad_phase") ||
      in(from, "algorithms/narrow_phase") || in(from, "algorithms/manifold") ||
      from == "algorithms/limit.cpp") {
    return in(to, "algorithms/kernels");
  }
  if (in(from, "algorithms/peers")) return in(to, "algorithms/peers") && to.ends_with(".h");
  if (from == "algorithms/registry.h") return false;
  // The benchmarks of the kernels themselves.
  if (from == "harness/bench/kernels.cpp" && in(to, "algorithms/kernels")) return true;
  if (in(from, "harness")) {
    return to == "algorithms/registry.h" || in(to, "algorithms/oracle") || in(to, "harness");
  }
  return in(from, "tests");
}

TEST(IncludeRule, NobodyIncludesWhatIsNotForThem) {
  ASSERT_GT(files().size(), 20u);
  for (const SourceFile& file : files()) {
    for (const std::string& to : file.own) {
      EXPECT_TRUE(may_include(file.path, to)) << file.path << " includes " << to;
    }
  }
}

TEST(IncludeRule, IncludesAreWrittenFromTheRoot) {
  std::set<std::string> known = {"harness/run/build_info.h"};  // written by CMake
  for (const SourceFile& file : files()) known.insert(file.path);
  for (const SourceFile& file : files()) {
    for (const std::string& to : file.own) {
      EXPECT_TRUE(known.contains(to)) << file.path << " includes " << to;
    }
  }
}

// The libraries that a file includes itself.
std::set<std::string> libraries_of(const SourceFile& file) {
  std::set<std::string> libraries;
  for (const std::string& to : file.other) {
    const std::string first = to.substr(0, to.find('/'));
    if (first == "fcl" || first == "ccd" || first == "ode" || first == "mujoco" ||
        first == "embree3") {
      libraries.insert(first);
    }
    if (to.starts_with("boost/geometry")) libraries.insert("boost geometry");
    // A reference of the tests too.
    if (first == "CGAL" && !in(file.path, "tests")) libraries.insert("CGAL");
    if (first == "bullet" || to.starts_with("bt") || first == "BulletCollision" ||
        first == "LinearMath") {
      libraries.insert("bullet");
    }
  }
  return libraries;
}

TEST(IncludeRule, OnlyPeersIncludeTheLibrariesThatWeCompareWith) {
  // A peer has those of the peers' headers that it includes as well.
  std::map<std::string, std::set<std::string>> of_header;
  for (const SourceFile& file : files()) {
    if (file.path.ends_with(".h")) of_header[file.path] = libraries_of(file);
  }
  for (const SourceFile& file : files()) {
    std::set<std::string> libraries = libraries_of(file);
    for (const std::string& to : file.own) {
      if (of_header.contains(to)) libraries.insert(of_header[to].begin(), of_header[to].end());
    }
    if (!in(file.path, "algorithms/peers")) {
      EXPECT_THAT(libraries, testing::IsEmpty()) << file.path;
    }
    EXPECT_LE(libraries.size(), 1u) << file.path;
  }
}

TEST(IncludeRule, NoFileIncludesItselfInACircle) {
  std::map<std::string, const SourceFile*> by_path;
  for (const SourceFile& file : files()) by_path[file.path] = &file;
  std::set<std::string> done;
  std::vector<std::string> open;
  const std::function<void(const std::string&)> visit = [&](const std::string& path) {
    if (done.contains(path) || !by_path.contains(path)) return;
    ASSERT_EQ(std::ranges::find(open, path), open.end()) << "a circle through " << path;
    open.push_back(path);
    for (const std::string& to : by_path[path]->own) visit(to);
    open.pop_back();
    done.insert(path);
  };
  for (const SourceFile& file : files()) visit(file.path);
}

TEST(House, AnAlgorithmHasNoHeader) {
  for (const SourceFile& file : files()) {
    if (in(file.path, "algorithms/broad_phase") || in(file.path, "algorithms/narrow_phase") ||
        in(file.path, "algorithms/manifold")) {
      EXPECT_TRUE(file.path.ends_with(".cpp")) << file.path;
    }
    // What several peers share may have one.
    if (in(file.path, "algorithms/peers") && !file.path.ends_with(".cpp")) {
      EXPECT_EQ(file.text.find("TOUCHSTONE_BROAD_PHASE"), std::string::npos) << file.path;
      EXPECT_EQ(file.text.find("TOUCHSTONE_NARROW_PHASE"), std::string::npos) << file.path;
      EXPECT_EQ(file.text.find("TOUCHSTONE_CONTACT_MANIFOLD"), std::string::npos) << file.path;
    }
  }
}

TEST(House, AnAlgorithmSaysWhatItIsBeforeItBegins) {
  for (const SourceFile& file : files()) {
    const bool algorithm = in(file.path, "algorithms/broad_phase") ||
                           in(file.path, "algorithms/narrow_phase") ||
                           in(file.path, "algorithms/manifold") ||
                           (in(file.path, "algorithms/peers") && file.path.ends_with(".cpp"));
    if (!algorithm) continue;
    const std::string opening = file.text.substr(0, file.text.find("#include"));
    for (const char* heading : {"// Paper: ", "// Fails: ", "// Cost: "}) {
      EXPECT_NE(opening.find(heading), std::string::npos) << file.path << " lacks " << heading;
    }
  }
}

}  // namespace
