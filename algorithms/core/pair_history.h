// Changes of the pairs of a broad phase: those that began and those that ended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/pair_sink.h"

namespace touchstone {

// Sorts both lists, and writes the pairs of `now` that `before` lacks to `began`, and those of
// `before` that `now` lacks to `ended`, ascending, each in one chunk. Of a pair that is in a list
// several times, as many are lacking as the other list has fewer.
void write_difference(std::vector<IndexPair>& now, std::vector<IndexPair>& before, PairSink& began,
                      PairSink& ended);

// The pairs of an earlier frame, with which those of a later one are compared. At first there are
// none. O(k + n) time for k pairs of n bodies that have few pairs each.
class PairHistory {
 public:
  // Replaces the pairs; they are distinct, in any order.
  void set(std::span<const IndexPair> pairs);
  // Writes the sink's pairs that are new and the earlier ones that the sink lacks, ascending, each
  // in one chunk. From now on the sink's are the earlier ones.
  void compare(const PairSink& now, PairSink& began, PairSink& ended);

  std::size_t held_bytes() const;

 private:
  void sort(std::span<const IndexPair> pairs, std::vector<IndexPair>& sorted);

  std::vector<IndexPair> pairs_;  // ascending
  std::vector<IndexPair> now_, unsorted_;
  std::vector<std::size_t> begins_;  // place of the first pair of each body
};

}  // namespace touchstone
