// Part of dynamic-bvh: tests, lists, removal, changes and output of the cached pairs.
#include "algorithms/broad_phase/dynamic_bvh/pair_cache.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
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
  pairs_.grow(count);
  const std::size_t words = pairs_.size() / word_bits;
  for (auto* const bits : {&overlaps_, &told_}) bits->resize(words);
  touched_.resize(words / word_bits);
  if (are_linked_) make_room_for_links();
}

void PairCache::make_room_for_links() {
  for (auto* const links : {&next_, &before_}) links->grow(2 * pairs_.size());
}

void PairCache::refill(Executor& executor, const PairSink& sink, std::size_t id_count) {
  are_linked_ = is_told_ = false;
  lost_.clear();
  gone_ = 0;
  free_ = none;
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
  const auto copy = [&](std::size_t i, int) { pairs_.copy(chunks[i].pairs(), begins[i]); };
  executor.run(chunks.size(), std::cref(copy));
  make_room_for_ids(id_count);
}

void PairCache::make_room_for_ids(std::size_t id_count) {
  first_of_.resize(id_count, none);
  seen_.resize(id_count, 0);
}

void PairCache::set_bit(std::size_t pair, bool value) {
  std::uint64_t& word = overlaps_[pair / word_bits];
  const std::uint64_t bit = std::uint64_t{1} << pair % word_bits;
  word = (word & ~bit) | (value ? bit : 0);
  touch(pair / word_bits);
}

void PairCache::test(Executor& executor, std::span<const Aabb> boxes) {
  for_each_block(executor, count_, pairs_a_task,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   const IndexPair* pairs = &pairs_[first];  // they are on one page
                   for (std::size_t p = first; p < last; p += word_bits, pairs += word_bits) {
                     std::uint64_t word = 0;
                     for (std::size_t i = 0; i < std::min(word_bits, last - p); ++i) {
                       const auto [a, b] = pairs[i];
                       const bool test = meet(boxes[a], boxes[b]) & (a != b);
                       word |= std::uint64_t{test} << i;
                     }
                     if (overlaps_[p / word_bits] == word) continue;
                     overlaps_[p / word_bits] = word;
                     touch(p / word_bits);
                   }
                 });
}

void PairCache::test(std::span<const std::uint32_t> ids, std::span<const Aabb> boxes) {
  list_links_of(ids);
  for (const std::uint32_t link : listed_) {
    const std::uint32_t p = link / 2;
    const auto [a, b] = pairs_[p];
    set_bit(p, meet(boxes[a], boxes[b]) & (a != b));
  }
}

// --- lists ---

void PairCache::link(std::size_t pair) {
  for (const std::size_t side : {0, 1}) {
    std::uint32_t& first = first_of_[side == 0 ? pairs_[pair].a : pairs_[pair].b];
    const auto own = static_cast<std::uint32_t>(2 * pair + side);
    next_[own] = first;
    before_[own] = none;
    if (first != none) before_[first] = own;
    first = own;
  }
}

void PairCache::unlink(std::size_t pair) {
  for (const std::size_t side : {0, 1}) {
    const std::uint32_t next = next_[2 * pair + side];
    const std::uint32_t before = before_[2 * pair + side];
    const std::uint32_t body = side == 0 ? pairs_[pair].a : pairs_[pair].b;
    (before == none ? first_of_[body] : next_[before]) = next;
    if (next != none) before_[next] = before;
  }
}

void PairCache::make_links() {
  if (are_linked_) return;
  are_linked_ = true;
  std::ranges::fill(first_of_, none);
  make_room_for_links();
  for (std::size_t p = 0; p < count_; ++p) link(p);
}

// Follows the lists of all bodies side by side, so that their cache misses overlap.
void PairCache::list_links_of(std::span<const std::uint32_t> ids) {
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
      listed_.push_back(at);
      keep(next_[at]);
    }
  }
}

void PairCache::remove(std::span<const std::uint32_t> ids) {
  list_links_of(ids);
  for (const std::uint32_t link : listed_) {
    const std::uint32_t p = link / 2;
    if (!is_gone(p)) remove(p);  // a pair of two of these bodies is listed twice
  }
}

