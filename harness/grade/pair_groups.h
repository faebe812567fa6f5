// Pairs of bodies, grouped into batches of one kind pair.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/pair_sink.h"
#include "algorithms/core/shape.h"
#include "algorithms/narrow_phase.h"
#include "harness/base/hash.h"

namespace touchstone::grade {

// Pairs of one kind pair, kind_a <= kind_b. Body first[i] has kind_a; it need not have the smaller
// index.
struct PairGroup {
  ShapeKind kind_a = ShapeKind::sphere, kind_b = ShapeKind::sphere;
  std::vector<std::uint32_t> first, second;

  std::size_t size() const { return first.size(); }
  std::string name() const;  // "box-sphere"
  // Returns the pairs [begin, end) of the group as a batch.
  PairBatch batch(std::span<const std::uint32_t> shape_of, std::span<const Pose> poses,
                  std::size_t begin, std::size_t end) const;
};

// Groups pairs by their kinds as they are added. It keeps its memory when it is cleared.
class PairGrouping {
 public:
  static constexpr std::size_t kinds = all_shape_kinds.size();
  static std::size_t index(ShapeKind a, ShapeKind b) {
    return static_cast<std::size_t>(a) * kinds + static_cast<std::size_t>(b);
  }

  void clear();
  // Returns the index of the pair's group.
  std::size_t add(std::uint32_t first, ShapeKind first_kind, std::uint32_t second,
                  ShapeKind second_kind);
  // All groups by index; many are empty.
  std::span<const PairGroup> groups() const { return groups_; }

 private:
  std::array<PairGroup, kinds * kinds> groups_;
};

// Returns the groups in the order of the kinds, and within a group in the order of `pairs`. Groups
// without pairs are left out.
std::vector<PairGroup> group_by_kind(std::span<const IndexPair> pairs,
                                     std::span<const Shape> shapes,
                                     std::span<const std::uint32_t> shape_of);

// All pairs of parts of two bodies that share a point, by number and fingerprint.

struct PartList {
  std::uint64_t count = 0, hash = 0;
  bool operator==(const PartList&) const = default;
};

inline PartList part_list(std::span<const IndexPair> pairs) {
  return {pairs.size(), base::pair_hash(pairs)};
}

}  // namespace touchstone::grade
