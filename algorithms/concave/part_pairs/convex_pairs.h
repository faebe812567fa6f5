// Part of part-pairs: pairs of parts of which one at least is convex, by a narrow phase.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {

class ConvexPairs {
 public:
  explicit ConvexPairs(std::unique_ptr<NarrowPhase> narrow_phase)
      : narrow_phase_(std::move(narrow_phase)) {}

  // Solves the task for each pair of parts. If the parts' poses were rounded, each answer that this
  // may have changed becomes unknown, with the status degenerate, and the bounds of a distance are
  // widened. The outcomes stay valid until the next call.
  std::span<const Outcome> solve(Task task, const BoundBody& a, const Pose& pose_a,
                                 const BoundBody& b, const Pose& pose_b,
                                 std::span<const IndexPair> pairs);

 private:
  // The number of the part among the shapes and poses.
  std::uint32_t place(const BoundBody& body, const Pose& pose, std::uint32_t part);
  void solve_in_order(Task task, std::span<const std::uint32_t> pairs, std::span<Outcome> outcomes);
  void consider_rounding(Task task);

  std::unique_ptr<NarrowPhase> narrow_phase_;
  std::vector<Shape> shapes_;
  std::vector<Pose> poses_;
  std::vector<double> roundings_;
  std::vector<std::uint32_t> numbers_, first_, second_;
  std::vector<Outcome> outcomes_;
};

}  // namespace touchstone
