// Tests of touchstone query.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>

#include "algorithms/registry.h"
#include "harness/files/cases.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::AnyOf;

const std::vector<std::string> query_columns = {
    "id",    "algorithm", "scalar",   "task",     "answer",     "status",       "distance",
    "lower", "upper",     "normal_x", "normal_y", "normal_z",   "a_x",          "a_y",
    "a_z",   "b_x",       "b_y",      "b_z",      "iterations", "support_calls"};

// Returns two balls of radius 1 whose centres are this far apart on x, in either order of their
// kinds with a box of equal reach.
std::string two_balls(const std::string& id, double distance) {
  return fmt::format(R"({{"id":"{}","a":{{"shape":{{"type":"sphere","radius":1}}}},)"
                     R"("b":{{"shape":{{"type":"sphere","radius":1}},"translation":[{},0,0]}}}})"
                     "\n",
                     id, distance);
}

std::string box_and_ball(const std::string& id, double distance) {
  return fmt::format(R"({{"id":"{}","a":{{"shape":{{"type":"box","half_extents":[1,1,1]}}}},)"
                     R"("b":{{"shape":{{"type":"sphere","radius":1}},"translation":[{},0,0]}}}})"
                     "\n",
                     id, distance);
}

std::vector<std::string> built_names() {
  std::vector<std::string> names;
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (is_built(entry.info)) names.push_back(entry.info.name);
  }
  return names;
}

double number(const std::string& text) {
  double value = NAN;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

class QueryCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }

  // Returns the rows of all algorithms that are built, after checks that hold for every algorithm.
  std::vector<std::vector<std::string>> query(const std::string& cases, const std::string& task,
                                              const std::string& more = "") {
    const auto file = folder.write("in.jsonl", cases);
    const Ran ran = run_program("query " + file.string() + " --narrow all --task " + task +
                                " --out " + path("out.csv") + more);
    EXPECT_EQ(ran.status, 0) << ran.text;
    std::string header;
    std::getline(std::ifstream(folder.path() / "out.csv"), header);
    EXPECT_EQ(header,
              "id,algorithm,scalar,task,answer,status,distance,lower,upper,normal_x,normal_y,"
              "normal_z,a_x,a_y,a_z,b_x,b_y,b_z,iterations,support_calls");
    const auto rows = read_rows(folder.path() / "out.csv", query_columns);
    const auto names = built_names();
    const std::vector<files::Case> read = files::read_cases(file);
    if (rows.size() != names.size() * read.size()) {
      ADD_FAILURE() << rows.size() << " rows for " << read.size() << " cases and " << names.size()
                    << " algorithms";
      return {};
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i][0], read[i / names.size()].id);
      EXPECT_EQ(rows[i][1], names[i % names.size()]);
      EXPECT_EQ(rows[i][3], task);
      EXPECT_THAT(rows[i][4], AnyOf("separated", "touching", "overlapping", "unknown"));
      if (rows[i][5] == "unsupported") {
        EXPECT_EQ(rows[i][4], "unknown");
      }
      if (task == "intersect") {
        EXPECT_EQ(rows[i][6], "");
      }
    }
    return rows;
  }

  void expect_refusal(const std::string& arguments, const std::string& text) {
    touchstone::expect_refusal("query " + arguments, text, folder);
  }

  TemporaryFolder folder;
};

TEST_F(QueryCommand, PlainCasesByEveryAlgorithm) {
  if (built_names().empty()) GTEST_SKIP() << "no narrow phase is built";
  const std::string cases = two_balls("apart", 3) + two_balls("in", 1.5) + box_and_ball("far", 4) +
                            box_and_ball("deep", 1.5);
  for (const char* scalar : {"double", "float"}) {
    std::set<std::string> answers;
    for (const auto& row : query(cases, "intersect", std::string(" --scalar ") + scalar)) {
      EXPECT_EQ(row[2], scalar);
      const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>(row[1]);
      const bool ball = row[0] == "apart" || row[0] == "in";
      const bool taken =
          offers(entry, scalar == std::string("float") ? Precision::float32 : Precision::float64) &&
          offers(entry, ball ? ShapeKind::sphere : ShapeKind::box, ShapeKind::sphere,
                 Task::intersect);
      EXPECT_EQ(row[5] == "unsupported", !taken) << row[1];
      if (row[5] != "ok" && row[5] != "not_reported") continue;
      EXPECT_EQ(row[4], row[0] == "apart" || row[0] == "far" ? "separated" : "overlapping")
          << row[1] << ' ' << row[0];
      answers.insert(row[4]);
    }
    EXPECT_LE(answers.size(), 2u);
  }
}

