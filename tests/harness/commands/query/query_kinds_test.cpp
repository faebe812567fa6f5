// Tests of touchstone query with files of every kind: what it is told by, and what it prints.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string two_boxes =
    R"({"id":"p","a":{"shape":{"type":"box","half_extents":[1,1,1]}},)"
    R"("b":{"shape":{"type":"box","half_extents":[1,1,1]},"translation":[1.75,0,0]}})"
    "\n";
const std::string moving_ball =
    R"({"id":"c","a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":{"type":"sphere",)"
    R"("radius":1},"translation":[4,0,0],"displacement":[-4,0,0]}})"
    "\n";
const std::string triangle_and_ball =
    R"({"id":"m","a":{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],)"
    R"("triangles":[[0,1,2]]}},"b":{"shape":{"type":"sphere","radius":1},)"
    R"("translation":[0,0,3]}})"
    "\n";
const std::string small_tetrahedron =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string ray_columns =
    "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,t_max\n";

class QueryKinds : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    return folder.write(name, text).string();
  }
  // Runs `query` without --with, --task and --out.
  std::string shown(const std::string& arguments) {
    const Ran ran = run_program("query " + arguments);
    EXPECT_EQ(ran.status, 0) << arguments << "\n" << ran.text;
    return ran.text;
  }
  TemporaryFolder folder;
};

TEST_F(QueryKinds, AFewQuestionsGetALineForEachAlgorithm) {
  const std::string mesh = write("mesh.obj", small_tetrahedron);
  const std::string scene = write(
      "scene.toml", "[[body]]\nshape = {type = \"sphere\", radius = 1}\ntranslation = [1, 1, 1]\n");
  const std::string rays = write("rays.csv", ray_columns + "1,1,9,0,0,-1,inf\n");
  const std::string pairs = write("pairs.jsonl", two_boxes);
  const std::vector<std::pair<std::string, std::string>> asked = {
      {pairs, "exact +overlapping  -0\\.25 \\+- [0-9e.-]+ m \\(proven\\)"},
      {write("moving.jsonl", moving_ball), "exact +hit  0\\.5 \\+- [0-9e.-]+ of the step"},
      {write("meshes.jsonl", triangle_and_ball), "exact +separated  2 .*\\(proven\\)"},
      {pairs + " --kind manifold", "clipped-faces double +overlapping  4 points, the deepest 0.25"},
      {write("boxes.csv",
             "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,0,0,2,2,2\n0,1,1,1,1,3,3,3\n"),
       "naive +1 pairs, hash"},
      {rays + " --in " + mesh, "exact +hit  7 lengths of the direction  triangle 3"},
      {rays + " --in " + scene, "exact +hit  7 lengths of the direction  body 0, part 0"},
      {write("points.csv", "x,y,z\n1,1,-2\n") + " --in " + mesh,
       "exact +found  2 m  at \\(1, 1, 0\\)"},
      {write("features.csv", "0,0,1\n-1,-1,0\n1,-1,0\n0,1,0\n0,0,-1\n-1,-1,0\n1,-1,0\n0,1,0\n") +
           " --features vertex-face",
       "exact +hit  0\\.5 \\+- [0-9e.-]+ of the step"}};
  for (const auto& [arguments, line] : asked) {
    EXPECT_THAT(shown(arguments), ContainsRegex(line)) << arguments;
  }
  EXPECT_EQ(folder.names().size(), 9u);  // nothing was written
}

