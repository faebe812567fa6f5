// Part of dynamic-bvh: the pair cache, which holds the pairs of bodies whose fat boxes overlap from
// frame to frame, links the pairs of each body, and has a bit for each pair whose tight boxes
// overlap.
// Paper:   Presson's btDbvt in Bullet, 2008 (pairs of fat boxes persist); Knuth, "The Art of
//          Computer Programming", vol. 1, section 2.2.4 (circular and linked allocation of lists
//          that share their nodes).
// Departs: pairs of a leaver are only marked as gone. When there is no room for new pairs, the
//          cache is packed and the lists are linked again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

// The order of the pairs depends only on the order of the calls.
class PairCache {
 public:
  static constexpr std::size_t most = std::size_t{1} << 30;  // links are of 32 bits

  std::size_t size() const { return count_ - gone_; }

  // Replaces all pairs by the sink's, which are distinct and at most `most`; ids are below
  // `id_count`.
  void refill(Executor& executor, const PairSink& sink, std::size_t id_count);
  void make_room_for_ids(std::size_t id_count);

  // Tests whether the boxes overlap now: for all pairs, or for the pairs of some bodies.
  void test(Executor& executor, std::span<const Aabb> boxes);
  void test(std::span<const std::uint32_t> ids, std::span<const Aabb> boxes);

  // Removes all pairs of these bodies.
  void remove(std::span<const std::uint32_t> ids);
  // Adds a pair that is not in the cache.
  void add(IndexPair pair, std::span<const Aabb> boxes);

  // Writes the pairs that overlapped when they were last tested.
  void write(Executor& executor, PairSink& sink) const;

  std::size_t held_bytes() const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::size_t word_bits = 64;
  static constexpr std::size_t pairs_a_task = 16384;  // a multiple of the word's bits

  bool is_gone(std::size_t pair) const { return pairs_[pair].a == pairs_[pair].b; }
  void make_room(std::size_t count);
  void make_links();
  void link(std::size_t pair);
  void list_pairs_of(std::span<const std::uint32_t> ids);
  void set_bit(std::size_t pair, bool value);
  void pack();

  // Pairs, of which count_ are in use. A pair that is gone has two equal ids and no bit. There are
  // whole words of bits.
  std::vector<IndexPair> pairs_;
  std::vector<std::uint64_t> overlaps_;
  std::size_t count_ = 0, gone_ = 0;
  // The list of a body's pairs: link 2 p means that it is the first body of pair p, and 2 p + 1
  // that it is the second. The links are made when they are first needed.
  bool are_linked_ = false;
  std::vector<std::uint32_t> first_of_;  // first link of each body
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> open_, listed_;  // scratch of list_pairs_of
};

}  // namespace touchstone
