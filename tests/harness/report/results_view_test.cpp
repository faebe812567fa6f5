// What the page shows of a results folder.
#include "harness/report/results_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/base/error.h"
#include "tests/harness/packed.h"
#include "tests/harness/stats/sample_file.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::report {
namespace {

namespace fs = std::filesystem;
using files::OrderedJson;
using testing::HasSubstr;

// A case of a box of half a metre at the origin and a ball of half a metre on the x axis.
std::string ball_at(const std::string& x) {
  return R"({"id":"ball at )" + x +
         R"(","a":{"shape":{"type":"box","half_extents":[0.5,0.5,0.5]},"translation":[0,0,0],)"
         R"("quaternion_wxyz":[1,0,0,0]},"b":{"shape":{"type":"sphere","radius":0.5},"translation":[)" +
         x + R"(,0,0],"quaternion_wxyz":[1,0,0,0]},"source":{"wrong":"called otherwise"}})" + "\n";
}

struct Results : testing::Test {
  TemporaryFolder folder;

  OrderedJson view(int most_cases = 500) const {
    ResultsRequest request;
    request.folder = folder.path();
    request.name = "mine";
    request.most_cases = most_cases;
    return results_view(request);
  }
  OrderedJson only_case(const std::string& line) const {
    folder.write("times.csv", "a\n");
    fs::create_directory(folder.path() / "failures");
    folder.write("failures/some.jsonl", line);
    const OrderedJson whole = view();
    EXPECT_EQ(whole["cases"].size(), 1U) << whole["notes"];
    return whole["cases"].at(0);
  }
};

TEST_F(Results, KeepTheirFilesAsTheyStand) {
  const std::string times = "scene,seconds\r\n\"<script>, \"\"x\"\"\",1e-7\nhalf";
  folder.write("times.csv", times);
  folder.write("progress.csv", "name,value\n");
  folder.write("raw.csv.xz", "packed");
  const OrderedJson whole = view();
  EXPECT_EQ(whole["files"].size(), 1U);
  EXPECT_EQ(whole["files"]["times.csv"], times);
  EXPECT_EQ(whole["name"], "mine");
  ASSERT_EQ(whole["notes"].size(), 1U);
  EXPECT_THAT(std::string(whole["notes"][0]), HasSubstr("raw.csv.xz is packed"));
}

TEST_F(Results, ArePackedOrPlain) {
  fake_run().write(folder.path() / "r");
  const auto r = [&] {
    ResultsRequest request;
    request.folder = folder.path() / "r";
    return results_view(request);
  };
  const OrderedJson plain = r();
  pack(folder.path() / "r/raw.csv");
  EXPECT_EQ(r(), plain);
  EXPECT_TRUE(plain["files"].contains("raw.csv"));
  EXPECT_TRUE(plain["files"].contains("times.csv"));
  EXPECT_TRUE(plain["notes"].empty());
  // Of two, the plain one is shown.
  folder.write("r/raw.csv", "scene\n");
  EXPECT_EQ(r()["files"]["raw.csv"], "scene\n");
  fs::remove(folder.path() / "r/raw.csv");
  folder.write("r/raw.csv.zst", folder.read("r/raw.csv.zst").substr(0, 1000));
  const OrderedJson cut = r();
  EXPECT_FALSE(cut["files"].contains("raw.csv"));
  ASSERT_EQ(cut["notes"].size(), 1U) << cut["notes"];
  EXPECT_THAT(std::string(cut["notes"][0]), HasSubstr("raw.csv.zst: ends in the middle"));
  fs::remove(folder.path() / "r/machine.csv");
  EXPECT_EQ(folders_with_tables(folder.path()), std::vector<fs::path>{folder.path() / "r"});
}

TEST_F(Results, AreInTheFolderOrBelowIt) {
  EXPECT_THROW(folders_with_tables(folder.path()), base::InputError);
  EXPECT_THROW(folders_with_tables(folder.path() / "none"), base::InputError);
  fs::create_directories(folder.path() / "b/grid");
  fs::create_directories(folder.path() / "a/figures");
  fs::create_directories(folder.path() / "b/reproductions/block-1");
  folder.write("b/reproductions/block-1/boxes.csv", "a\n");
  folder.write("b/grid/points.csv", "a\n");
  folder.write("a/front.csv", "a\n");
  EXPECT_EQ(folders_with_tables(folder.path()),
            (std::vector<fs::path>{folder.path() / "a", folder.path() / "b/grid"}));
  folder.write("times.csv", "a\n");
  EXPECT_EQ(folders_with_tables(folder.path()), std::vector<fs::path>{folder.path()});
}

