// Compares two results of the same campaign, cell by cell: is B slower than A? First it decides
// whether they are comparable, and lists what differs between them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/record/row.h"
#include "harness/stats/samples.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {

// The names of the two results in messages.
struct ResultNames {
  std::string a = "A", b = "B";
};

// Cells of A that B lacks, each a line for the user.
struct Missing {
  std::vector<std::string> scenes;  // the same scene has another hash in B
  std::vector<std::string> cells;   // B did not run it
};
Missing missing(const Results& a, const Results& b, const ResultNames& names = {});

// Returns the reasons against a comparison of times, each a line; none if A and B are comparable.
// `machines`: the machines must be equal too.
std::vector<std::string> obstacles(const Results& a, const Results& b, bool machines);

// Differences that may explain a difference in time: compiler, flags, library versions, commit,
// algorithms that only B has.
std::vector<std::string> remarks(const Results& a, const Results& b);

// One contestant of one set, in A and in B.
struct ComparedCell {
  SetKey key;
  std::string label;
  MedianInterval ratio;    // ratio of the times, B / A; NaN if there are too few squares
  double p = 1;            // Mann-Whitney
  double p_corrected = 1;  // corrected by Holm, over all cells
  std::size_t squares_a = 0, squares_b = 0;  // the number of runs, if whole runs are compared
};

enum class Verdict : std::uint8_t {
  same,        // the interval lies within 1 / (1 + threshold) to 1 + threshold
  faster,      // it lies below that band
  not_slower,  // it lies below the band's upper end
  slower,      // it lies above the band, and the corrected p is below 0.05: a regression
  undecided,
};
std::string_view to_string(Verdict verdict);
Verdict verdict(const ComparedCell& cell, double threshold);

// The file of a comparison. Verdicts depend on the threshold.
template <record::row_of<ComparedCell> Row, class Visit>
void columns(Row& row, Visit visit, double threshold) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The algorithm's label.");
  interval_columns("ratio", row.ratio, "Time in B over the time in A.", visit);
  visit("p", row.p, "Probability by the Mann-Whitney test, if the times are equal.");
  visit("p_corrected", row.p_corrected, "The same after Holm's correction over all cells.");
  visit("n_a", row.squares_a, "Number of squares in A, or of its runs.");
  visit("n_b", row.squares_b, "Number of squares in B, or of its runs.");
  visit("verdict", record::derived([&, threshold] { return verdict(row, threshold); }),
        "Whether B is slower.");
}

// Returns a line for each contestant of a set for which B found other pairs or another number of
// contacts than A, or failed when A did not: a regression, however fast it is. Work counters differ
// between versions of an algorithm, and must be equal if one version runs again.
enum class Compared : std::uint8_t { answers, answers_and_work };
std::vector<std::string> changed_answers(const Results& a, const Results& b, Compared what,
                                         const ResultNames& names = {});

// Compares every cell for which both have times. A and B ran one after the other: nothing is
// paired, and the interval is that of the Mann-Whitney test.
std::vector<ComparedCell> compare(const Results& a, const Results& b, Noise noise);

// Compares results whose runs a[i] and b[i] took turns: the ratio is the median of their paired log
// ratios, with a sign-test interval, and each run counts once.
std::vector<ComparedCell> compare_runs(std::span<const Results> a, std::span<const Results> b,
                                       Noise noise);

}  // namespace touchstone::stats
