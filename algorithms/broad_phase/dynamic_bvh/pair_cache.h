// Part of dynamic-bvh: the pair cache, which holds the pairs of bodies whose fat boxes overlap from
// frame to frame, links the pairs of each body, and has a bit for each pair whose tight boxes
// overlap, and one for those that did when changes were last told.
// Paper:   Presson's btDbvt in Bullet, 2008 (pairs of fat boxes persist); Knuth, "The Art of
//          Computer Programming", vol. 1, section 2.2.4 (circular and linked allocation of lists
//          that share their nodes).
// Departs: a pair that is gone leaves its place to the next that comes, so that nothing is ever
//          packed: no frame touches more than its own pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase/dynamic_bvh/paged_array.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/pair_history.h"
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
  // Makes these the pairs of a body, each of the others once: removes those that are not among them
  // and adds those that are not there. Returns the number of both.
  std::size_t replace(std::uint32_t id, std::span<const std::uint32_t> others,
                      std::span<const Aabb> boxes);

  // Writes the pairs that overlapped when they were last tested.
  void write(Executor& executor, PairSink& sink) const;
  // Writes those of these bodies, distinct, each once, in one chunk.
  void write_of(std::span<const std::uint32_t> ids, PairSink& sink);

  // Begins to tell changes: those from the pairs that overlap now.
  void tell();
  // False from a refill until changes are told again.
  bool is_told() const { return is_told_; }
  // The pairs that overlapped when changes were last told, in any order.
  std::vector<IndexPair> told() const;
  // Writes the pairs that overlap and did not when changes were last told, and those that did and
  // do not any more, both ascending. It costs in proportion to what was tested, came or went since.
  void write_changes(PairSink& began, PairSink& ended);

  std::size_t held_bytes() const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::size_t word_bits = 64;
  static constexpr std::size_t pairs_a_task = PagedArray<IndexPair>::page;

  bool is_gone(std::size_t pair) const { return pairs_[pair].a == pairs_[pair].b; }
  void make_room(std::size_t count);
  void make_room_for_links();
  void make_links();
  void link(std::size_t pair);
  void unlink(std::size_t pair);
  void remove(std::uint32_t pair);
  void list_links_of(std::span<const std::uint32_t> ids);
  void start_rounds(std::uint32_t count);
  void set_bit(std::size_t pair, bool value);
  void touch(std::size_t word) {
    touched_[word / word_bits] |= std::uint64_t{1} << word % word_bits;
  }

  // Pairs, of which count_ are in use. A pair that is gone has two equal ids and no bit, and its
  // first link leads to the next such pair. There are whole words of bits.
  PagedArray<IndexPair> pairs_;
  std::vector<std::uint64_t> overlaps_;
  std::size_t count_ = 0, gone_ = 0;
  std::uint32_t free_ = none;  // the last pair that is gone
  // The list of a body's pairs: link 2 p means that it is the first body of pair p, and 2 p + 1
  // that it is the second. The links are made when they are first needed.
  bool are_linked_ = false;
  std::vector<std::uint32_t> first_of_;  // first link of each body
  PagedArray<std::uint32_t> next_, before_;
  // For each body the number of a round of replace() in which it was wanted or present, or of
  // write_of() in which it was asked for.
  std::vector<std::uint32_t> seen_;
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> open_, listed_;  // scratch of list_links_of
  // Bits of the pairs that overlapped when changes were last told, of the words of bits that have
  // changed since, and the told pairs that were removed since.
  bool is_told_ = false;
  std::vector<std::uint64_t> told_, touched_;
  std::vector<IndexPair> lost_, began_, ended_;  // the last two are scratch
};

}  // namespace touchstone
