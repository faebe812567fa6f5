// The columns of a soak's files.
#pragma once

#include "harness/check/soak/soak.h"
#include "harness/record/row.h"

namespace touchstone::check {

// A row of jobs.csv: an algorithm's counts in one job.
struct SoakJobRow {
  std::uint32_t entry = 0, regime = 0;  // places in the request
  Precision scalar{};
  std::uint64_t round = 0;
  SoakCount count;
};

// A row of soak.csv: an algorithm's counts in one regime.
struct SoakRow {
  std::uint32_t entry = 0, regime = 0;  // places in the request
  Precision scalar{};
  std::uint64_t seed = 0;
  std::int64_t drawn = 0;
  SoakCount count;
  std::string program;
};

template <class Row, class Visit>
void subject_columns(Row& row, Visit& visit, const CheckSubjects& subjects) {
  visit("algorithm", record::place_in(row.entry, subjects.narrow.size(), subjects.narrow_name()),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
  visit("regime", record::place_in(row.regime, subjects.regimes.size(), subjects.regime_name()),
        "Regime of the pairs.");
}

template <record::row_of<SoakCount> Count, class Visit>
void count_columns(Count& count, Visit& visit) {
  visit("pairs", count.pairs, "Pairs that it was asked about.");
  visit("separated", count.separated, "Pairs that are apart.");
  visit("touching", count.touching, "Pairs that touch exactly.");
  visit("overlapping", count.overlapping, "Pairs that overlap.");
  visit("unresolved", count.unresolved, "Pairs whose side of contact the oracle leaves open.");
  visit("silent", count.silent, "Answers on the wrong side of contact that nothing tells.");
  visit("honest", count.honest,
        "Gave up: the answer is unknown, or the status says that it is not to be trusted.");
  visit("lost", count.lost, "Failed: crashed, or gave no answer in time.");
  visit("first_wrong", record::with_sign(count.first_wrong),
        "First case that was silently wrong or failed; -1 where there is none.");
}

template <record::row_of<SoakJobRow> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  subject_columns(row, visit, subjects);
  visit("round", row.round, "Round of the soak; each has 1000 pairs of every regime.");
  count_columns(row.count, visit);
}

template <record::row_of<SoakRow> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  subject_columns(row, visit, subjects);
  visit("seed", row.seed, "Seed of the cases.");
  visit("drawn", row.drawn, "Pairs drawn in all regimes, whether an algorithm takes them or not.");
  count_columns(row.count, visit);
  visit("program", row.program, "Hash of the program.");
}

}  // namespace touchstone::check
