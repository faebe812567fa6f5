// Tests of touchstone query with moving bodies.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <fstream>

#include "algorithms/registry.h"
#include "harness/files/cases.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

const std::vector<std::string> cast_columns = {
    "id",       "algorithm", "scalar",   "answer",  "status",  "toi",     "lower",     "upper",
    "normal_x", "normal_y",  "normal_z", "point_x", "point_y", "point_z", "iterations"};

// A box of half extents 1 about the origin, and a ball of radius 1 whose centre is at 4 on x and moves
// by `along` on it. The box may turn about z.
std::string box_and_moving_ball(const std::string& id, double along, double turn = 0) {
  return fmt::format(
      R"({{"id":"{}","a":{{"shape":{{"type":"box","half_extents":[1,1,1]}},)"
      R"("rotation_vector":[0,0,{}]}},"b":{{"shape":{{"type":"sphere","radius":1}},)"
      R"("translation":[4,0,0],"displacement":[{},0,0]}},"expect":"unknown keys are ignored"}})"
      "\n",
      id, turn, along);
}

double toi_of(const std::string& text) {
  double value = NAN;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

class CastCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  void expect_refusal(const std::string& arguments, const std::string& text) {
    touchstone::expect_refusal("query " + arguments, text, folder);
  }
  TemporaryFolder folder;
};

TEST_F(CastCommand, PlainCasesByEveryCast) {
  std::vector<std::string> names;
  for (const CastEntry& entry : registry::entries<CastEntry>()) {
    if (is_built(entry.info)) names.push_back(entry.info.name);
  }
  const std::string cases = box_and_moving_ball("hit", -4) + box_and_moving_ball("miss", -1) +
                            box_and_moving_ball("turning", -4, 0.5);
  folder.write("in.jsonl", cases);
  for (const std::string scalar : {"double", "float"}) {
    const Ran ran = run_program("query " + path("in.jsonl") + " --cast all --scalar " + scalar +
                                " --out " + path("out.csv"));
    ASSERT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(folder.path() / "out.csv", cast_columns);
    ASSERT_EQ(rows.size(), 3 * names.size());
    std::string header;
    std::getline(std::ifstream(folder.path() / "out.csv"), header);
    EXPECT_EQ(
        header,
        "id,algorithm,scalar,answer,status,toi,lower,upper,normal_x,normal_y,normal_z,point_x,"
        "point_y,point_z,iterations");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& row = rows[i];
      EXPECT_EQ(row[1], names[i % names.size()]);
      EXPECT_EQ(row[2], scalar);
      const CastEntry& entry = *registry::find<CastEntry>(row[1]);
      CastSettings settings;
      settings.scalar = scalar == "float" ? Precision::float32 : Precision::float64;
      const bool taken = offers(entry, settings) &&
                         offers(entry, ShapeKind::sphere, ShapeKind::box, row[0] == "turning");
      EXPECT_EQ(row[4] == "unsupported", !taken) << row[1] << ' ' << row[0];
      if (!taken) continue;
      EXPECT_EQ(row[3], row[0] == "miss" ? "miss" : "hit") << row[1] << ' ' << row[0];
      if (row[0] == "miss") {
        EXPECT_EQ(row[5], "") << row[1];
      }
      if (row[0] == "hit") {
        EXPECT_NEAR(toi_of(row[5]), 0.5, row[1] == "fcl-naive" ? 0.12 : 1e-2) << row[1];
        if (!row[6].empty()) {
          EXPECT_LE(toi_of(row[6]), 0.5) << row[1];
        }
        if (!row[7].empty()) {
          EXPECT_GE(toi_of(row[7]), 0.5) << row[1];
        }
        if (!row[8].empty()) {
          EXPECT_NEAR(toi_of(row[8]), 1, 1e-2) << row[1];  // from the box to the ball
        }
        if (!row[11].empty()) {
          EXPECT_NEAR(toi_of(row[11]), 1, 2e-2) << row[1];
        }
      }
    }
  }
}

