// Pairs written as tests of libraries: they compile by themselves, fail where the library is wrong, and pass where it
// is right.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

constexpr const char* boxes_that_overlap =
    R"({"id":"deep","a":{"shape":{"type":"box","half_extents":[1,1,1]}},)"
    R"("b":{"shape":{"type":"box","half_extents":[1,1,1]},"translation":[1.5,0.25,0.5]}})";

// Two cubes as hulls, this far apart.
std::string cubes(const std::string& place) {
  const std::string cube =
      R"({"type":"hull","vertices":[[-1,-1,-1],[-1,-1,1],[-1,1,-1],[-1,1,1],[1,-1,-1],[1,-1,1],[1,1,-1],[1,1,1]]})";
  return R"({"id":"cubes","a":{"shape":)" + cube + R"(},"b":{"shape":)" + cube +
         R"(,"translation":[)" + place + ",0.25,0.5]}}";
}

// What the library answers wrongly, in its adapter and by itself.
struct Known {
  const char* library;
  std::string right, wrong;
};

const Known known[] = {
    {"fcl-indep", cubes("2.001"), cubes("2.0000001")},
    {"libccd-gjk", cubes("2.001"), cubes("2.000000001")},
    {"ode", boxes_that_overlap,
     R"({"id":"flat","a":{"shape":{"type":"box","half_extents":[1,1,1]}},)"
     R"("b":{"shape":{"type":"box","half_extents":[300000,800000,1]},"translation":[600000,0,0],)"
     R"("rotation":[0.452261744161561,-0.8918852587457328,-3.3306690738754696e-16,)"
     R"(0.8918852587457328,0.45226174416156106,-1.97758476261356e-16,)"
     R"(-2.7755575615628914e-17,-1.1102230246251565e-16,0.9999999999999998]}})"},
    {"bullet-gjk-epa", boxes_that_overlap,
     R"({"id":"edges","a":{"shape":{"type":"box","half_extents":[0.449,1,1]}},)"
     R"("b":{"shape":{"type":"box","half_extents":[0.654,0.304,1]},"translation":[1.17,0,0],)"
     R"("rotation":[-0.9177994001024214,-0.3970444070524544,0,0,0,1,)"
     R"(-0.3970444070524544,0.9177994001024214,0]}})"}};

// Compiles the test as its first lines say, and runs it.
Ran compile_and_run(const TemporaryFolder& folder, const std::string& name) {
  const std::string text = folder.read(name);
  const std::size_t at = text.find("g++ ");
  const std::string line = text.substr(at, text.find('\n', at) - at);
  return run_shell("cd '" + folder.path().string() + "' && " + line);
}

TEST(Reproducer, FailsWhereTheLibraryIsWrong) {
  int compiled = 0;
  for (const Known& of : known) {
    SCOPED_TRACE(of.library);
    const NarrowPhaseEntry* const entry = registry::find<NarrowPhaseEntry>(of.library);
    if (entry == nullptr || !entry->make) continue;
    ++compiled;
    const TemporaryFolder folder;
    const auto right = folder.write("right.jsonl", of.right + "\n");
    const auto wrong = folder.write("wrong.jsonl", of.wrong + "\n");
    for (const auto& [file, name] :
         {std::pair(right, "right.cpp"), std::pair(wrong, "wrong.cpp")}) {
      const Ran ran = run_program("query '" + file.string() + "' --with " + of.library +
                                  " --as-test '" + (folder.path() / name).string() + "'");
      ASSERT_EQ(ran.status, 0) << ran.text;
    }
    const Ran passes = compile_and_run(folder, "right.cpp");
    EXPECT_EQ(passes.status, 0) << passes.text;
    const Ran fails = compile_and_run(folder, "wrong.cpp");
    EXPECT_EQ(fails.status, 1) << fails.text;
    EXPECT_EQ(fails.text.find("error:"), std::string::npos) << fails.text;
  }
  if (compiled == 0) GTEST_SKIP() << "no library is built";
}

// A library that an adapter asks, and versions of it whose package makes the test fail and pass.
struct KnownScript {
  const char *adapter, *package, *wrong, *right, *task;
};
constexpr KnownScript known_scripts[] = {
    {"mujoco", "@mujoco/mujoco", "3.10.0", "3.12.0", "signed"},
    {"rapier", "@dimforge/rapier3d-compat", "0.21.0", nullptr, "distance"},
    {"jolt", "jolt-physics", "1.1.0", nullptr, "signed"}};

// Runs the test of a file where this version of the package is.
Ran run_script(const TemporaryFolder& folder, const KnownScript& of, const std::string& version,
               const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path link = folder.path() / "node_modules" / of.package;
  fs::create_directories(link.parent_path());
  fs::remove(link);
  fs::create_directory_symlink(fs::path(project_folder) / "datasets/adapters" / of.adapter /
                                   "node_modules" / (std::string(of.adapter) + "-" + version),
                               link);
  return run_shell("cd '" + folder.path().string() + "' && node " + name);
}

