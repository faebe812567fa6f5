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
#include <string_view>
#include <vector>

#include "tests/project_folder.h"

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
    const fs::path root = touchstone::project_folder;
    static const std::regex include(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
    for (const char* folder : {"algorithms", "harness", "tests"}) {
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".h" && ending != ".cpp" && ending != ".inl") continue;
        SourceFile file{fs::relative(entry.path(), root).string(), "", {}, {}};
        std::ifstream stream(entry.path());
        bool in_text = false;  // of a program that is written, which is no part of this one
        for (std::string line; std::getline(stream, line);) {
          file.text += line + "\n";
          const bool begins = line.find("R\"test(") != std::string::npos;
          in_text = begins || (in_text && line.find(")test\"") == std::string::npos);
          if (in_text) continue;
          // The expression takes a thousand times as long to find that a line is of another kind.
          if (line.find("include") == std::string::npos) continue;
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
  static const std::set<std::string> contracts = {"broad_phase",
                                                  "narrow_phase",
                                                  "contact_manifold",
                                                  "ray_cast",
                                                  "point_query",
                                                  "mid_phase",
                                                  "concave_phase",
                                                  "cast",
                                                  "ccd",
                                                  "encoding",
                                                  "limit",
                                                  "algorithm_info",
                                                  "broad_phase_work",
                                                  "pair_query",
                                                  "signed_by_two",
                                                  "within_margin",
                                                  "moving_pairs",
                                                  "scene_ray_cast",
                                                  "mid_phase_of_bodies",
                                                  "configuration_query"};
  return path.starts_with("algorithms/") && path.ends_with(".h") &&
         contracts.contains(path.substr(11, path.size() - 13));
}

// The rooms of kernels, from the bottom up, each with those that it may include.
const std::map<std::string, std::set<std::string>> kernel_rooms = {
    {"simd", {}},
    {"sorting", {}},
    {"boxes", {"simd"}},
    {"grid", {"boxes", "sorting"}},
    {"bvh", {"boxes", "simd", "sorting"}},
    {"minkowski", {"simd"}},
    {"epa", {"minkowski", "simd"}},
    {"gjk", {"epa", "minkowski", "simd"}},
    {"mpr", {"gjk", "minkowski"}},
    {"sat", {"minkowski", "simd"}},
    {"batch", {"gjk", "minkowski", "simd"}},
    {"triangles", {"simd"}},
    {"features", {}},
    {"textbook", {}},
    {"rays", {"bvh", "simd"}},
    {"motion", {"epa", "gjk", "minkowski", "rays", "simd"}},
};

// The rooms of the harness, from the bottom up: each includes itself and those before it. They are the rows of the
// table in harness/README.md, whose first field is the room's name: "| `base` | ... |".
const std::vector<std::string>& harness_rooms() {
  static const std::vector<std::string> rooms = [] {
    std::vector<std::string> found;
    std::ifstream page(fs::path(touchstone::project_folder) / "harness/README.md");
    for (std::string line; std::getline(page, line);) {
      static const std::regex row("^\\| `([a-z_]+)` \\|.*");
      std::smatch match;
      if (std::regex_match(line, match, row)) found.push_back(match[1]);
    }
    return found;
  }();
  return rooms;
}

// The folders whose entries are algorithms: each a file, or a folder of files that are its own.
const std::set<std::string> algorithm_rooms = {
    "broad_phase", "narrow_phase", "manifold", "ray_cast",       "point_query",  "mid_phase",
    "concave",     "cast",         "ccd",      "scene_ray_cast", "configuration"};
bool is_in_algorithms(const std::string& path) {
  return std::ranges::any_of(algorithm_rooms,
                             [&](const auto& room) { return in(path, "algorithms/" + room); });
}

// The part of `path` that follows `folder`, up to the next slash: "simd" of
// "algorithms/kernels/simd/x.h" in "algorithms/kernels".
std::string room_in(const std::string& path, const std::string& folder) {
  const std::size_t begin = folder.size() + 1;
  const std::size_t end = path.find('/', begin);
  return end == std::string::npos ? "" : path.substr(begin, end - begin);
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

bool harness_may_include(const std::string& from, const std::string& to) {
  if (to == "algorithms/registry.h" || is_contract(to) || in(to, "algorithms/oracle") ||
      in(to, "algorithms/hull")) {
    return true;
  }
  if (in(to, "algorithms/kernels")) return from == "harness/bench/kernels.cpp";  // measures them
  if (in(to, "algorithms/module")) return in(from, "harness/modules");           // loads them
  if (!in(to, "harness")) return false;
  const auto floor = [](const std::string& path) {
    return std::ranges::find(harness_rooms(), room_in(path, "harness"));
  };
  if (from.starts_with("harness/main")) return in(to, "harness/commands");
  return floor(to) <= floor(from);
}

// Returns true if a file may include one of the project's own.
bool may_include(const std::string& from, const std::string& to) {
  if (in(from, "tests")) return true;
  if (in(from, "harness")) return in(to, "algorithms/core") || harness_may_include(from, to);
  if (in(to, "algorithms/core")) return true;
  if (in(from, "algorithms/core")) return false;
  if (in(from, "algorithms/hull")) return in(to, "algorithms/hull");
  if (in(from, "algorithms/oracle")) {
    // The oracle behind a contract is an algorithm.
    return in(to, "algorithms/oracle") ||
           (is_contract(to) && fs::path(from).filename().string().starts_with("exact") &&
            from.ends_with(".cpp"));
  }
  if (in(from, "algorithms/kernels")) {
    if (to == "algorithms/broad_phase_work.h") return true;  // counted where the work is done
    if (to == "algorithms/ray_cast.h") return in(from, "algorithms/kernels/rays");  // its rays
    if (to == "algorithms/cast.h")
      return in(from, "algorithms/kernels/motion");  // a cast of any step
    if (to == "algorithms/mid_phase_of_bodies.h")
      return from == "algorithms/kernels/bvh/volume_trees.h";  // a mid-phase of any volume
    if (!in(to, "algorithms/kernels")) return false;
    const std::string room = room_in(from, "algorithms/kernels");
    const std::string other = room_in(to, "algorithms/kernels");
    return room == other || kernel_rooms.at(room).contains(other);
  }
  // The library that installs stands on the registry, as the harness does. One file of it writes proofs.
  if (from == "algorithms/api/certificate.cpp" &&
      (to == "algorithms/oracle/oracle.h" || to == "algorithms/oracle/certificates/certificate.h"))
    return true;
  if (in(from, "algorithms/api")) {
    return in(to, "algorithms/api") || in(to, "algorithms/hull") || is_contract(to) ||
           to == "algorithms/registry.h";
  }
  if (is_contract(from)) return is_contract(to);
  if (from == "algorithms/registry.h") return is_contract(to);
  if (from == "algorithms/registry.cpp") return to == "algorithms/registry.h";
  if (is_contract(to)) return true;
  if (in(from, "algorithms/peers")) return in(to, "algorithms/peers") && to.ends_with(".h");
  // Asks the oracle where its doubles prove nothing. What the oracle grades is then its own answer:
  // that the doubles are never wrong is what is left to check of it.
  if (in(from, "algorithms/narrow_phase/certified") &&
      (to == "algorithms/oracle/answer.h" || to == "algorithms/oracle/solid.h")) {
    return true;
  }
  if (is_in_algorithms(from)) {
    return in(to, "algorithms/kernels") ||
           (folder_of(to) == folder_of(from) && !to.ends_with(".cpp"));
  }
  return (from == "algorithms/limit.cpp" || from == "algorithms/moving_pairs.cpp") &&
         in(to, "algorithms/kernels");
}

TEST(IncludeRule, EveryRoomIsInTheTable) {
  for (const SourceFile& file : files()) {
    if (in(file.path, "algorithms/kernels")) {
      EXPECT_TRUE(kernel_rooms.contains(room_in(file.path, "algorithms/kernels"))) << file.path;
    }
    if (in(file.path, "harness") && !file.path.starts_with("harness/main")) {
      EXPECT_THAT(harness_rooms(), testing::Contains(room_in(file.path, "harness"))) << file.path;
    }
  }
}

TEST(IncludeRule, TheTableNamesRoomsThatAreThere) {
  const fs::path harness = fs::path(touchstone::project_folder) / "harness";
  EXPECT_GT(harness_rooms().size(), 10u);
  for (const std::string& room : harness_rooms()) {
    EXPECT_TRUE(fs::is_directory(harness / room)) << room;
    EXPECT_TRUE(fs::exists(harness / room / "README.md")) << room;
  }
  const std::set<std::string> once(harness_rooms().begin(), harness_rooms().end());
  EXPECT_EQ(once.size(), harness_rooms().size());
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
  std::set<std::string> known = {"harness/record/build_info.h",
                                 "tests/project_folder.h"};  // written by CMake
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
    // Makes scenes by one of them, and compares nothing.
    if (in(file.path, "harness/simulate")) libraries.erase("bullet");
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

TEST(House, AnAlgorithmOfOneFileHasNoHeader) {
  for (const SourceFile& file : files()) {
    for (const std::string& room : algorithm_rooms) {
      if (folder_of(file.path) == "algorithms/" + room) {
        EXPECT_TRUE(file.path.ends_with(".cpp")) << file.path;
      }
    }
  }
}

// The name of the algorithm that a file is part of: "linear-bvh" for "linear_bvh.cpp".
std::string algorithm_of(const std::string& path) {
  const std::string contract = path.substr(0, path.find('/', sizeof "algorithms"));
  std::string name = room_in(path, contract);
  if (name.empty()) name = fs::path(path).stem();
  std::ranges::replace(name, '_', '-');
  return name;
}

TEST(House, AKernelRoomNamesItsUsers) {
  std::map<std::string, std::string> readmes;
  for (const auto& [room, below] : kernel_rooms) {
    std::ifstream stream(fs::path(touchstone::project_folder) / "algorithms/kernels" / room /
                         "README.md");
    for (std::string line; std::getline(stream, line);) readmes[room] += line + " ";
  }
  for (const SourceFile& file : files()) {
    if (!is_in_algorithms(file.path)) continue;
    const bool is_broad = in(file.path, "algorithms/broad_phase");
    for (const std::string& to : file.own) {
      if (!in(to, "algorithms/kernels")) continue;
      const std::string& readme = readmes[room_in(to, "algorithms/kernels")];
      EXPECT_THAT(readme, testing::AnyOf(testing::HasSubstr("`" + algorithm_of(file.path) + "`"),
                                         testing::HasSubstr(is_broad ? "all our broad phases"
                                                                     : "all our narrow phases")))
          << to << " is included by " << file.path;
    }
  }
}

// A file that is written by another way than OutputFile may be left in half, and its old content lost.
TEST(House, FilesAreWrittenInOneWay) {
  // OutputFile itself; the log of a child, whose output goes there as it comes; a shard's lock.
  const std::set<std::string> known = {"harness/files/output_file.cpp",
                                       "harness/process/subprocess.cpp",
                                       "harness/shards/shard_folder.cpp"};
  for (const SourceFile& file : files()) {
    if (in(file.path, "tests")) continue;
    bool writes = false;
    for (const char* way : {"ofstream", "std::fstream", "freopen(", "mkstemp(", "O_CREAT",
                            "write_to_file(", "write_to_stdio("}) {
      writes = writes || file.text.find(way) != std::string::npos;
    }
    for (std::size_t at = 0; (at = file.text.find("fopen(", at)) != std::string::npos; ++at) {
      const std::string call = file.text.substr(at, file.text.find(';', at) - at);
      const std::size_t mode = call.find(", \"");
      writes = writes || mode == std::string::npos || call[mode + 3] != 'r' ||
               call.substr(mode, call.find('"', mode + 3) - mode).find('+') != std::string::npos;
    }
    EXPECT_EQ(writes, known.contains(file.path)) << file.path;
  }
}

// Returns true for the file by which an algorithm or a peer is entered in the registry.
bool is_algorithm(const std::string& path) {
  if (in(path, "algorithms/peers")) return path.ends_with(".cpp");
  if (!is_in_algorithms(path) || !path.ends_with(".cpp")) return false;
  const fs::path file = path;
  const fs::path folder = file.parent_path().filename();
  return algorithm_rooms.contains(folder.string()) || folder == file.stem();
}

TEST(House, AnAlgorithmSaysWhatItIsBeforeItBegins) {
  for (const SourceFile& file : files()) {
    if (!is_algorithm(file.path)) continue;
    const std::string opening = file.text.substr(0, file.text.find("#include"));
    for (const char* heading : {"// Paper: ", "// Steps: ", "// Fails: ", "// Cost: "}) {
      // A peer's steps are its library's.
      if (std::string_view(heading) == "// Steps: " && in(file.path, "algorithms/peers")) continue;
      EXPECT_NE(opening.find(heading), std::string::npos) << file.path << " lacks " << heading;
    }
  }
}

}  // namespace
