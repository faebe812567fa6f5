// Tests of touchstone query with moving vertices, faces and edges.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> ccd_columns = {"query",  "algorithm",   "answer",    "toi",
                                              "status", "free_before", "contact_by"};

// A vertex falls through a resting face from 1 to -1, and one passes beside it.
std::string falling(const std::string& truth_hit, const std::string& truth_miss) {
  const auto rows = [](const std::string& x, const std::string& truth) {
    std::string text;
    for (const char* z : {"1", "-1"}) {
      text += x + ",1,0,1," + z + ",1" + truth + "\n";
      for (const char* corner : {"-1,1,-1,1", "1,1,-1,1", "0,1,1,1"}) {
        text += std::string(corner) + ",0,1" + truth + "\n";
      }
    }
    return text;
  };
  return rows("0", truth_hit) + rows("5", truth_miss);
}

class CcdCommand : public ::testing::Test {
 protected:
  Ran run(const std::filesystem::path& file, const std::string& more = "--ccd all") const {
    return run_program("query " + file.string() + " --features vertex-face " + more + " --out " +
                       out().string());
  }
  void refuse(const std::string& text, const std::string& expected, const std::string& more = "") {
    const auto file = folder.write("in.csv", text);
    expect_refusal("query " + file.string() + " --kind feature --features vertex-face --out " +
                       out().string() + " " + more,
                   expected, folder);
  }
  std::filesystem::path out() const { return folder.path() / "out.csv"; }
  TemporaryFolder folder;
};

// The larger public set has all queries of a scene in one folder, and their truths in another.
TEST_F(CcdCommand, QueriesAndTruthsOfTheLargerSet) {
  const auto put = [&](const std::string& path, const std::string& text) {
    const std::filesystem::path file = folder.path() / "data" / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  };
  put("cloth/queries/12vf.csv", falling("", ""));
  put("cloth/queries/13vf.csv", falling("", ""));
  put("cloth/mma_bool/12vf_mma_bool.json", "[true, false]");
  put("cloth/mma_bool/13vf_mma_bool.json", "[true, false]");
  const std::string ask = "query " + (folder.path() / "data").string() + " --out " + out().string();
  const Ran ran = run_program(ask + " --ccd exact");
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, ::testing::ContainsRegex("cloth +vertex-face +4 +exact +2 +2 +0 +0 +0"));
  put("cloth/mma_bool/13vf_mma_bool.json", "[true, true]");
  EXPECT_EQ(run_program(ask + " --ccd exact").status, 1);
  put("cloth/mma_bool/13vf_mma_bool.json", "[true]");
  const Ran short_of_one = run_program(ask + " --ccd exact");
  EXPECT_EQ(short_of_one.status, 2);
  EXPECT_THAT(short_of_one.text, ::testing::HasSubstr("1 truths; expected an array of true or"));
}

TEST_F(CcdCommand, AFolderIsAskedSceneByScene) {
  const auto put = [&](const std::string& path, const std::string& text) {
    const std::filesystem::path file = folder.path() / "data" / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  };
  put("spikes/vertex-face/data_0_0.csv", falling(",1", ",0"));
  put("spikes/vertex-face/data_0_1.csv", falling(",1", ",0"));
  put("cloth/vertex-face/data_0_0.csv", falling(",1", ",0"));
  put("cloth/README.md", "no queries");
  const std::string ask = "query " + (folder.path() / "data").string() + " --out " + out().string();
  const Ran ran = run_program(ask + " --ccd exact");
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, ::testing::ContainsRegex("cloth +vertex-face +2 +exact +1 +1 +0 +0 +0"));
  EXPECT_THAT(ran.text, ::testing::ContainsRegex("spikes +vertex-face +4 +exact +2 +2 +0 +0 +0"));
  std::vector<std::string> columns = ccd_columns;
  columns.insert(columns.end(), {"iterations", "scene", "kind", "file"});
  const auto rows = read_rows(out(), columns);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows.front()[8], "cloth");
  EXPECT_EQ(rows.back()[10], "data_0_1.csv");
  // Truths that are wrong are contacts that are missed.
  put("cloth/vertex-face/data_0_0.csv", falling(",1", ",1"));
  EXPECT_EQ(run_program(ask + " --ccd exact").status, 1);
  expect_refusal(ask + " --features edge-edge", "--features", folder);
}

TEST_F(CcdCommand, EveryAlgorithmGivesTheRowsOfTheContract) {
  for (const bool has_truth : {true, false}) {
    const auto file = folder.write("in.csv", has_truth ? falling(",1", ",0") : falling("", ""));
    const Ran ran = run(file);
    ASSERT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(out(), ccd_columns);
    std::size_t next = 0;
    for (int query = 0; query < 2; ++query) {
      for (const CcdEntry& entry : registry::entries<CcdEntry>()) {
        if (!is_built(entry.info)) continue;
        ASSERT_LT(next, rows.size());
        const auto& row = rows[next++];
        EXPECT_EQ(row[0], std::to_string(query));
        EXPECT_EQ(row[1], entry.info.name);
        EXPECT_EQ(row[2], query == 0 ? "hit" : "miss") << row[1];
        EXPECT_EQ(row[4], entry.info.origin == Origin::peer ? "not_reported" : "ok");
        if (query == 1) {
          EXPECT_EQ(row[3], "");
          continue;
        }
        EXPECT_NEAR(std::stod(row[3]), 0.5, 1e-5) << row[1];
        if (entry.info.origin == Origin::peer) continue;
        EXPECT_LE(std::stod(row[5]), 0.5);
        EXPECT_LE(std::stod(row[5]), std::stod(row[6]));
      }
    }
    EXPECT_EQ(next, rows.size());
  }
}

