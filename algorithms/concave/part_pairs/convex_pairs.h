// Part of part-pairs: pairs of parts of which one at least is convex, by a narrow phase.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {

class ConvexPairs {
 public:
  explicit ConvexPairs(std::function<std::unique_ptr<NarrowPhase>()> make)
      : make_(std::move(make)) {}

  // The bodies stay alive, and their parts unchanged.
  void bind(std::span<const BoundBody> bodies);

  // Solves the task for each pair of parts of two of the bodies. If the parts' poses were rounded, each
  // answer that this may have changed becomes unknown, with the status degenerate, and the bounds of
  // a distance are widened. The outcomes stay valid until the next call.
  std::span<const Outcome> solve(Task task, const BoundBody& a, const Pose& pose_a,
                                 const BoundBody& b, const Pose& pose_b,
                                 std::span<const IndexPair> pairs);

 private:
  struct Placed {
    ShapeKind kind;
    double rounding;  // of its pose: the greatest distance by which a point is off (metres)
    double reach;     // of its points from the origin of the shape (metres)
    double ball;      // the radius of a ball in the world around that origin, inside; may be 0
  };

  std::uint32_t place(const BoundBody& body, const Pose& pose, std::uint32_t part);
  void add(const Shape& shape, std::uint32_t number, const Pose& pose, const Placed& placed);
  // Outcomes are in the order of the numbers.
  void solve_in_order(Task task, std::span<const std::uint32_t> pairs, std::span<Outcome> outcomes);
  void consider_rounding(Task task);
  void ask_scaled(Task task);
  bool add_scaled(std::uint32_t pair);
  void consider_rounding(Task task, std::uint32_t pair);

  std::function<std::unique_ptr<NarrowPhase>()> make_;
  // Both are null until they are needed: what they work with is larger than a small mesh.
  std::unique_ptr<NarrowPhase> for_parts_;      // knows all convex parts
  std::unique_ptr<NarrowPhase> for_triangles_;  // knows the shapes of the last batch with triangles
  std::span<const BoundBody> bodies_;
  std::vector<Shape> parts_;               // of all bodies, in their order
  std::vector<std::uint32_t> first_part_;  // of each body

  // The current batch. Bodies and pairs of one of them scaled come after those that were given.
  bool has_triangles_ = false;
  std::vector<Shape> shapes_;  // with triangles only
  std::vector<std::uint32_t> shape_of_, first_, second_;
  std::vector<Pose> poses_;
  std::vector<Placed> placed_;
  std::vector<Outcome> outcomes_;

  // Room that calls use again.
  std::vector<std::uint32_t> number_in_a_, number_in_b_;  // of parts; `none` but within a call
  std::vector<std::uint32_t> asked_, scaled_, order_, a_, b_;
  std::vector<Outcome> found_, verdicts_;
};

}  // namespace touchstone
