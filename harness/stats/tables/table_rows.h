// The columns of the tables' CSV files.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <utility>

#include "harness/stats/samples.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

inline std::string_view unit_of(const SetKey& key) { return key.narrow() ? "query" : "frame"; }

// times.csv
template <record::row_of<TimeRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The algorithm's label.");
  visit("origin", row.origin, "Origin of the algorithm.");
  visit("unit", record::derived([&] { return unit_of(row.key); }),
        "What the times are of: `query` for a narrow phase, `frame` for a broad phase.");
  interval_columns("seconds", row.seconds,
                   "Time of a unit, seconds: the median over the squares. A square is the median "
                   "of its rounds, a broad phase's time that of build or update and find_pairs "
                   "together.",
                   visit);
  visit("minimum", row.minimum, "Least time of all samples, noisy ones too, seconds.");
  for (const record::Phase phase : base::enumerators<record::Phase>) {
    if (phase == record::Phase::answer) continue;  // of timed sets, which have tables of their own
    visit(to_string(phase), row.parts[static_cast<std::size_t>(phase)],
          phase == record::Phase::convert
              ? "Median of the checked frames: the part of a peer's build or update that converts "
                "the boxes to its own types, seconds."
              : "Median of the phase, seconds.");
  }
  visit("squares", row.seconds.n, "Number of squares.");
  visit("samples", row.samples, "Number of samples.");
  visit("noisy", row.noisy, "Number of noisy samples.");
  visit("outliers", row.outliers,
        "Number of samples with a modified z above 3.5; flagged, never left out.");
  visit("wrong", row.wrong, "1 if it departs from the pairs of `naive`, or from an exact answer.");
  visit("failure", row.failure, "crashed, timed_out, unsupported or wrong; empty for none.");
  visit("worst_frame", row.worst_frame,
        "The longest frame of all windows, seconds; a window that was played several times counts "
        "with the least of its longest frames. Empty for narrow phases, and if it is not known.");
}

// Visits the columns of a ratio and its squares.
template <class Row, class Visit>
void ratio_columns(Row& row, const std::string& what, Visit& visit) {
  interval_columns("ratio", row.ratio, what, visit);
  visit("squares", row.ratio.n, "Number of squares.");
}

// ratios.csv and library_ratios.csv. `band` widens the intervals to the stated bands.
template <record::row_of<RatioRow> Row, class Visit>
void columns(Row& row, Visit visit, double band) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The algorithm's label.");
  visit("baseline", row.baseline, "The algorithm that its time is compared with.");
  visit("canary", row.canary, "1 for the baseline against its twin; its true ratio is 1.");
  ratio_columns(
      row,
      "Time over the baseline's: the median of paired log ratios over the squares. Without "
      "an interval it decides nothing.",
      visit);
  visit("band_low", record::derived([&, band] { return row.ratio.low / band; }),
        "Lower end of the band in which `reproduce` wants the interval to lie.");
  visit("band_high", record::derived([&, band] { return row.ratio.high * band; }),
        "Upper end of that band.");
  visit("suspect", row.suspect,
        "1 where the baseline differs from its twin by more than the campaign's width: none of the "
        "set's times is reliable.");
}

// winners.csv
template <record::row_of<WinnerRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("batch", record::newer(row.batch),
        "Pairs of a call, of all that the row compares, if the campaign sets it; empty: 256.");
  visit("winner", row.winner, "The fastest of those that answer right.");
  visit("runner_up", row.runner_up, "The next.");
  ratio_columns(
      row,
      "The runner-up's time over the winner's; where the interval is not above 1, the two "
      "are not told apart.",
      visit);
  visit("suspect", row.suspect, "As in ratios.csv.");
}

// exponents.csv
template <record::row_of<ExponentRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The algorithm's label.");
  visit("exponent", row.law.exponent,
        "Time = factor * bodies ^ exponent, by least squares on the logarithms of the medians.");
  visit("exponent_low", row.law.low,
        "Lower end of Student's 95 % interval, which there is from three counts up.");
  visit("exponent_high", row.law.high, "Upper end of that interval.");
  visit("factor", row.law.factor, "The factor, seconds.");
  visit("counts", record::derived([&] { return fmt::format("{}", fmt::join(row.counts, " ")); }),
        "The numbers of bodies.");
  visit("exponent_of_many", row.law_of_many.exponent,
        fmt::format("The exponent of the counts from {} on.", many_bodies));
}

// speed_ups.csv
template <record::row_of<SpeedUpRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The algorithm's label.");
  visit("base_threads", row.base_threads, "The fewest threads.");
  interval_columns("speed_up", row.speed_up,
                   "Time with the fewest threads over the time with these, by Hodges and Lehmann.",
                   visit);
}