TEST_F(QueryCommand, DistancesWitnessesAndNormalsInTheOrderOfTheCase) {
  if (built_names().empty()) GTEST_SKIP() << "no narrow phase is built";
  // The box comes first although kinds are passed as (sphere, box).
  for (const auto& row : query(box_and_ball("far", 4) + box_and_ball("deep", 1.5), "distance")) {
    if (row[5] != "ok" && row[5] != "not_reported") continue;
    if (row[0] == "deep") {
      EXPECT_EQ(row[6], "") << row[1];
      EXPECT_EQ(row[12], "") << row[1];
      continue;
    }
    EXPECT_NEAR(number(row[6]), 2, 1e-3) << row[1];
    if (!row[9].empty()) {
      EXPECT_NEAR(number(row[9]), 1, 1e-2) << row[1];
    }
    if (!row[12].empty()) {
      EXPECT_NEAR(number(row[12]), 1, 1e-2) << row[1];
      EXPECT_NEAR(number(row[15]), 3, 1e-2) << row[1];
    }
  }
  for (const auto& row : query(box_and_ball("far", 4) + box_and_ball("deep", 1.5), "penetration")) {
    if (row[5] != "ok" && row[5] != "not_reported") continue;
    if (row[0] == "far") {
      EXPECT_EQ(row[6], "") << row[1];
      continue;
    }
    EXPECT_NEAR(number(row[6]), -0.5, 1e-2) << row[1];
    if (!row[9].empty()) {
      EXPECT_NEAR(number(row[9]), 1, 1e-1) << row[1];
    }
  }
}

TEST_F(QueryCommand, SignedGivesTheDistanceOrTheDepthUpToAMargin) {
  if (built_names().empty()) GTEST_SKIP() << "no narrow phase is built";
  const std::string cases =
      box_and_ball("far", 4) + box_and_ball("near", 2.5) + box_and_ball("deep", 1.5);
  for (const bool has_margin : {false, true}) {
    int distances = 0, depths = 0, beyond = 0;
    for (const auto& row : query(cases, "signed", has_margin ? " --margin 1" : "")) {
      if (row[5] != "ok" && row[5] != "not_reported") continue;
      if (row[0] == "far" && has_margin) {
        ++beyond;
        EXPECT_EQ(row[4], "separated") << row[1];
        EXPECT_EQ(row[6] + row[8] + row[9] + row[12], "") << row[1];
        continue;
      }
      ++(row[0] == "deep" ? depths : distances);
      const double truth = row[0] == "far" ? 2 : row[0] == "near" ? 0.5 : -0.5;
      EXPECT_NEAR(number(row[6]), truth, 1e-2) << row[1];
      if (!row[9].empty()) {
        EXPECT_NEAR(number(row[9]), 1, 1e-1) << row[1];
      }
    }
    EXPECT_GE(depths, 5);
    EXPECT_GE(distances, 5);
    EXPECT_EQ(beyond > 0, has_margin);
  }
}

TEST_F(QueryCommand, NamesAreTakenInTheirOrderAndOnce) {
  const auto names = built_names();
  if (names.size() < 2) GTEST_SKIP() << "too few narrow phases are built";
  folder.write("in.jsonl", two_balls("x", 3));
  const Ran ran = run_program("query " + path("in.jsonl") + " --narrow " + names[1] + "," +
                              names[0] + "," + names[1] + " --task intersect --out " +
                              path("out.csv") + " --tolerance 1e-4 --max-iterations 50");
  ASSERT_EQ(ran.status, 0) << ran.text;
  const auto rows = read_rows(folder.path() / "out.csv", {"algorithm"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0][0], names[1]);
  EXPECT_EQ(rows[1][0], names[0]);
}

TEST_F(QueryCommand, OneOfTheCases) {
  const auto names = built_names();
  if (names.empty()) GTEST_SKIP() << "no narrow phase is built";
  folder.write("in.jsonl", two_balls("x", 3) + two_balls("y y", 3) + two_balls("z", 1));
  const std::string command = path("in.jsonl") + " --narrow " + names[0] + " --task intersect";
  const Ran ran = run_program("query " + command + " --id 'y y' --out " + path("out.csv"));
  ASSERT_EQ(ran.status, 0) << ran.text;
  const auto rows = read_rows(folder.path() / "out.csv", {"id"});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0][0], "y y");
  expect_refusal(command + " --id w --out " + path("other.csv"), "has no case 'w'");
}