TEST(Reproducer, ScriptsFailWhereTheLibraryIsWrong) {
  int asked = 0;
  for (const KnownScript& of : known_scripts) {
    SCOPED_TRACE(of.adapter);
    const std::string root = project_folder, adapter = of.adapter;
    if (!std::filesystem::exists(root + "/datasets/adapters/" + adapter + "/node_modules"))
      continue;
    ++asked;
    const TemporaryFolder folder;
    const auto sphere = folder.write(
        "right.jsonl",
        R"({"a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":{"type":"capsule","radius":1,"half_length":1},"translation":[3,1,0]}})"
        "\n");
    const std::string wrong = root + "/results/versions/cases.jsonl";
    const std::string with = std::string(" --task ") + of.task + " --with none --peer " + adapter +
                             "@" + of.wrong + " --as-test " + folder.path().string();
    ASSERT_EQ(run_program("query " + wrong + " --id " + adapter + with + "/wrong.mjs").status, 0);
    ASSERT_EQ(run_program("query " + sphere.string() + with + "/right.mjs").status, 0);
    const Ran fails = run_script(folder, of, of.wrong, "wrong.mjs");
    EXPECT_EQ(fails.status, 1) << fails.text;
    EXPECT_NE(fails.text.find(adapter + ": "), std::string::npos) << fails.text;
    const Ran passes = run_script(folder, of, of.wrong, "right.mjs");
    EXPECT_EQ(passes.status, 0) << passes.text;
    if (of.right == nullptr) continue;
    const Ran mended = run_script(folder, of, of.right, "wrong.mjs");
    EXPECT_EQ(mended.status, 0) << mended.text;
  }
  if (asked == 0) GTEST_SKIP() << "no adapter for Node.js is installed";
}

// Scripts need no library to be written, only one that answers by that name.
TEST(Reproducer, ScriptsInPythonAreRunWithAStandIn) {
  const std::string root = project_folder;
  if (run_shell("/usr/bin/python3 -c 'import numpy'").status != 0) GTEST_SKIP() << "no numpy";
  const TemporaryFolder folder;
  const std::string stand_ins = root + "/tests/harness/peer/stand_ins";
  const auto spheres = folder.write(
      "spheres.jsonl",
      R"({"id":"one","a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":{"type":"sphere","radius":1},"translation":[3,0,0]}})"
      "\n"
      R"({"id":"other\u2028line","a":{"shape":{"type":"cone","radius":1,"half_length":1}},"b":{"shape":{"type":"sphere","radius":1}}})"
      "\n");
  const std::string query = "query " + spheres.string() +
                            " --task signed --with none --peer '/usr/bin/python3 -B " + root +
                            "/tests/harness/peer/hostile.py wrong-sign 0 mujoco 3.3.8' --as-test " +
                            folder.path().string();
  const Ran wrote = run_program(query + "/test.py");
  ASSERT_EQ(wrote.status, 0) << wrote.text;
  std::string text = folder.read("test.py");
  EXPECT_NE(text.find("pip install mujoco==3.3.8 && python3 test.py"), std::string::npos);
  // An id ends no comment.
  EXPECT_NE(text.find(R"(Case "other\u2028line" is left out: the library has no cone)"),
            std::string::npos);
  const std::string run =
      "PYTHONPATH=" + stand_ins + " /usr/bin/python3 -B " + folder.path().string();
  const Ran passes = run_shell(run + "/test.py");
  EXPECT_EQ(passes.status, 0) << passes.text;
  const std::size_t at = text.find("\"number\":1.0");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 12, "\"number\":2.0");
  folder.write("false.py", text);
  const Ran fails = run_shell(run + "/false.py");
  EXPECT_EQ(fails.status, 1);
  EXPECT_NE(fails.text.find("one: wrong distance"), std::string::npos) << fails.text;
  // That version has no such package.
  expect_refusal(query + "/test.mjs", "is no such file; expected one of .py", folder);
  expect_refusal(query + "/test.cpp", "is no such file; expected one of .py", folder);
}

TEST(Reproducer, RefusesWhatHasNoForm) {
  const TemporaryFolder folder;
  const auto pair = folder.write("pair.jsonl", std::string(boxes_that_overlap) + "\n");
  const std::string query = "query '" + pair.string() + "' --as-test '" +
                            (folder.path() / "test.cpp").string() + "' --with ";
  expect_refusal(query + "gjk", "with 0 libraries; expected one of fcl-libccd", folder);
  if (registry::find<NarrowPhaseEntry>("libccd-mpr")->make) {
    const auto plane = folder.write(
        "plane.jsonl",
        R"({"a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":{"type":"halfspace","normal":[0,0,1],"offset":0}}})"
        "\n");
    expect_refusal("query '" + plane.string() + "' --with libccd-mpr --as-test '" +
                       (folder.path() / "test.cpp").string() + "'",
                   "has no case for libccd-mpr: the library has no halfspace", folder);
  }
}

}  // namespace
}  // namespace touchstone
