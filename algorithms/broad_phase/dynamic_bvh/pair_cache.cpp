// Part of dynamic-bvh: tests, lists, removal and output of the cached pairs.
#include "algorithms/broad_phase/dynamic_bvh/pair_cache.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "algorithms/core/memory_usage.h"
#include "algorithms/core/parallel_blocks.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/broad_phase/dynamic_bvh/pair_cache.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

auto copy_pairs_of_level() {
  switch (isa()) {
    case Isa::avx512: return avx512::copy_pairs;
    case Isa::avx2: return avx2::copy_pairs;
    default: return baseline::copy_pairs;
  }
}

// The test has no branch, since its outcome is unpredictable.
bool meet(const Aabb& a, const Aabb& b) {
  bool test = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    test &= a.min[axis] <= b.max[axis];
    test &= b.min[axis] <= a.max[axis];
  }
  return test;
}

}  // namespace

void PairCache::make_room(std::size_t count) {
  if (count <= pairs_.size()) return;
  const std::size_t words = block_count(count + count / 16, word_bits);
  overlaps_.reserve(words);
  overlaps_.resize(words);
  pairs_.reserve(words * word_bits);
  pairs_.resize(words * word_bits);
  if (!are_linked_) return;
  next_.reserve(2 * pairs_.size());
  next_.resize(2 * pairs_.size());
}

void PairCache::refill(Executor& executor, const PairSink& sink, std::size_t id_count) {
  are_linked_ = false;
  gone_ = 0;
  count_ = sink.size();
  make_room(count_);
  std::ranges::fill(overlaps_, 0);
  const std::span<const PairBuffer> chunks = sink.chunks();
  std::vector<std::uint32_t>& begins = open_;
  begins.resize(chunks.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    begins[i] = static_cast<std::uint32_t>(at);
    at += chunks[i].size();
  }
  const auto copy = [&](std::size_t i, int) {
    std::ranges::copy(chunks[i].pairs(), pairs_.begin() + std::ptrdiff_t{begins[i]});
  };
  executor.run(chunks.size(), std::cref(copy));
  first_of_.resize(id_count);
}

void PairCache::make_room_for_ids(std::size_t id_count) { first_of_.resize(id_count, none); }

void PairCache::set_bit(std::size_t pair, bool value) {
  std::uint64_t& word = overlaps_[pair / word_bits];
  const std::uint64_t bit = std::uint64_t{1} << pair % word_bits;
  word = (word & ~bit) | (value ? bit : 0);
}

void PairCache::test(Executor& executor, std::span<const Aabb> boxes) {
  for_each_block(executor, count_, pairs_a_task,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t p = first; p < last; p += word_bits) {
                     std::uint64_t word = 0;
                     for (std::size_t i = 0; i < std::min(word_bits, last - p); ++i) {
                       const auto [a, b] = pairs_[p + i];
                       const bool test = meet(boxes[a], boxes[b]) & (a != b);
                       word |= std::uint64_t{test} << i;
                     }
                     overlaps_[p / word_bits] = word;
                   }
                 });
}

void PairCache::test(std::span<const std::uint32_t> ids, std::span<const Aabb> boxes) {
  list_pairs_of(ids);
  for (const std::uint32_t p : listed_) {
    const auto [a, b] = pairs_[p];
    set_bit(p, meet(boxes[a], boxes[b]) & (a != b));
  }
}

// --- lists ---

void PairCache::link(std::size_t pair) {
  for (const std::size_t side : {0, 1}) {
    std::uint32_t& first = first_of_[side == 0 ? pairs_[pair].a : pairs_[pair].b];
    next_[2 * pair + side] = first;
    first = static_cast<std::uint32_t>(2 * pair + side);
  }
}

void PairCache::make_links() {
  if (are_linked_) return;
  are_linked_ = true;
  std::ranges::fill(first_of_, none);
  if (next_.size() < 2 * pairs_.size()) {
    next_.reserve(2 * pairs_.size());
    next_.resize(2 * pairs_.size());
  }
  for (std::size_t p = 0; p < count_; ++p) link(p);
}

// Follows the lists of all bodies side by side, so that their cache misses overlap.
void PairCache::list_pairs_of(std::span<const std::uint32_t> ids) {
  make_links();
  if (open_.size() < ids.size() + 1) open_.resize(ids.size() + 1);  // one more entry is written
  listed_.clear();
  std::size_t count = 0;
  const auto keep = [&](std::uint32_t at) {
    open_[count] = at;
    count += at != none ? 1 : 0;
  };
  for (const std::uint32_t id : ids) keep(first_of_[id]);
  while (count > 0) {
    const std::size_t before = std::exchange(count, 0);
    for (std::size_t i = 0; i < before; ++i) {
      const std::uint32_t at = open_[i];
      listed_.push_back(at / 2);
      keep(next_[at]);
    }
  }
}

void PairCache::remove(std::span<const std::uint32_t> ids) {
  list_pairs_of(ids);
  for (const std::uint32_t p : listed_) {
    gone_ += is_gone(p) ? 0 : 1;
    pairs_[p] = {0, 0};
    set_bit(p, false);
  }
  for (const std::uint32_t id : ids) first_of_[id] = none;
}

void PairCache::add(IndexPair pair, std::span<const Aabb> boxes) {
  make_links();
  if (count_ == pairs_.size() && gone_ > count_ / 16) pack();
  make_room(count_ + 1);
  pairs_[count_] = pair;
  set_bit(count_, meet(boxes[pair.a], boxes[pair.b]));
  link(count_++);
}

// Removes the pairs that are gone and keeps the order of the others.
void PairCache::pack() {
  std::size_t to = 0;
  for (std::size_t p = 0; p < count_; ++p) {
    if (is_gone(p)) continue;
    const bool bit = (overlaps_[p / word_bits] >> p % word_bits & 1) != 0;
    pairs_[to] = pairs_[p];
    set_bit(to++, bit);
  }
  // Clears the bits after the last pair, those of its own word too.
  const std::size_t words = block_count(to, word_bits);
  if (to % word_bits != 0) overlaps_[words - 1] &= (std::uint64_t{1} << to % word_bits) - 1;
  std::fill(overlaps_.begin() + static_cast<std::ptrdiff_t>(words), overlaps_.end(), 0);
  count_ = to;
  gone_ = 0;
  are_linked_ = false;
  make_links();
}

// --- output ---

void PairCache::write(Executor& executor, PairSink& sink) const {
  sink.start(block_count(count_, pairs_a_task));
  for_each_block(executor, count_, pairs_a_task,
                 [&](std::size_t task, std::size_t first, std::size_t last) {
                   PairBuffer& out = sink.chunk(task);
                   const std::size_t words = block_count(last - first, word_bits);
                   const std::span<const std::uint64_t> bits(&overlaps_[first / word_bits], words);
                   std::size_t count = 0;
                   for (const std::uint64_t word : bits) {
                     count += static_cast<std::size_t>(std::popcount(word));
                   }
                   out.reserve(count + 8);  // the copy writes up to eight more
                   copy_pairs_of_level()(&pairs_[first], bits.data(), words, out.end());
                   out.advance(count);
                 });
}

std::size_t PairCache::held_bytes() const {
  return static_cast<std::size_t>(
      sum_held_bytes(pairs_, overlaps_, first_of_, next_, open_, listed_));
}

}  // namespace touchstone