TEST_F(QueryCommand, BadCases) {
  if (built_names().empty()) GTEST_SKIP() << "no narrow phase is built";
  const auto refuse = [&](const std::string& line, const std::string& text) {
    folder.write("in.jsonl", two_balls("good", 1) + line);
    expect_refusal(path("in.jsonl") + " --narrow all --task intersect --out " + path("out.csv"),
                   path("in.jsonl") + ":2: " + text);
  };
  const auto shape = [](const std::string& s) {
    return R"({"id":"x","a":{"shape":)" + s + R"(},"b":{"shape":{"type":"sphere","radius":1}}})";
  };
  refuse("{\"id\":", "malformed JSON");
  refuse("{}", "no \"a\"");
  refuse(R"({"id":3})", "id: found 3; expected a string");
  refuse(R"({"id":"x"})", "no \"a\"");
  refuse(shape(R"({"type":"sphere","radius":NaN})"), "malformed JSON");
  refuse(shape(R"({"type":"sphere","radius":1e999})"), "malformed JSON");
  refuse(shape(R"({"type":"sphere","radius":-1})"), "a.shape.radius: found -1");
  refuse(shape(R"({"type":"hull","vertices":[]})"), "a.shape.vertices: found an array of 0");
  refuse(shape(R"({"type":"blob"})"), "a.shape.type: found \"blob\"");
}

TEST_F(QueryCommand, BadRequests) {
  const auto names = built_names();
  if (names.empty()) GTEST_SKIP() << "no narrow phase is built";
  folder.write("in.jsonl", two_balls("good", 1));
  const std::string in = path("in.jsonl");
  const std::string narrow = " --narrow " + names[0];
  const std::string task = " --task intersect";
  const std::string out = " --out " + path("out.csv");
  expect_refusal(narrow + task + out, "FILE is missing");
  expect_refusal(in + " --narrow what" + task + out,
                 "no narrow phase is called 'what'; expected some of all, ");
  expect_refusal(in + narrow + " --task touch" + out, "--task");
  expect_refusal(in + narrow + task + " --margin -1" + out, "--margin");
  expect_refusal(in + narrow + task + " --scalar half" + out, "--scalar");
  for (const char* value : {"0", "-1", "nan", "inf", "x"}) {
    expect_refusal(in + narrow + task + " --tolerance=" + value + out, "--tolerance");
    expect_refusal(in + narrow + task + " --time-limit=" + value + out, "--time-limit");
    expect_refusal(in + narrow + task + " --max-iterations=" + value + out, "--max-iterations");
  }
  expect_refusal(path("none.jsonl") + narrow + task + out, "none.jsonl: No such file");
  expect_refusal(folder.path().string() + " --kind pair" + narrow + task + out, "a directory");
  expect_refusal(in + narrow + task + " --out " + path("none/out.csv"), "No such file");
  expect_refusal(in + narrow + task + " --out " + folder.path().string(), "Is a directory");
  expect_refusal(in + narrow + task + " --out /dev/full", "No space left on device");
  folder.write("in.jsonl", "\n");
  expect_refusal(in + narrow + task + out, in + ":1: no case");
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (is_built(entry.info)) continue;
    expect_refusal(in + " --narrow " + entry.info.name + task + out,
                   "is not built, because " + entry.info.reason);
  }
}

// The cases are those that broke libraries, if they are present.
TEST_F(QueryCommand, SharedCases) {
  const char* const shared = std::getenv("TOUCHSTONE_SHARED");
  if (shared == nullptr) GTEST_SKIP() << "TOUCHSTONE_SHARED is not set";
  if (built_names().empty()) GTEST_SKIP() << "no narrow phase is built";
  std::ifstream stream(std::string(shared) + "/cases/pairs.jsonl");
  ASSERT_TRUE(stream);
  const std::string cases{std::istreambuf_iterator<char>(stream), {}};
  for (const char* task : {"intersect", "distance", "penetration"}) {
    query(cases, task, " --time-limit 1");
  }
}

}  // namespace
}  // namespace touchstone
