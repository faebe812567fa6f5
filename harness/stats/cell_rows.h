// The rows of a cell run's files; each declares its columns once.
#pragma once

#include <cstdint>
#include <string>

#include "algorithms/core/outcome.h"
#include "harness/kinds/grade.h"
#include "harness/record/row.h"

namespace touchstone::stats {

// set_grades.csv: one algorithm's answers to one cell. `cases` and the other counts without a column stay 0.
struct GradeRow : kinds::GradeCount {
  std::string group, cell, algorithm, origin;
  bool approximate = false;
  std::int64_t queries = 0;
  std::string truth;
  std::int64_t graded = 0;
  double error = Outcome::none;
  std::int64_t hits = -1, true_hits = -1;
  std::string hit_hash, status;

  bool is_right() const { return silent() == 0; }
};
template <record::row_of<GradeRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("group", row.group, "Group of cells, one table.");
  visit("cell", row.cell, "Name of the cell.");
  visit("algorithm", row.algorithm, "Name of the algorithm, with the scalar where it has several.");
  visit("origin", row.origin, "ours, peer or oracle.");
  visit("approximate", row.approximate, "1: its errors are known, and are no fault.");
  visit("queries", row.queries, "Queries of the cell.");
  visit("truth", row.truth,
        "Who says what is right: `oracle`, exact arithmetic; `proven-fast`, a method of ours whose "
        "verdicts are proven; `all-pairs`, every pair of boxes.");
  visit("graded", row.graded, "Queries that were held against the truth, the first ones.");
  kinds::grade_columns(row, visit);
  visit("unresolved", row.unresolved, "Queries whose exact answer is not known.");
  visit("error", row.error, "Greatest error of a number; empty where there is none.");
  visit("hits", row.hits, "Of motion: pairs of bodies that it found to touch; else -1.");
  visit("true_hits", row.true_hits, "Of motion: pairs of bodies that touch; else -1.");
  visit("hit_hash", row.hit_hash,
        "Of motion: hash of the pairs that it found, step by step; equal where they are.");
  visit("status", row.status,
        "`ok`, or how it ended: crashed, timed_out; unsupported, if it takes not all queries. In "
        "set_times.csv also `wrong`: another answer in a sample than the one that was graded.");
}

// set_times.csv: one algorithm in one cell.
struct CellTimeRow {
  GradeRow grade;
  double seconds = Outcome::none, low = Outcome::none, high = Outcome::none;
  std::int64_t samples = 0;
  bool best = false;
};
template <record::row_of<CellTimeRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  columns(row.grade, visit);
  visit("seconds", record::rounded(row.seconds, 4),
        "Time of a query, seconds: the median over the squares, of which each is the median of its "
        "rounds. Empty if it was not timed, or lost while it was.");
  visit("seconds_low", record::rounded(row.low, 4), "Lower end of its interval at 95 %.");
  visit("seconds_high", record::rounded(row.high, 4), "Upper end.");
  visit("samples", row.samples, "Samples that count.");
  visit("best", row.best, "1: the fastest of ours, or of the peers, that is right in this cell.");
}

// set_best.csv: the fastest of ours that is right, against the fastest peer that is.
struct CellBestRow {
  std::string group, cell, ours, peer;
  double ratio = Outcome::none, low = Outcome::none, high = Outcome::none;
  std::string baseline;
  double twin = Outcome::none, twin_low = Outcome::none, twin_high = Outcome::none;
};
template <record::row_of<CellBestRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("group", row.group, "Group of cells, one table.");
  visit("cell", row.cell, "Name of the cell.");
  visit("ours", row.ours, "The fastest of ours that is right.");
  visit("peer", row.peer, "The fastest peer that is right; empty if none is.");
  visit("ratio", record::rounded(row.ratio, 4),
        "Time of the peer over ours: the median over the squares.");
  visit("ratio_low", record::rounded(row.low, 4), "Lower end of its interval at 95 %.");
  visit("ratio_high", record::rounded(row.high, 4), "Upper end.");
  visit("baseline", row.baseline, "The algorithm that was registered twice (A/A control).");
  visit("twin_ratio", record::rounded(row.twin, 4),
        "Time of its twin over its own, which shows the error of the measurement.");
  visit("twin_low", record::rounded(row.twin_low, 4), "Lower end of its interval at 95 %.");
  visit("twin_high", record::rounded(row.twin_high, 4), "Upper end.");
}

// set_speed_ups.csv: an algorithm at several threads, against itself at one.
struct CellSpeedUpRow {
  std::string group, cell, algorithm, origin;
  std::int64_t threads = 0;
  double speed_up = Outcome::none, low = Outcome::none, high = Outcome::none;
};
template <record::row_of<CellSpeedUpRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("group", row.group, "Group of cells, one table.");
  visit("cell", row.cell, "Name of the cell, without the threads.");
  visit("algorithm", row.algorithm, "Name of the algorithm, with the scalar where it has several.");
  visit("origin", row.origin, "ours, peer or oracle.");
  visit("threads", row.threads, "Threads.");
  visit("speed_up", record::rounded(row.speed_up, 4),
        "Time at one thread over that at these: the median of squares that both share.");
  visit("speed_up_low", record::rounded(row.low, 4), "Lower end of its interval at 95 %.");
  visit("speed_up_high", record::rounded(row.high, 4), "Upper end.");
}

}  // namespace touchstone::stats
