// The errors of a configuration's answers: verdicts by the true gap, distances, depths.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/trade/pipeline/frame_pipeline.h"
#include "harness/trade/pipeline/truth.h"

namespace touchstone::trade {

// True signed gaps as parts of the smaller body's size, from deep to far; contact is at 0 and
// below. The last bin holds contacts whose depth is not known.
inline constexpr std::array<double, 6> gap_decades = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
inline constexpr std::size_t gap_bins = 2 * (gap_decades.size() + 1);
inline constexpr std::size_t unknown_depth_bin = gap_bins;
std::size_t gap_bin(Answer truth, double gap_over_size);
struct GapRange {
  double low, high;  // NaN if not known; may be infinite
};
GapRange gap_range(std::size_t bin);

struct GapBin {
  std::int64_t pairs = 0;
  std::int64_t wrong = 0;   // false negatives if in contact, false positives if apart
  std::int64_t failed = 0;  // the algorithm reported that it has no answer
};

struct Spread {
  double mean = 0, p99 = 0, greatest = 0;
};
Spread spread_of(std::vector<double> values);

// Sums over the frames whose truth is known; plain data, which a child process can send.
struct PointErrors {
  std::int64_t near = 0;  // the number of pairs that are near each other and whose truth is known
  std::int64_t contacts = 0;  // the number of near pairs that are truly in contact
  std::int64_t false_positives = 0, false_negatives = 0, failed = 0;  // counts among near pairs
  std::int64_t far = 0;  // the number of pairs that are not near but were called a contact
  std::array<GapBin, gap_bins + 1> bins{};
  // The errors |answered - true| as parts of the smaller body's size. In a distance, contact is 0;
  // in a depth, separation is 0. A wrong verdict is an error of that size; a number that is missing
  // is an error of 1.
  std::int64_t values = 0;
  Spread value;

  // The share of wrong verdicts among all that were due, or given without need, 0 to 1.
  double wrong_share() const;
  double false_negative_share() const;  // a share of the true contacts
};

class ErrorCount {
 public:
  explicit ErrorCount(Task task) : task_(task) {}
  // Adds the answers to a frame. Pairs that the truth does not list count if they are contacts. A
  // pair without an answer was not found, and counts as separated.
  void add(const FrameTruth& truth, std::span<const PairAnswer> answers);
  PointErrors errors();

 private:
  void add(const TruePair& truth, const PairAnswer* answer);

  Task task_;
  PointErrors errors_;
  std::vector<double> values_;
};

}  // namespace touchstone::trade