// executors.csv
template <record::row_of<ExecutorRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.algorithm, "The algorithm's label, without the executor.");
  visit("executor", row.executor, "Whose threads it ran on.");
  visit("base", row.base, "The executor that the ratio is to.");
  interval_columns("ratio", row.ratio, "Its time over that on the base.", visit);
  visit("suspect", row.suspect, "As in ratios.csv.");
}

// agreement.csv
template <record::row_of<AgreementRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The narrow phase's label.");
  visit("origin", row.origin, "Origin of the algorithm.");
  visit("queries", row.queries, "Queries over all verified frames.");
  visit("right", row.right, "Answers on the right side of contact.");
  visit("wrong", row.wrong, "Answers on the wrong side of contact.");
  visit("failed", row.failed, "Queries that the algorithm said it could not answer.");
  visit("unanswered", row.unanswered,
        "Queries that lack an answer of the algorithm or the oracle.");
  visit("worst_error", row.worst_error,
        "Greatest error of a distance or depth, as a part of the pair's size.");
  visit("depth_bound", row.depth_is_bound, "1 where the depth is an upper bound by design.");
}

// work.csv
template <record::row_of<WorkRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The algorithm's label.");
  visit("origin", row.origin, "Origin of the algorithm.");
  visit("frames", row.frames, "Number of verified frames.");
  visit("queries", row.queries, "Queries in them; of a broad phase, pairs found.");
  visit("box_tests_a_body", row.box_tests, "Box tests for a body and frame.");
  visit("node_visits_a_body", row.node_visits, "Node visits for a body and frame.");
  visit("candidates_a_pair", row.candidates, "Candidates for each pair that was found.");
  visit("bytes_a_body", row.bytes, "Memory held for each body, bytes.");
  visit("iterations_a_query", row.iterations, "Iterations of a query.");
  visit("support_calls_a_query", row.support_calls, "Calls of the support function of a query.");
  visit("unit", record::derived([&] { return unit_of(row.key); }),
        "What the allocations are of: `query` or `frame`.");
  visit("allocations", row.allocations, "Allocations of a unit, after the warm-up.");
  visit("allocated_bytes", row.allocated_bytes, "Bytes of these allocations.");
}

// broad_best.csv
template <record::row_of<BroadBestRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("ours", row.ours.label, "The fastest of ours that is right.");
  visit("ours_seconds", row.ours.seconds, "Its time of a frame, seconds.");
  const auto other = [&](const std::string& name, auto& best, const char* what) {
    visit(name, best.label, what);
    visit(name + "_seconds", best.seconds, "Its time of a frame, seconds.");
    interval_columns(name + "_ratio", best.ratio, "Its time over that of ours.", visit);
  };
  other("peer", row.peer, "The fastest library that is right.");
  other("bullet_or_fcl", row.bullet_or_fcl, "The fastest of Bullet and FCL.");
  interval_columns("over_limit", row.over_limit, "Time of ours over that of `limit`.", visit);
  visit("bytes_a_body", row.bytes_a_body, "Memory of ours for each body, bytes.");
  visit("base_threads", record::nonzero(row.base_threads),
        "The fewest threads, of our speed-up; empty where there is none.");
  interval_columns("speed_up", row.speed_up, "Speed-up of ours over the fewest threads.", visit);
  visit("exponent_of_many", row.exponent, "Exponent of ours, as in exponents.csv.");
  visit("worst_frame", row.worst_frame, "The longest frame of ours, as in times.csv.");
}

// narrow_best.csv
template <record::row_of<NarrowBestRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  const auto best = [&](const std::string& name, auto& one, const char* what) {
    visit(name, one.label, what);
    visit(name + "_seconds", one.seconds, "Its time of a query, seconds.");
    visit(name + "_queries", one.queries, "Its queries, as in agreement.csv.");
    visit(name + "_wrong", one.wrong, "Its wrong answers.");
    visit(name + "_failed", one.failed, "Queries that it said it could not answer.");
    visit(name + "_worst_error", one.worst_error, "Its greatest error, as in agreement.csv.");
    interval_columns(name + "_ratio", one.ratio, "Its time over that of ours.", visit);
  };
  visit("batch", record::newer(row.batch),
        "Pairs of a call, of all that the row compares, if the campaign sets it; empty: 256.");
  best("ours", row.ours, "The fastest of ours that is right.");
  best("right_peer", row.right_peer, "The fastest library that is right.");
  best("any_peer", row.any_peer, "The fastest library, right or not.");
}

}  // namespace touchstone::stats
