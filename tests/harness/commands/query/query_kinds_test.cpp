// Tests of touchstone query with files of every kind: what it is told by, and what it prints.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/report/unpacked.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

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

// The exact answer first, and of the others how far they are off it.
TEST_F(QueryKinds, APairIsAnsweredInLinesThatOneReads) {
  const std::string text = shown(write(
      "pair.jsonl",
      R"({"a":{"shape":{"type":"sphere","radius":0.1}},"b":{"shape":{"type":"ellipsoid",)"
      R"("radii":[1,0.5,0.25]},"translation":[0.3,0.2,0.1],"quaternion_wxyz":[1,0.2,0.3,0.4]}})"
      "\n"));
  EXPECT_THAT(text, testing::StartsWith("case '1'\n  exact  "));
  EXPECT_THAT(
      text, ContainsRegex("  exact +overlapping  -0\\.[0-9]+ \\+- [0-9]e-[0-9]+ m \\(proven\\)\n"));
  EXPECT_THAT(text, ContainsRegex("\n  certified +-0\\.[0-9]+ \\((exact|off by [0-9]e-[0-9]+)\\)"));
  EXPECT_THAT(text, ContainsRegex("\\(off by [0-9]e-[0-9]+\\)"));
}

TEST_F(QueryKinds, APairOfAScene) {
  const std::string scene = write("scene.toml",
                                  "frames = 3\n"
                                  "[[body]]\nshape = {type = \"sphere\", radius = 1}\n"
                                  "[[body]]\nmesh = \"mesh.obj\"\ntranslation = [9, 0, 0]\n"
                                  "[[body]]\nshape = {type = \"sphere\", radius = 1}\n"
                                  "translation = [4, 0, 0]\nvelocity = [30, 0, 0]\n");
  write("mesh.obj", small_tetrahedron);
  EXPECT_THAT(shown(scene + " --bodies 0 2"), ContainsRegex("case '0-2'\n  exact +separated  2 "));
  EXPECT_THAT(shown("--bodies 0,2 " + scene), ContainsRegex("case '0-2'\n  exact +separated  2 "));
  EXPECT_THAT(shown(scene + " --bodies 0 2 --frame 1"), ContainsRegex("exact +separated  3 "));
  EXPECT_THAT(shown(scene + " --bodies 0 1"), ContainsRegex("case '0-1'\n  exact +separated  8 "));
  expect_refusal("query " + scene, "scene.toml: is a scene; expected --bodies", folder);
  for (const char* bodies : {"0", "0 3", "0 0", "0 1 2", "0 x"}) {
    expect_refusal("query " + scene + " --bodies " + bodies, "--bodies", folder);
  }
  expect_refusal("query " + scene + " --bodies 0 2 --frame 3",
                 "--frame: found 3; expected at most 2", folder);
  expect_refusal("query " + scene + " --bodies 0 2 --id 3", "--id excludes --bodies", folder);
  const std::string pairs = write("pairs.jsonl", two_boxes);
  expect_refusal("query " + pairs + " --frame 1", "expected it with --bodies alone", folder);
  expect_refusal("query " + pairs + " --bodies 0 1", "pairs.jsonl", folder);
}

TEST_F(QueryKinds, AMeshIsNamedAsInScenes) {
  write("mesh.obj", small_tetrahedron);
  const std::string ball = R"(,"b":{"shape":{"type":"sphere","radius":1},"translation":[1,1,-3]}})";
  for (const char* body : {R"({"a":{"mesh":"mesh.obj"})", R"({"a":{"shape":{"mesh":"mesh.obj"}})",
                           R"({"a":{"mesh":"mesh.obj","as":"hull","scale":1})"}) {
    EXPECT_THAT(shown(write("pair.jsonl", body + ball + "\n")),
                ContainsRegex("case '1'\n  exact +separated  2 "))
        << body;
  }
  const auto refused = [&](const std::string& body, const std::string& text) {
    expect_refusal("query " + write("bad.jsonl", "{\"a\":" + body + ball + "\n"), text, folder);
  };
  refused(R"({"mesh":"none.obj"})", "bad.jsonl:1: a.mesh: no file");
  refused(R"({"mesh":"mesh.obj","shape":{"type":"sphere","radius":1}})",
          "bad.jsonl:1: a: \"mesh\" is given beside \"shape\"");
  refused(R"({"mesh":"mesh.obj","scale":0})", "bad.jsonl:1: a.scale: found 0");
}

