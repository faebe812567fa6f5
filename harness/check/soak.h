// Verdicts by the million: of each algorithm against the exact ones, counted and nothing else.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "harness/check/check_request.h"

namespace touchstone::check {

// `broad`, `cases` and `seconds` are not read.
struct SoakRequest : CheckRequest {
  std::int64_t pairs = 1'000'000;  // in all, spread evenly over the regimes
};

// Of one algorithm in one scalar in one regime.
struct SoakCount {
  std::int64_t pairs = 0;  // that it was asked about; those of kinds that it does not take are not
  // What is exactly true of them; unresolved: curved bodies that the oracle leaves open.
  std::int64_t separated = 0, touching = 0, overlapping = 0, unresolved = 0;
  std::int64_t silent = 0;        // on the wrong side of contact, and stood by or without a status
  std::int64_t honest = 0;        // said to be unknown, or not stood by
  std::int64_t lost = 0;          // crashed, or not in time
  std::int64_t first_wrong = -1;  // index of the first case that was silently wrong or lost

  void add(const SoakCount& other);
};

struct SoakResult {
  // Places in the request's narrow phases and regimes.
  using Key = std::tuple<std::size_t, Precision, std::size_t>;
  std::map<Key, SoakCount> counts;
  std::int64_t drawn = 0;  // pairs, whether an algorithm takes them or not

  bool ours_are_wrong(const SoakRequest& request) const;
};

// Counts are in soak.csv of the request's folder, which is made: written about once a second, whole
// each time, so that a killed run loses that much. Case files of the first wrong answer of each
// count are beside it. Progress goes to standard error. InputError where the folder cannot be
// written, or where there is nothing to go on with or it comes from another request or program.
SoakResult run_soak(const SoakRequest& request);

}  // namespace touchstone::check