void PairCache::remove(std::uint32_t pair) {
  unlink(pair);
  std::uint64_t& told = told_[pair / word_bits];
  const std::uint64_t bit = std::uint64_t{1} << pair % word_bits;
  if (is_told_ && (told & bit) != 0) lost_.push_back(pairs_[pair]);
  told &= ~bit;
  set_bit(pair, false);
  pairs_[pair] = {0, 0};
  next_[2 * std::size_t{pair}] = std::exchange(free_, pair);
  ++gone_;
}

void PairCache::add(IndexPair pair, std::span<const Aabb> boxes) {
  make_links();
  std::size_t place = count_;
  if (free_ == none) {
    make_room(++count_);
  } else {
    place = std::exchange(free_, next_[2 * std::size_t{free_}]);
    --gone_;
  }
  pairs_[place] = pair;
  set_bit(place, meet(boxes[pair.a], boxes[pair.b]));
  link(place);
}

// Makes room for the numbers of so many rounds.
void PairCache::start_rounds(std::uint32_t count) {
  if (round_ <= none - count) return;
  std::ranges::fill(seen_, 0);
  round_ = 0;
}

std::size_t PairCache::replace(std::uint32_t id, std::span<const std::uint32_t> others,
                               std::span<const Aabb> boxes) {
  make_links();
  start_rounds(2);
  const std::uint32_t wanted = ++round_;
  const std::uint32_t present = ++round_;
  for (const std::uint32_t other : others) seen_[other] = wanted;
  std::size_t changes = 0;
  for (std::uint32_t at = first_of_[id]; at != none;) {
    const std::uint32_t pair = at / 2;
    const std::uint32_t other = at % 2 == 0 ? pairs_[pair].b : pairs_[pair].a;
    at = next_[at];
    if (seen_[other] == wanted) {
      seen_[other] = present;
    } else {
      remove(pair);
      ++changes;
    }
  }
  for (const std::uint32_t other : others) {
    if (seen_[other] != wanted) continue;
    add({std::min(id, other), std::max(id, other)}, boxes);
    ++changes;
  }
  return changes;
}

// --- changes ---

void PairCache::tell() {
  told_ = overlaps_;
  std::ranges::fill(touched_, 0);
  lost_.clear();
  is_told_ = true;
}

std::vector<IndexPair> PairCache::told() const {
  std::vector<IndexPair> pairs = lost_;
  for (std::size_t p = 0; p < count_; ++p) {
    if ((told_[p / word_bits] >> p % word_bits & 1) != 0) pairs.push_back(pairs_[p]);
  }
  return pairs;
}

void PairCache::write_changes(PairSink& began, PairSink& ended) {
  began_.clear();
  ended_.swap(lost_);
  lost_.clear();
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    for (std::uint64_t words = std::exchange(touched_[i], 0); words != 0; words &= words - 1) {
      const std::size_t word = i * word_bits + static_cast<std::size_t>(std::countr_zero(words));
      const std::uint64_t now = overlaps_[word];
      for (std::uint64_t bits = std::exchange(told_[word], now) ^ now; bits != 0;
           bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        const IndexPair pair = pairs_[word * word_bits + static_cast<std::size_t>(bit)];
        ((now >> bit & 1) != 0 ? began_ : ended_).push_back(pair);
      }
    }
  }
  // A pair that was removed and is back has not changed.
  write_difference(began_, ended_, began, ended);
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

// A pair of two of these bodies is listed twice: it is written for its first body.
void PairCache::write_of(std::span<const std::uint32_t> ids, PairSink& sink) {
  start_rounds(1);
  const std::uint32_t asked = ++round_;
  for (const std::uint32_t id : ids) seen_[id] = asked;
  list_links_of(ids);
  sink.start(1);
  PairBuffer& out = sink.chunk(0);
  for (const std::uint32_t link : listed_) {
    const std::size_t p = link / 2;
    if ((overlaps_[p / word_bits] >> p % word_bits & 1) == 0) continue;
    const IndexPair pair = pairs_[p];
    if (link % 2 == 0 || seen_[pair.a] != asked) out.push(pair.a, pair.b);
  }
}

std::size_t PairCache::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(pairs_, overlaps_, first_of_, next_, before_,
                                                 seen_, open_, listed_, told_, touched_, lost_,
                                                 began_, ended_));
}

}  // namespace touchstone
