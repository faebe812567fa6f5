// The cases of datasets/defects: the exact answer of each is the one that its file states, and proven.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

const std::filesystem::path defects = std::filesystem::path(project_folder) / "datasets/defects";

TEST(Defects, CastsHaveTheStatedAnswers) {
  const TemporaryFolder folder;
  int files = 0, hits = 0, misses = 0;
  for (const auto& entry : std::filesystem::directory_iterator(defects)) {
    if (entry.path().extension() != ".jsonl") continue;
    ++files;
    const std::string out = (folder.path() / "out.csv").string();
    const std::string proofs = (folder.path() / "proofs.jsonl").string();
    const Ran ran = run_program(fmt::format(
        "query {} --kind cast --cast exact,gjk-ray-cast --out {} --save-certificates {}",
        entry.path().string(), out, proofs));
    ASSERT_EQ(ran.status, 0) << ran.text;
    EXPECT_EQ(run_program("query --certificates " + proofs).status, 0) << entry.path();
    const auto rows = read_rows(out, {"id", "algorithm", "answer", "toi"});
    std::ifstream lines(entry.path());
    std::size_t next = 0;
    for (std::string line; std::getline(lines, line);) {
      const auto c = nlohmann::json::parse(line);
      const std::string answer = c["expect"]["answer"];
      for (const double tolerance : {1e-12, 1e-8}) {
        ASSERT_LT(next, rows.size());
        const auto& row = rows[next++];
        EXPECT_EQ(row[0], c["id"]);
        EXPECT_EQ(row[2], answer) << row[0] << " by " << row[1];
        if (answer == "hit") {
          EXPECT_NEAR(std::stod(row[3]), c["expect"]["toi"], tolerance) << row[0];
        }
      }
      ++(answer == "hit" ? hits : misses);
    }
    EXPECT_EQ(next, rows.size());
  }
  EXPECT_GE(files, 5);
  EXPECT_GE(hits, 10);
  EXPECT_GE(misses, 1);
}

TEST(Defects, QueriesHaveTheStatedAnswers) {
  const TemporaryFolder folder;
  for (const std::string kind : {"vertex-face", "edge-edge"}) {
    std::string name = kind;
    name[name.find('-')] = '_';
    const auto file = defects / ("fcl_cubic_" + name + ".csv");
    const auto out = folder.path() / "out.csv";
    // It ends with another status if a stated contact is missed.
    const Ran ran = run_program(fmt::format(
        "query {} --features {} --ccd exact,directional-advancement,additive-advancement --out {}",
        file.string(), kind, out.string()));
    ASSERT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(out, {"algorithm", "answer"});
    EXPECT_GE(rows.size(), 12u);
    for (const auto& row : rows) EXPECT_EQ(row[1], "hit") << row[0];
  }
}

}  // namespace
}  // namespace touchstone
