// Part of sweep-and-prune: a set of pairs that persists from frame to frame: a dense
// array, which is the output, and an open-addressing hash table of places in it. It notes what comes
// and goes.
// Paper: Knuth, "The Art of Computer Programming", vol. 3, section 6.4, Algorithms L and R (linear
//        probing, and deletion without marks).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/pair_history.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

// The order of the pairs depends only on the order of the calls. The set keeps its memory.
class PairSet {
 public:
  std::span<const IndexPair> pairs() const { return pairs_; }
  // Returns the array, for the caller to fill with distinct pairs; the table is made when it is
  // first needed.
  std::span<IndexPair> refill(std::size_t count) {
    indexed_ = is_told_ = false;
    pairs_.resize(count);
    return pairs_;
  }

  // Inserts a pair unless it is there.
  void insert(IndexPair pair) {
    index();
    std::size_t slot = find(pair);
    if (slots_[slot] != none) return;
    if (is_told_) came_.push_back(pair);
    if (2 * (pairs_.size() + 1) > slots_.size()) {
      pairs_.push_back(pair);
      fill();
      return;
    }
    slots_[slot] = static_cast<std::uint32_t>(pairs_.size());
    pairs_.push_back(pair);
  }

  // Erases a pair if it is there; the last pair takes its place.
  void erase(IndexPair pair) {
    index();
    const std::size_t slot = find(pair);
    const std::uint32_t place = slots_[slot];
    if (place == none) return;
    if (is_told_) went_.push_back(pair);
    const IndexPair last = pairs_.back();
    slots_[find(last)] = place;
    pairs_[place] = last;
    pairs_.pop_back();
    close(slot);
  }

  template <class Condition>
  void erase_if(const Condition& condition) {
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      if (condition(pairs_[i])) erase(pairs_[i]);
    }
  }

  // Begins to note changes: those from the pairs of now.
  void tell() {
    came_.clear();
    went_.clear();
    is_told_ = true;
  }
  // False from a refill until changes are noted again.
  bool is_told() const { return is_told_; }
  // Writes the pairs that have come and those that have gone since the last call, or tell(), both
  // ascending.
  void write_changes(PairSink& began, PairSink& ended) {
    write_difference(came_, went_, began, ended);
    tell();
  }
  // Returns the pairs as they were when changes were last told, ascending, and notes no more.
  std::vector<IndexPair> told() {
    PairSink gone, told;
    went_.insert(went_.end(), pairs_.begin(), pairs_.end());
    write_difference(came_, went_, gone, told);
    is_told_ = false;
    return told.gather();
  }

  std::size_t held_bytes() const {
    return (pairs_.capacity() + came_.capacity() + went_.capacity()) * sizeof(IndexPair) +
           slots_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  std::size_t home(IndexPair pair) const {
    const std::uint64_t key = std::uint64_t{pair.a} << 32 | pair.b;
    const std::uint64_t mixed = (key ^ key >> 29) * 0x9e3779b97f4a7c15;  // 2^64 / golden ratio
    return static_cast<std::size_t>(mixed >> shift_);
  }
  // Returns the slot of the pair, or the free slot where it would be.
  std::size_t find(IndexPair pair) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = home(pair);
    while (slots_[slot] != none && pairs_[slots_[slot]] != pair) slot = (slot + 1) & mask;
    return slot;
  }
  // Moves up the entries that this slot kept away from their homes.
  void close(std::size_t slot) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t next = slot;;) {
      next = (next + 1) & mask;
      if (slots_[next] == none) break;
      const std::size_t from_home = (next - home(pairs_[slots_[next]])) & mask;
      if (from_home < ((next - slot) & mask)) continue;
      slots_[slot] = slots_[next];
      slot = next;
    }
    slots_[slot] = none;
  }

  void index() {
    if (!indexed_) fill();
  }
  void fill() {
    const std::size_t size = std::bit_ceil(std::max(4 * pairs_.size(), std::size_t{64}));
    if (slots_.size() < size) slots_.resize(size);
    shift_ = 65 - static_cast<int>(std::bit_width(slots_.size()));
    std::ranges::fill(slots_, none);
    indexed_ = true;
    for (std::uint32_t place = 0; place < pairs_.size(); ++place) {
      slots_[find(pairs_[place])] = place;
    }
  }

  std::vector<IndexPair> pairs_;
  std::vector<std::uint32_t> slots_;  // places of pairs; the size is a power of two
  int shift_ = 0;
  bool indexed_ = false;
  bool is_told_ = false;
  std::vector<IndexPair> came_, went_;  // a pair each time that it did
};

}  // namespace touchstone
