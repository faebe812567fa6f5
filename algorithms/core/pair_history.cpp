// The sort of pairs by their bodies, and the difference of two sorted lists.
#include "algorithms/core/pair_history.h"

#include <algorithm>
#include <numeric>

#include "algorithms/core/memory_usage.h"

namespace touchstone {
namespace {

std::uint64_t in_one_number(IndexPair pair) { return std::uint64_t{pair.a} << 32 | pair.b; }

// Writes the pairs of `from` that `without` lacks; both are ascending.
void write_missing(std::span<const IndexPair> from, std::span<const IndexPair> without,
                   PairSink& sink) {
  sink.start(1);
  PairBuffer& out = sink.chunk(0);
  auto other = without.begin();
  for (const IndexPair pair : from) {
    while (other != without.end() && *other < pair) ++other;
    if (other == without.end() || *other != pair) {
      out.push(pair.a, pair.b);
    } else {
      ++other;
    }
  }
}

}  // namespace

void write_difference(std::vector<IndexPair>& now, std::vector<IndexPair>& before, PairSink& began,
                      PairSink& ended) {
  for (auto* const pairs : {&now, &before}) std::ranges::sort(*pairs, {}, in_one_number);
  write_missing(now, before, began);
  write_missing(before, now, ended);
}

// Deals the pairs to their first bodies, whose few pairs are then sorted.
void PairHistory::sort(std::span<const IndexPair> pairs, std::vector<IndexPair>& sorted) {
  std::size_t bodies = 0;
  for (const IndexPair pair : pairs) bodies = std::max(bodies, std::size_t{pair.a} + 1);
  begins_.assign(bodies + 1, 0);
  for (const IndexPair pair : pairs) ++begins_[pair.a + std::size_t{1}];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  sorted.resize(pairs.size());
  for (const IndexPair pair : pairs) sorted[begins_[pair.a]++] = pair;
  // Each body's begin is now its end.
  std::size_t first = 0;
  for (std::size_t body = 0; body < bodies; ++body) {
    const std::size_t last = begins_[body];
    std::ranges::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first),
                      sorted.begin() + static_cast<std::ptrdiff_t>(last), {}, &IndexPair::b);
    first = last;
  }
}

void PairHistory::set(std::span<const IndexPair> pairs) { sort(pairs, pairs_); }

void PairHistory::compare(const PairSink& now, PairSink& began, PairSink& ended) {
  unsorted_.clear();
  for (const PairBuffer& chunk : now.chunks()) {
    unsorted_.insert(unsorted_.end(), chunk.pairs().begin(), chunk.pairs().end());
  }
  sort(unsorted_, now_);
  write_missing(now_, pairs_, began);
  write_missing(pairs_, now_, ended);
  pairs_.swap(now_);
}

std::size_t PairHistory::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(pairs_, now_, unsorted_, begins_));
}

}  // namespace touchstone
