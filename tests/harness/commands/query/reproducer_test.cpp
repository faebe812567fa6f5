// Pairs written as tests of libraries: they compile by themselves, fail where the library is wrong, and pass where it
// is right.
#include <gtest/gtest.h>

#include <string>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"

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

TEST(Reproducer, RefusesWhatHasNoForm) {
  const TemporaryFolder folder;
  const auto pair = folder.write("pair.jsonl", std::string(boxes_that_overlap) + "\n");
  const std::string query = "query '" + pair.string() + "' --as-test '" +
                            (folder.path() / "test.cpp").string() + "' --with ";
  expect_refusal(query + "gjk", "with 0 libraries; expected --with one of fcl-libccd", folder);
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