TEST_F(CastCommand, ContactAtTheStart) {
  // The ball touches the box, and goes away.
  const std::string line =
      R"({"id":"x","a":{"shape":{"type":"box","half_extents":[1,1,1]}},"b":{"shape":)"
      R"({"type":"sphere","radius":1},"translation":[2,0,0],"displacement":[1,0,0]}})";
  folder.write("in.jsonl", line + "\n");
  for (const std::string start : {"counts", "approach"}) {
    const Ran ran =
        run_program("query " + path("in.jsonl") + " --cast gjk-ray-cast,exact --start " + start +
                    " --tolerance 1e-6 --max-iterations 50 --out " + path("out.csv"));
    ASSERT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(folder.path() / "out.csv", cast_columns);
    ASSERT_EQ(rows.size(), 2u);
    for (const auto& row : rows) {
      EXPECT_EQ(row[3], start == "counts" ? "hit" : "miss");
      EXPECT_EQ(row[5], start == "counts" ? "0" : "");
    }
  }
  const Ran unproven =
      run_program("query " + path("in.jsonl") + " --cast exact --start approach --out " +
                  path("out.csv") + " --save-certificates " + path("proofs.jsonl"));
  EXPECT_EQ(unproven.status, 2);
  EXPECT_THAT(unproven.text, testing::HasSubstr("expected --start counts"));
}

TEST_F(CastCommand, CertificatesAreSavedAndVerified) {
  folder.write("in.jsonl", box_and_moving_ball("hit", -4) + box_and_moving_ball("miss", -1) +
                               box_and_moving_ball("turning", -4, 0.5));
  const Ran saved = run_program("query " + path("in.jsonl") + " --cast closed-form --out " +
                                path("out.csv") + " --save-certificates " + path("proofs.jsonl"));
  ASSERT_EQ(saved.status, 0) << saved.text;
  EXPECT_THAT(saved.text, testing::HasSubstr("3 certificates in"));
  const Ran verified = run_program("query --certificates " + path("proofs.jsonl"));
  EXPECT_EQ(verified.status, 0) << verified.text;
  EXPECT_THAT(verified.text, testing::HasSubstr("3 certificates verified, 0 refused"));
  std::ifstream file(path("proofs.jsonl"));
  std::string proofs(std::istreambuf_iterator<char>(file), {});
  const auto place = proofs.find("\"answer\":\"hit\"");
  ASSERT_NE(place, std::string::npos);
  folder.write("changed.jsonl", proofs.replace(place, 14, "\"answer\":\"miss\""));
  const Ran refused = run_program("query --certificates " + path("changed.jsonl"));
  EXPECT_EQ(refused.status, 1) << refused.text;
  EXPECT_THAT(refused.text, testing::HasSubstr("changed.jsonl:1: hit: "));
  EXPECT_THAT(refused.text, testing::HasSubstr("2 certificates verified, 1 refused"));
  folder.write("broken.jsonl", proofs.substr(0, proofs.find("\"planes\"")) + "\"x\":0}\n");
  expect_refusal("--certificates " + path("broken.jsonl"), "broken.jsonl:1: no \"planes\"");
  expect_refusal("--certificates " + path("broken.jsonl") + " --cast all", "--certificates");
}

TEST_F(CastCommand, BadCasesAndRequests) {
  folder.write("in.jsonl",
               box_and_moving_ball("good", 1) +
                   R"({"id":"x","a":{"shape":{"type":"sphere","radius":1},)"
                   R"("displacement":[1,2]},"b":{"shape":{"type":"sphere","radius":1}}})");
  const std::string out = " --out " + path("out.csv");
  expect_refusal(
      path("in.jsonl") + " --cast all" + out,
      path("in.jsonl") + ":2: a.displacement: found an array of 2; expected an array of 3");
  folder.write("bad.jsonl",
               R"({"id":"x","a":{"shape":{"type":"sphere","radius":1},)"
               R"("rotation_vector":"z"},"b":{"shape":{"type":"sphere","radius":1}}})");
  expect_refusal(path("bad.jsonl") + " --cast all" + out, ":1: a.rotation_vector: found \"z\"");
  folder.write("good.jsonl", box_and_moving_ball("good", 1));
  expect_refusal(path("good.jsonl") + " --cast what" + out, "no cast is called 'what'");
  expect_refusal(path("good.jsonl") + " --cast all --start now" + out, "--start");
  expect_refusal(path("good.jsonl") + " --cast all --tolerance=0" + out, "--tolerance");
}

}  // namespace
}  // namespace touchstone