TEST_F(Results, NameCaseFilesThatAreCutOrTooMany) {
  folder.write("times.csv", "a\n");
  fs::create_directories(folder.path() / "reproductions/block-1");
  folder.write("reproductions/block-1/cut.jsonl", ball_at("3").substr(0, 100));
  folder.write("reproductions/two.jsonl", ball_at("3") + ball_at("2"));
  const OrderedJson whole = view(1);
  ASSERT_EQ(whole["cases"].size(), 1U);
  EXPECT_EQ(whole["cases"][0]["id"], "ball at 3");
  EXPECT_EQ(whole["cases"][0]["source"], "reproductions/two.jsonl");
  EXPECT_EQ(whole["cases"][0]["about"], "called otherwise");
  ASSERT_EQ(whole["notes"].size(), 2U);
  EXPECT_THAT(std::string(whole["notes"][0]), HasSubstr("cut.jsonl"));
  EXPECT_THAT(std::string(whole["notes"][1]), HasSubstr("1 more pairs"));
}

TEST_F(Results, ProveAGapByAPlane) {
  const OrderedJson pair = only_case(ball_at("1.25"));
  EXPECT_EQ(pair["truth"]["answer"], "separated");
  EXPECT_DOUBLE_EQ(pair["truth"]["lower"], 0.25);
  const OrderedJson& proof = pair["proof"];
  EXPECT_DOUBLE_EQ(proof["plane"]["normal"][0], 1);
  EXPECT_DOUBLE_EQ(proof["plane"]["offset"], 0.625);
  EXPECT_DOUBLE_EQ(proof["on_a"][0], 0.5);
  EXPECT_DOUBLE_EQ(proof["on_b"][0], 0.75);
  EXPECT_TRUE(proof["point"].is_null());
  EXPECT_TRUE(proof["ball"].is_null());
}

TEST_F(Results, ProveATouchByAPlaneAndAPoint) {
  const OrderedJson pair = only_case(ball_at("1"));
  EXPECT_EQ(pair["truth"]["answer"], "touching");
  EXPECT_DOUBLE_EQ(pair["proof"]["plane"]["offset"], 0.5);
  EXPECT_EQ(pair["proof"]["point"], OrderedJson({0.5, 0.0, 0.0}));
}

TEST_F(Results, ProveADepthByABall) {
  const OrderedJson pair = only_case(ball_at("0.75"));
  EXPECT_EQ(pair["truth"]["answer"], "overlapping");
  const OrderedJson& proof = pair["proof"];
  EXPECT_TRUE(proof["plane"].is_null());
  EXPECT_TRUE(proof["point"].is_null());
  EXPECT_DOUBLE_EQ(proof["ball"]["radius"], 0.25);
  EXPECT_EQ(proof["ball"]["centre"], proof["on_b"]);
  // The way from b's point to a's separates.
  EXPECT_DOUBLE_EQ(double(proof["on_a"][0]) - double(proof["on_b"][0]), 0.25);
}

TEST_F(Results, AskEveryAlgorithmAndMarkThoseThatAreWrong) {
  // Two edges that cross, apart by 0.05 m along a direction that is no face's normal.
  const OrderedJson pair = only_case(
      R"({"id":"edges","a":{"shape":{"type":"box","half_extents":[1,1,1]},"translation":[0,0,0],)"
      R"("rotation":[0.7071067811865476,-0.7071067811865476,0,0.7071067811865476,)"
      R"(0.7071067811865476,0,0,0,1]},"b":{"shape":{"type":"box","half_extents":[1,1,1]},)"
      R"("translation":[2.8784271247461903,0,0],"rotation":[0.7071067811865476,0,)"
      R"(0.7071067811865476,0,1,0,-0.7071067811865476,0,0.7071067811865476]}})");
  EXPECT_EQ(pair["truth"]["answer"], "separated");
  std::size_t exact = 0, wrong = 0;
  for (const OrderedJson& answer : pair["answers"]) {
    if (answer["algorithm"] == "exact") {
      ++exact;
      EXPECT_EQ(answer["grade"], "right");
      EXPECT_EQ(answer["why"], "");
    }
    if (answer["algorithm"] == "sat-faces" && answer["task"] == "intersect") {
      EXPECT_EQ(answer["answer"], "overlapping");
      EXPECT_EQ(answer["grade"], "approximate");
      EXPECT_THAT(std::string(answer["why"]), HasSubstr("called overlapping, and apart by"));
      ++wrong;
    }
    if (answer["algorithm"] == "gjk") {
      EXPECT_EQ(answer["grade"], "right");
    }
  }
  EXPECT_EQ(exact, 2U);
  EXPECT_EQ(wrong, 2U);
}

