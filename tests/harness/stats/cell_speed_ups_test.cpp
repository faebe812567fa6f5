// Tests what several threads bring, of cells that differ in them alone.
#include "harness/stats/cell_tables.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/record/raw_row.h"

namespace touchstone {
namespace {

stats::CellTimes cell(const std::string& group, const std::string& name,
                      const std::vector<double>& seconds, std::int64_t missed = 0) {
  stats::CellTimes times;
  times.name = {group, name};
  stats::CellTimeRow& row = times.rows.emplace_back();
  row.grade.group = group;
  row.grade.cell = name;
  row.grade.algorithm = "tree";
  row.grade.origin = "ours";
  row.grade.missed = missed;
  row.grade.status = "ok";
  for (std::size_t square = 0; square < seconds.size(); ++square) {
    record::RawRow sample;
    sample.query_kind = "ray";
    sample.algorithm = "tree";
    sample.process = 0;
    sample.square = static_cast<std::int64_t>(square);
    sample.round = 0;
    sample.pair_count = 1;
    sample.phase = record::Phase::answer;
    sample.seconds = seconds[square];
    stats::add_sample(times.contestants["tree"], sample);
  }
  return times;
}

TEST(CellSpeedUps, AreMediansOfRoundsThatBothShare) {
  const std::vector<stats::CellTimes> cells = {
      cell("one", "pairs", {4, 6, 8, 4, 4, 4}), cell("one", "pairs, 2 threads", {2, 3, 4, 2, 1, 8}),
      cell("one", "pairs, 3 threads", {1, 1, 1, 1, 1, 1}, 1),
      cell("two", "1 thread", {3, 3, 3, 3, 3, 3}), cell("two", "4 threads", {1, 1, 1, 1, 1, 1}),
      // Neither has one to compare with.
      cell("three", "moved, 2 threads", {1, 1, 1, 1, 1, 1}), cell("three", "pairs", {1, 1, 1, 1}),
      cell("four", "about threads", {1, 1, 1, 1})};
  const std::vector<stats::CellSpeedUpRow> rows = stats::cell_speed_ups(cells);
  ASSERT_EQ(rows.size(), 2U) << "what is wrong has no row";
  EXPECT_EQ(rows[0].group, "one");
  EXPECT_EQ(rows[0].cell, "pairs");
  EXPECT_EQ(rows[0].algorithm, "tree");
  EXPECT_EQ(rows[0].threads, 2);
  EXPECT_NEAR(rows[0].speed_up, 2, 1e-12);
  EXPECT_LT(rows[0].low, 2);
  EXPECT_GT(rows[0].high, 2);
  EXPECT_EQ(rows[1].group, "two");
  EXPECT_EQ(rows[1].cell, "");
  EXPECT_EQ(rows[1].threads, 4);
  EXPECT_NEAR(rows[1].speed_up, 3, 1e-12);
}

}  // namespace
}  // namespace touchstone