TEST_F(CcdCommand, ReadsNumbersAndCountsWhatIsRounded) {
  std::string text;
  for (const char* z : {"1.5", "-1e0"}) {
    text += fmt::format("0,0,{},1\n-1,-1,0,1\n1,-1,0,1\n0,1,0,1\n", z);
  }
  const Ran ran = run(folder.write("in.csv", text), "--ccd exact");
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_NEAR(std::stod(read_rows(out(), ccd_columns)[0][3]), 0.6, 1e-12);
  const Ran marked = run(folder.write("in.csv", "\xef\xbb\xbf" + text), "--ccd exact");
  ASSERT_EQ(marked.status, 0) << marked.text;
  EXPECT_NEAR(std::stod(read_rows(out(), ccd_columns)[0][3]), 0.6, 1e-12);
  std::string thirds = falling("", "");
  thirds.replace(0, 3, "1,3");
  const Ran rounded = run(folder.write("in.csv", thirds), "--ccd exact");
  EXPECT_EQ(rounded.status, 0);
  EXPECT_THAT(rounded.text, HasSubstr("1 coordinates are not doubles, and were rounded"));
  // These are doubles with more digits than an integer of the machine.
  std::string fine = falling("", "");
  fine.replace(0, 3, "1,1298074214633706907132624082305024");
  const Ran exact = run(folder.write("in.csv", fine), "--ccd exact");
  EXPECT_EQ(exact.status, 0);
  EXPECT_THAT(exact.text, testing::Not(HasSubstr("rounded")));
}

// The vertex falls onto the line through two corners, all at the same x, which is a double times 3^42
// over 3^42, or times 10^400.
TEST_F(CcdCommand, AFractionIsRoundedOnce) {
  const std::string tenth = "3602879701896397,36028797018963968", zeros(400, '0');
  for (const std::string& other :
       {std::string("394223454943948352025246800766869973,3942234549439483301414489744643981312"),
        "3602879701896397" + zeros + ",36028797018963968" + zeros}) {
    std::string text;
    for (const char* z : {"1", "-1"}) {
      text +=
          fmt::format("{0},0,1,{1},1\n{2},-1,1,0,1\n{2},1,1,0,1\n2,1,0,1,0,1\n", other, z, tenth);
    }
    const Ran ran = run(folder.write("in.csv", text), "--ccd exact");
    ASSERT_EQ(ran.status, 0) << ran.text;
    EXPECT_THAT(ran.text, testing::Not(HasSubstr("rounded")));
    EXPECT_EQ(read_rows(out(), ccd_columns)[0][2], "hit");
  }
  std::string far = falling("", "");
  far.replace(0, 3, "1" + zeros + ",1");
  refuse(far, "expected a number within the range of doubles");
}

TEST_F(CcdCommand, AMissedContactOfOursIsAnError) {
  // The truth of the second query is wrong, so that all of ours miss it.
  const auto file = folder.write("in.csv", falling(",1", ",1"));
  EXPECT_EQ(run(file).status, 1);
  EXPECT_EQ(run(file, "--ccd exact").status, 1);
  if (is_built(registry::find<CcdEntry>("fcl-cubic")->info)) {
    EXPECT_EQ(run(file, "--ccd fcl-cubic").status, 0);
  }
  EXPECT_EQ(run(folder.write("in.csv", falling(",0", ",0"))).status, 0);
}

TEST_F(CcdCommand, SeparationIsPassedOn) {
  const auto file = folder.write("in.csv", falling("", ""));
  const Ran ran = run(file, "--ccd directional-advancement,exact --separation 0.5");
  ASSERT_EQ(ran.status, 0) << ran.text;
  const auto rows = read_rows(out(), ccd_columns);
  EXPECT_NEAR(std::stod(rows[0][3]), 0.25, 1e-5);
  EXPECT_EQ(rows[1][4], "ok");
  EXPECT_EQ(std::stod(rows[1][3]), 0.25);
}

TEST_F(CcdCommand, RefusesBadInputWithItsPlace) {
  const std::string good = falling(",1", ",0");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  refuse("", "expected eight rows");
  refuse(good.substr(0, good.rfind('\n', good.size() - 2) + 1), "found 7 rows of the last query");
  refuse(changed("0,1,0,1,1,1,1", "0,1,0,1,1,1"), "in.csv:2: 7 columns; expected 6");
  refuse(changed("0,1,0,1,1,1,1", "0,1,0,1,1"), "in.csv:1: 5 columns");
  refuse(changed("0,1,0,1,1,1,1", "x,1,0,1,1,1,1"), "in.csv:1: found 'x'; expected an integer");
  refuse(changed("0,1,0,1,1,1,1", "0,0,0,1,1,1,1"), "found the denominator 0");
  refuse(changed("0,1,0,1,1,1,1", "0,1,0,1,1,1,2"), "found the truth '2'; expected 0 or 1");
  refuse(changed("0,1,0,1,1,1,1", "0,1,0,1,1,1,0"), "in.csv:2: found another truth");
  const std::string many(2000000, 'x');
  refuse(changed("0,1,0,1,1,1,1", many + ",1,0,1,1,1,1"),
         "found '" + many.substr(0, 80) + "...'; expected");
  refuse("0,0,nan\n", "in.csv:1: found 'nan'; expected a number");
  refuse(good, "'gjk'", "--ccd gjk");
  refuse(good, "--tolerance", "--tolerance -1");
  expect_refusal("query no.csv --features edge-edge --out " + out().string(), "no.csv", folder);
}

}  // namespace
}  // namespace touchstone
