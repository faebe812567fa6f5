// Two results of the same campaign, cell by cell: is B slower than A?
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/stats/samples.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {

// One contestant of one set, in A and in B.
struct ComparedCell {
  SetKey key;
  std::string label;
  MedianInterval ratio;    // of the times, B / A; none where there are too few squares
  double p = 1;            // Mann-Whitney
  double p_corrected = 1;  // by Holm, over all cells
  std::size_t squares_a = 0, squares_b = 0;  // or runs, where whole runs are compared
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

// What the two results are called in what is told of them.
struct ResultNames {
  std::string a = "A", b = "B";
};

// What A has and B has not, each a line for the user.
struct Missing {
  std::vector<std::string> scenes;  // the same scene has another hash in B
  std::vector<std::string> cells;   // B did not run it
};
Missing missing(const Results& a, const Results& b, const ResultNames& names = {});

// Why times of A and B may not be compared, each a line; empty where they may. `machines`: whether
// to look at the machines too.
std::vector<std::string> obstacles(const Results& a, const Results& b, bool machines);

// What differs and may explain a difference in time: compiler, flags, library versions, commit,
// algorithms that only B has.
std::vector<std::string> remarks(const Results& a, const Results& b);

// Where B found other pairs or another number of contacts than A did, or failed where A did not,
// a line for each contestant of a set: a regression, however fast it is. Work counters tell two
// versions of an algorithm apart, and must be the same where one is run again.
enum class Compared : std::uint8_t { answers, answers_and_work };
std::vector<std::string> changed_answers(const Results& a, const Results& b, Compared what,
                                         const ResultNames& names = {});

// Every cell that both have times of. A and B ran one after the other: nothing is paired, the
// interval is that of the Mann-Whitney test.
std::vector<ComparedCell> compare(const Results& a, const Results& b, Noise noise);

// a[i] and b[i] ran side by side: the ratio is the median of their paired log ratios, with a
// sign-test interval, and each run counts once.
std::vector<ComparedCell> compare_runs(std::span<const Results> a, std::span<const Results> b,
                                       Noise noise);

}  // namespace touchstone::stats
