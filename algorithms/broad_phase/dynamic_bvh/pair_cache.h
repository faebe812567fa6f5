// Pairs of bodies that are kept from frame to frame because they may overlap, each body's linked
// through them, and for each pair a bit that says whether it does.
// Paper:   Presson's btDbvt in Bullet, 2008 (pairs of fat boxes persist); Knuth, "The Art of
//          Computer Programming", vol. 1, section 2.2.4 (circular and linked allocation of lists
//          that share their nodes).
// Departs: pairs of a body that leaves are only blotted out: they are taken out of the lists, and
//          all is packed, when there is no room for new ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

// The order of the pairs depends on nothing but the order of the calls.
class PairCache {
 public:
  static constexpr std::size_t most = std::size_t{1} << 30;  // links are of 32 bits

  std::size_t size() const { return count_ - gone_; }

  // Takes all pairs of the sink, each there once, none more than `most`; ids are below `id_count`.
  void refill(Executor& executor, const PairSink& sink, std::size_t id_count);
  void make_room_for_ids(std::size_t id_count);

  // Whether the boxes overlap now: of all pairs, and of those of some bodies.
  void test(Executor& executor, std::span<const Aabb> boxes);
  void test(std::span<const std::uint32_t> ids, std::span<const Aabb> boxes);

  // All pairs of these bodies.
  void remove(std::span<const std::uint32_t> ids);
  // A pair that is not there.
  void add(IndexPair pair, std::span<const Aabb> boxes);

  // The pairs that overlapped when they were last tested.
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

  // Of these, count_ are in use; those that are gone have two equal ids, and no bit. There are
  // whole words of them.
  std::vector<IndexPair> pairs_;
  std::vector<std::uint64_t> overlaps_;
  std::size_t count_ = 0, gone_ = 0;
  // The pairs of a body, linked: 2 p for its being the first of pair p, 2 p + 1 for the second.
  // Made when they are first needed.
  bool are_linked_ = false;
  std::vector<std::uint32_t> first_of_;  // of each body
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> open_, listed_;  // of list_pairs_of
};

}  // namespace touchstone