// 15 of 25 algorithms have no signed distances, and half of these have depths.
TEST_F(QueryKinds, ALibraryIsAskedForWhatItHas) {
  const std::string file = write("pairs.jsonl", two_boxes);
  const std::string out = (folder.path() / "out.csv").string();
  ASSERT_EQ(run_program("query " + file + " --out " + out).status, 0);
  int with_depth_alone = 0;
  for (const auto& row : read_rows(out, {"algorithm", "task", "status", "distance"})) {
    const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>(row[0]);
    const auto has = [&](Task task) {
      return offers(entry, Precision::float64) &&
             offers(entry, ShapeKind::box, ShapeKind::box, task);
    };
    if (has(Task::signed_distance)) {
      EXPECT_EQ(row[1], "signed") << row[0];
    } else if (has(Task::penetration)) {
      EXPECT_EQ(row[1], "penetration") << row[0];
      EXPECT_NE(row[3], "") << row[0];
      ++with_depth_alone;
    } else if (has(Task::distance)) {
      EXPECT_EQ(row[1], "distance") << row[0];
    } else if (has(Task::intersect)) {
      EXPECT_EQ(row[1], "intersect") << row[0];
    } else {
      EXPECT_EQ(row[2], "unsupported") << row[0];
    }
  }
  EXPECT_GE(with_depth_alone, 1);
}

TEST_F(QueryKinds, WhatDoesNotTakeTheQuestionIsOneLine) {
  const std::string text = shown(write("moving.jsonl", moving_ball) + " --start approach");
  EXPECT_THAT(text, ContainsRegex("\n  not taken by [a-z-]+, "));
  EXPECT_THAT(text, Not(HasSubstr("unsupported")));
}

TEST_F(QueryKinds, ManyQuestionsAreSummedUp) {
  std::string points = "x,y,z\n";
  for (int i = 0; i < 20; ++i) points += fmt::format("{},1,-2\n", i);
  const std::string text =
      shown(write("points.csv", points) + " --in " + write("mesh.obj", small_tetrahedron));
  EXPECT_THAT(text, Not(HasSubstr("point 0")));
  EXPECT_THAT(text, ContainsRegex("exact +20 +0 +ok 20"));
}

TEST_F(QueryKinds, OtherSpellingsSelectAlgorithms) {
  const std::string file = write("pairs.jsonl", two_boxes);
  const std::string out = (folder.path() / "out.csv").string();
  for (const char* option : {"--with", "--narrow", "--broad", "--cast", "--ccd", "--query"}) {
    ASSERT_EQ(run_program(fmt::format("query {} {} gjk --out {}", file, option, out)).status, 0);
    ASSERT_EQ(read_rows(out, {"algorithm"}).size(), 1u);
    EXPECT_EQ(read_rows(out, {"algorithm"})[0][0], "gjk");
  }
}

TEST_F(QueryKinds, WrongRequests) {
  const std::string pairs = write("pairs.jsonl", two_boxes);
  const std::string points = write("points.csv", "x,y,z\n1,1,-2\n");
  const std::string mesh = write("mesh.obj", small_tetrahedron);
  expect_refusal("query " + write("odd.csv", "a,b\n1,2\n"),
                 "odd.csv:1: found 'a,b'; expected cases", folder);
  expect_refusal("query " + pairs + " --kind triangle",
                 "--kind: found 'triangle'; expected one of pair", folder);
  expect_refusal("query " + pairs + " --task closest",
                 "--task: found 'closest'; expected one of intersect, distance", folder);
  expect_refusal("query " + pairs + " --start counts",
                 "--start was given; expected it with questions of the kind cast, and not pair",
                 folder);
  expect_refusal("query " + points + " --in " + mesh + " --tolerance 1",
                 "--tolerance was given; expected it with questions of the kind pair, mesh",
                 folder);
  expect_refusal("query " + points, "--in is missing; expected the mesh", folder);
  expect_refusal("query " + pairs + " --kind manifold --seed 2", "--seed was given", folder);
}

TEST_F(QueryKinds, OldCommandsNameTheNewLine) {
  for (const auto& [old, line] :
       std::vector<std::pair<std::string, std::string>>{{"rays", "query RAYS.csv --in MESH"},
                                                        {"points", "query POINTS.csv --in MESH"},
                                                        {"cast", "query --kind cast file"},
                                                        {"ccd", "query --kind=feature file"},
                                                        {"manifold", "query --kind manifold file"},
                                                        {"pairs", "query file"}}) {
    expect_refusal(old + " file", "`" + old + "` is now `touchstone " + line, folder);
  }
}

}  // namespace
}  // namespace touchstone