TEST_F(QueryKinds, APageHasThePairs) {
  write("mesh.obj", small_tetrahedron);
  const std::string ball = R"(,"b":{"shape":{"type":"sphere","radius":1},"translation":[1,1,-3]}})";
  const std::string built = write("built.html", "<!--BUNDLE-->");
  const std::string page = (folder.path() / "pair.html").string();
  shown(write("pairs.jsonl",
              two_boxes + R"({"a":{"shape":{"type":"box","half_extents":[1,1,1]}})" + ball + "\n") +
        " --page " + page + " --built-page " + built);
  nlohmann::json cases = bundle_of(folder.read("pair.html"))["results"][0]["cases"];
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0]["id"], "p");
  EXPECT_EQ(cases[0]["truth"]["answer"], "overlapping");
  EXPECT_GT(cases[0]["answers"].size(), 5u);
  EXPECT_THAT(std::string(cases[1]["query"]), HasSubstr("pairs.jsonl --id 2"));
  shown(write("meshes.jsonl", R"({"a":{"mesh":"mesh.obj"})" + ball + "\n") + " --page " + page +
        " --built-page " + built);
  cases = bundle_of(folder.read("pair.html"))["results"][0]["cases"];
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0]["truth"]["answer"], "separated");
  EXPECT_EQ(cases[0]["a"]["shape"]["faces"].size(), 4u);
  EXPECT_GT(cases[0]["answers"].size(), 1u);
  for (const auto& answer : cases[0]["answers"]) EXPECT_NE(answer["grade"], "silent");
  std::filesystem::remove(page);
  expect_refusal(
      "query " + write("pairs.jsonl", two_boxes) + " --page " + page + " --built-page none",
      "the page is not built", folder);
}

