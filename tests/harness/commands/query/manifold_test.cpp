// Tests of touchstone query with contact manifolds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> manifold_columns = {
    "id",       "algorithm", "scalar", "answer", "status", "normal_x",
    "normal_y", "normal_z",  "count",  "point",  "depth",  "a_x",
    "a_y",      "a_z",       "b_x",    "b_y",    "b_z",    "feature"};

// The cases are a cube on a box, one far above it, and a ball in a plane.
const std::string cube_on_cube =
    R"({"id":"on","a":{"shape":{"type":"box","half_extents":[2,2,1]}},)"
    R"("b":{"shape":{"type":"box","half_extents":[1,1,1]},"translation":[0,0,1.75]}})"
    "\n";
const std::string cube_off_cube =
    R"({"id":"off","a":{"shape":{"type":"box","half_extents":[2,2,1]}},)"
    R"("b":{"shape":{"type":"box","half_extents":[1,1,1]},"translation":[0,0,9]}})"
    "\n";
const std::string plane_and_ball =
    R"({"id":"ball","a":{"shape":{"type":"halfspace","normal":[0,0,1],"offset":0}},)"
    R"("b":{"shape":{"type":"sphere","radius":1},"translation":[3,0,0.5]}})"
    "\n";

// A point of a curved body is found to EPA's tolerance along its surface, and that is no fault.
TEST(ManifoldCommand, ACapsuleInAnEllipsoidIsNotWrong) {
  const TemporaryFolder folder;
  const auto cases = folder.write(
      "in.jsonl",
      R"({"id":"round","a":{"shape":{"type":"capsule","radius":0.25,"half_length":0.5},)"
      R"("quaternion_wxyz":[0.36033056421611737,-0.6498718129234883,-1.26261940429921,)"
      R"(-0.03240108445443672]},"b":{"shape":{"type":"ellipsoid","radii":[0.5,0.3,0.4]},)"
      R"("quaternion_wxyz":[0.6147381015864962,-1.5753989526310588,0.009494114972614464,)"
      R"(-0.7249059447468067],)"
      R"("translation":[-0.30119135969609834,0.3277910608340312,-0.2479049320239649]}})"
      "\n");
  const Ran ran = run_program("query " + cases.string() + " --kind manifold" +
                              " --algorithm clipped-faces --scalar double --grade");
  EXPECT_EQ(ran.status, 0) << ran.text;
}

TEST(ManifoldCommand, OneRowForEachPoint) {
  const TemporaryFolder folder;
  const auto cases = folder.write("in.jsonl", cube_on_cube + cube_off_cube + plane_and_ball);
  const auto out = folder.path() / "out.csv";
  const Ran ran = run_program("query " + cases.string() + " --kind manifold" +
                              " --algorithm clipped-faces --scalar double --out " + out.string());
  EXPECT_EQ(ran.status, 0) << ran.text;
  const auto rows = read_rows(out, manifold_columns);
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i][0], "on");
    EXPECT_EQ(rows[i][1], "clipped-faces");
    EXPECT_EQ(rows[i][2], "double");
    EXPECT_EQ(rows[i][3], "overlapping");
    EXPECT_EQ(rows[i][4], "ok");
    EXPECT_EQ(rows[i][7], "1");
    EXPECT_EQ(rows[i][8], "4");
    EXPECT_EQ(rows[i][9], std::to_string(i));
    EXPECT_EQ(rows[i][10], "0.25");
    EXPECT_EQ(std::abs(std::stod(rows[i][11])), 1);
    EXPECT_EQ(rows[i][13], "1");
    EXPECT_EQ(rows[i][16], "0.75");
    EXPECT_EQ(rows[i][17].size(), 16u);
  }
  EXPECT_EQ(rows[4][3], "separated");
  EXPECT_EQ(rows[4][8], "0");
  EXPECT_EQ(rows[4][9], "");
  EXPECT_EQ(rows[4][10], "");
  // The plane is a here, though contracts put it second: the normal is a's.
  EXPECT_EQ(rows[5][7], "1");
  EXPECT_EQ(rows[5][13], "0");
  EXPECT_EQ(rows[5][16], "-0.5");
  EXPECT_EQ(rows[5][17], "");
}

TEST(ManifoldCommand, GradesEveryFamilyOfEveryAlgorithm) {
  const TemporaryFolder folder;
  const auto page = folder.path() / "page.md";
  const Ran ran = run_program("query --settled 3 --grade --page " + page.string());
  EXPECT_EQ(ran.status, 0) << ran.text;
  for (const ManifoldEntry& entry : registry::entries<ManifoldEntry>()) {
    if (is_built(entry.info)) {
      EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
    }
  }
  std::ifstream file(page);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_THAT(
      text, HasSubstr("touchstone query --settled 3 --seed 1 --kind manifold --with all --grade"));
  EXPECT_THAT(text, HasSubstr("| tilt-1e-12 | clipped-faces double | 3 | 0 | 3 to 4 |"));
}

TEST(ManifoldCommand, CasesOfAnyShapesAreGraded) {
  const TemporaryFolder folder;
  const auto cases = folder.write("in.jsonl", cube_on_cube + cube_off_cube + plane_and_ball);
  const Ran ran =
      run_program("query " + cases.string() + " --kind manifold" + " --algorithm ours --grade");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("clipped-faces double"));
}

TEST(ManifoldCommand, WrongRequests) {
  const TemporaryFolder folder;
  const auto cases = folder.write("in.jsonl", cube_on_cube).string();
  const std::string out = " --out " + (folder.path() / "out.csv").string();
  expect_refusal("query --kind manifold --grade", "FILE is missing", folder);
  expect_refusal("query " + cases + " --settled 3 --grade", "expected either FILE or --settled",
                 folder);
  expect_refusal("query " + cases + " --kind manifold" + out + " --page x.md",
                 "--page was given without", folder);
  expect_refusal("query " + cases + " --kind manifold" + out + " --algorithm gjk",
                 "no contact manifold is called 'gjk'", folder);
  expect_refusal("query " + cases + " --kind manifold" + out + " --scalar half", "half", folder);
  expect_refusal("query --settled 0 --grade", "0", folder);
  expect_refusal("query none.jsonl --kind manifold" + out, "none.jsonl", folder);
}

}  // namespace
}  // namespace touchstone