TEST_F(Results, DoNotBlameAnAlgorithmForNumbersThatWereRoundedForIt) {
  // A million metres away, floats are 0.06 m apart: what is apart by 0.03 m overlaps in floats.
  std::string line = ball_at("1000001.0312");
  line.replace(line.find("[0,0,0]"), 7, "[1000000.0313,0,0]");
  line.replace(line.find("radius\":0.5"), 11, "radius\":0.47");
  const OrderedJson pair = only_case(line);
  EXPECT_EQ(pair["truth"]["answer"], "separated");
  std::size_t rounded = 0;
  for (const OrderedJson& answer : pair["answers"]) {
    if (answer["origin"] == "ours") {
      EXPECT_NE(answer["grade"], "silent") << answer;
    }
    if (answer["grade"] != "rounded") continue;
    ++rounded;
    EXPECT_EQ(answer["scalar"], "float") << answer;
    EXPECT_EQ(answer["answer"], "overlapping") << answer;
  }
  EXPECT_GT(rounded, 0U);
}

TEST_F(Results, HaveBodiesWithTheFacesOfTheirHulls) {
  std::string line = ball_at("3");
  const std::string ball = R"({"type":"sphere","radius":0.5})";
  line.replace(line.find(ball), ball.size(),
               R"({"type":"hull","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1],[0.1,0.1,0.1]]})");
  const OrderedJson shape = only_case(line)["b"]["shape"];
  EXPECT_EQ(shape["type"], "hull");
  EXPECT_EQ(shape["vertices"].size(), 5U);
  EXPECT_EQ(shape["faces"].size(), 4U);
}

// A pair that a version gets wrong, as `check` writes it.
std::string wrong_pair(const std::string& grade = "wrong") {
  std::string line = ball_at("1.5");
  return line.substr(0, line.size() - 2) +
         R"(,"group":"gap","answers":[{"algorithm":"lib@1","scalar":"double","task":"signed","grade":")" +
         grade +
         R"(","error":0.5,"answer":"touching","status":"ok","distance":0,"normal":[1,0,0]},)"
         R"({"algorithm":"fcl-indep","scalar":"double","task":"signed","grade":"wrong","error":0.5,)"
         R"("answer":"touching","status":"ok"}]})"
         "\n";
}

TEST_F(Results, HaveThePairsThatVersionsGetWrong) {
  folder.write("versions.csv", "a\n");
  folder.write("wrong_pairs.jsonl", wrong_pair());
  const OrderedJson whole = view();
  ASSERT_EQ(whole["cases"].size(), 1U) << whole["notes"];
  const OrderedJson& one = whole["cases"][0];
  EXPECT_EQ(one["truth"]["answer"], "separated");
  EXPECT_EQ(one["truth"]["lower"], 0.5);
  const OrderedJson& recorded = one["recorded"];
  EXPECT_EQ(recorded["group"], "gap");
  ASSERT_EQ(recorded["answers"].size(), 2U);
  EXPECT_EQ(recorded["answers"][0]["grade"], "silent");
  EXPECT_EQ(recorded["answers"][0]["why"], "off by 0.5 of the size");
  EXPECT_EQ(recorded["answers"][0]["normal"], OrderedJson({1, 0, 0}));
  EXPECT_TRUE(recorded["answers"][0]["witness_a"].is_null());
  ASSERT_EQ(recorded["tests"].size(), 1U) << "a library that has a form as a test";
  EXPECT_EQ(recorded["tests"][0]["algorithm"], "fcl-indep");
  EXPECT_THAT(std::string(recorded["tests"][0]["text"]), HasSubstr("TEST(ExactPairs"));
  EXPECT_GT(one["answers"].size(), 10U) << "algorithms are asked too";
}

TEST_F(Results, SayWhatIsWrongWithThePairsOfVersions) {
  folder.write("versions.csv", "a\n");
  folder.write("wrong_pairs.jsonl", wrong_pair("bad"));
  const OrderedJson whole = view();
  EXPECT_EQ(whole["cases"].size(), 0U);
  ASSERT_EQ(whole["notes"].size(), 1U);
  EXPECT_THAT(
      std::string(whole["notes"][0]),
      HasSubstr("wrong_pairs.jsonl:1: answers[0].grade: found 'bad'; expected right, wrong"));
}

}  // namespace
}  // namespace touchstone::report