std::string text_of(const std::string& file) {
  std::ifstream stream(std::filesystem::path(project_folder) / file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A ball that slides along x, towards another one at 0.5 m.
const std::string small_robot = R"(<robot name="rail">
<link name="rail"><collision><origin xyz="0.5 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
<link name="bar"/>
<link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="turn" type="continuous"><parent link="rail"/><child link="bar"/></joint>
<joint name="lift" type="prismatic"><parent link="bar"/><child link="bar2"/><limit lower="-1" upper="1"/></joint>
<link name="bar2"><collision><origin xyz="0 9 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="slide" type="prismatic"><parent link="bar2"/><child link="ball"/><axis xyz="1 0 0"/><limit lower="-1" upper="1"/></joint>
</robot>)";

TEST_F(QueryKinds, ConfigurationsOfARobotAreFreeOrNot) {
  const std::string robot = write("rail.urdf", small_robot);
  const std::string rows = write("joints.csv", "slide\n0\n0.25\n0.5\n");
  const std::string asked = rows + " --in " + robot + " --with exact,ours";
  const std::string free = shown(asked);
  EXPECT_THAT(free, ContainsRegex("configuration 0\n  exact +free"));
  EXPECT_THAT(free, ContainsRegex("configuration 2\n  exact +contact +rail, ball"));
  EXPECT_THAT(free, HasSubstr("pose-lanes"));
  EXPECT_THAT(free, Not(HasSubstr("[exact:")));
  const std::string distance = shown(asked + " --task distance");
  EXPECT_THAT(distance, ContainsRegex("configuration 1\n  exact +free +0.0[45]"));
  EXPECT_THAT(distance, ContainsRegex("not taken by [a-z, -]*pose-lanes"));
  EXPECT_THAT(shown(asked + " --task motion"), HasSubstr("first in step 2 of 0 to 2"));
  const std::string scene =
      write("none.toml", "[[body]]\nshape = {type = \"sphere\", radius = 1}\n");
  expect_refusal("query " + rows + " --kind configuration --in " + scene, "none.toml: has no robot",
                 folder);
  std::string level = small_robot;  // joints may be called as the columns of points are
  for (const auto& [from, to] : {std::pair("turn", "x"), {"lift", "y"}, {"slide", "z"}}) {
    level.replace(level.find(from), std::string(from).size(), to);
  }
  const std::string named = write("named.csv", "x,y,z\n0,0,0.5\n");
  EXPECT_THAT(shown(named + " --in " + write("level.urdf", level) + " --with exact"),
              ContainsRegex("exact +contact +rail, ball"));
  expect_refusal("query " + rows + " --kind configuration", "--in is missing", folder);
  expect_refusal("query " + rows + " --kind configuration --in " + rows,
                 "expected a robot (.urdf) or a scene (.toml)", folder);
  expect_refusal("query " + write("wrong.csv", "push\n0\n") + " --in " + robot, "wrong.csv:1",
                 folder);
}

// The cases of the section "A pair in JSON" of datasets/README.md can be copied.
TEST_F(QueryKinds, TheDocumentedCasesAreAnswered) {
  std::string text = text_of("datasets/README.md");
  text = text.substr(text.find("### A pair in JSON"));
  std::string cases;
  std::size_t count = 0;
  for (std::size_t at = text.find("\n    {"); at != std::string::npos;
       at = text.find("\n    {", at + 1)) {
    cases += text.substr(at + 5, text.find('\n', at + 1) - at - 4);
    ++count;
  }
  EXPECT_GE(count, 3u);
  std::filesystem::create_directory_symlink(std::filesystem::path(project_folder) / "datasets/home",
                                            folder.path() / "home");
  const std::string answered = shown(write("pairs.jsonl", cases));
  for (const char* id : {"case '1'", "case 'turned'", "case 'a file'"}) {
    EXPECT_THAT(answered, HasSubstr(id));
  }
  EXPECT_THAT(answered, Not(HasSubstr("warning")));
}

// results/columns.md has every column of every kind.
TEST_F(QueryKinds, TheColumnsOfAnswersAreDocumented) {
  const std::string page = text_of("results/columns.md");
  const std::string mesh = write("mesh.obj", small_tetrahedron);
  const std::string scene = write(
      "scene.toml", "[[body]]\nshape = {type = \"sphere\", radius = 1}\ntranslation = [1, 1, 1]\n");
  const std::string rays = write("rays.csv", ray_columns + "1,1,9,0,0,-1,inf\n");
  const std::string pairs = write("pairs.jsonl", two_boxes);
  const std::vector<std::pair<std::string, std::string>> asked = {
      {"Answers about pairs", pairs},
      {"Answers about pairs", write("meshes.jsonl", triangle_and_ball) + " --task contacts"},
      {"Answers about moving pairs", write("moving.jsonl", moving_ball)},
      {"Contact points", pairs + " --kind manifold"},
      {"Answers about boxes",
       write("boxes.csv", "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,0,0,2,2,2\n")},
      {"Answers about rays", rays + " --in " + mesh},
      {"Answers about rays", rays + " --in " + scene},
      {"Answers about points", write("points.csv", "x,y,z\n1,1,-2\n") + " --in " + mesh},
      {"Answers about moving features",
       write("features.csv", "0,0,1\n-1,-1,0\n1,-1,0\n0,1,0\n0,0,-1\n-1,-1,0\n1,-1,0\n0,1,0\n") +
           " --features vertex-face"},
      {"Answers about configurations",
       write("joints.csv", "slide\n0\n1\n") + " --in " + write("rail.urdf", small_robot)}};
  for (const auto& [heading, arguments] : asked) {
    const std::size_t from = page.find("\n## " + heading + "\n");
    ASSERT_NE(from, std::string::npos) << heading;
    const std::string section = page.substr(from, page.find("\n#", from + 4) - from);
    shown(arguments + " --out " + (folder.path() / "out.csv").string());
    const std::string out = folder.read("out.csv");
    std::string header = out.substr(0, out.find('\n')) + ",";
    for (std::size_t comma = header.find(','); comma != std::string::npos;
         comma = header.find(',')) {
      const std::string column = header.substr(0, comma);
      header.erase(0, comma + 1);
      // `a_x` to `b_z` of manifolds, and `_y` behind `normal_x`, are ranges.
      const bool is_in_range = heading == "Contact points" && column[1] == '_';
      const bool is_axis = heading == "Contact points" && column.starts_with("normal_");
      if (is_in_range || is_axis) continue;
      EXPECT_THAT(section, HasSubstr("`" + column + "`")) << heading;
    }
  }
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
  EXPECT_THAT(text, HasSubstr("Every answer: --out FILE.csv"));
}

// Balls that are nearer to contact than a float tells.
TEST_F(QueryKinds, VerdictsThatAreNotTheExactOneAreCounted) {
  if (!is_built(registry::find<ConfigurationEntry>("bullet-world")->info)) GTEST_SKIP();
  std::string rows = "slide\n";
  for (int i = -10; i < 10; ++i) rows += fmt::format("{}\n", 0.3 + i * 1e-9);
  const std::string text =
      shown(write("joints.csv", rows) + " --in " + write("rail.urdf", small_robot) +
            " --with exact,ours,bullet-world");
  EXPECT_THAT(text, ContainsRegex("bullet-world .*; [1-9][0-9]* other than exact, the first in "
                                  "configuration [0-9]+\n"));
  EXPECT_THAT(text, ContainsRegex("fixed-pairs +[1-9][0-9]* +[1-9][0-9]* +0 +ok 20\n"));
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
