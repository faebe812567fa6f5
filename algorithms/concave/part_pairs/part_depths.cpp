// Depths of pairs of parts. The nearest points tell that of a sphere or capsule at a triangle, GJK and EPA in
// doubles most others, with bounds that hold beyond their rounding. A narrow phase that proves more takes
// several times as long to prepare two shapes.
#include "algorithms/concave/part_pairs/part_depths.h"

#include <algorithm>
#include <limits>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/kernels/rays/points/closest_of.h"
#include "algorithms/kernels/triangles/triangle_distance.h"

namespace touchstone {

PartDepths::Triangle::Triangle() : hull_(std::make_shared<Hull>()) {
  hull_->vertices.resize(3);
  hull_->dimension = 2;
  hull_->neighbours = {{1, 2}, {0, 2}, {0, 1}};
  shape_.kind = ShapeKind::hull;
  shape_.hull = hull_;
}

const SupportShape<double>& PartDepths::Triangle::prepare(const TriangleCorners& corners) {
  hull_->vertices.assign(corners.begin(), corners.end());
  return prepared_.emplace(shape_);
}

void PartDepths::bind(std::span<const BoundBody> bodies) {
  bodies_ = bodies;
  parts_.clear();
  reaches_.clear();
  first_part_.clear();
  for (const BoundBody& body : bodies) {
    first_part_.push_back(static_cast<std::uint32_t>(parts_.size()));
    for (const ConvexPart& part : body.given->parts) {
      parts_.emplace_back(part.shape);
      const bool is_bounded = part.shape.kind != ShapeKind::halfspace;
      reaches_.push_back(is_bounded ? reach_of({{tight_box(part.shape, Pose{})}}) : 0);
    }
  }
}

void PartDepths::place(const PlacedConcave& body, std::uint32_t part, Side& side) const {
  if (side.part == part) return;
  side.part = part;
  const BoundBody& bound = bodies_[body.body];
  if (bound.mesh() != nullptr) {
    side.shape = nullptr;
    side.corners = bound.corners(part);
    side.placed = {body.pose, 0};
    return;
  }
  const std::size_t number = first_part_[body.body] + part;
  side.shape = &parts_[number];
  side.half_length =
      side.shape->core == SupportCore::segment ? bound.given->parts[part].shape.half_length : 0;
  side.placed = bound.place(body.pose, part, reaches_[number]);
}

// The depth is the radius less the distance of the centre, or of the segment, which the nearest points bound
// from above, and the plane across the way between them from below. A segment that does not cross an edge of
// the triangle, seen along that way, is nearest with an end.
bool PartDepths::find_depth_of_round(const Side& round, const Side& triangle, Outcome& outcome) {
  constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
  constexpr double least_part = 0x1p-20;  // of the reach: a shorter way has no direction
  const Pose& pose = round.placed.pose;
  const Vec3d axis = pose.rotation.col(2) * round.half_length;
  const Segment core = {pose.translation - axis, pose.translation + axis};
  TriangleCorners corners = triangle.corners;
  const double stretch = std::max(1.0, triangle.placed.pose.rotation.cwiseAbs().maxCoeff());
  double reach = pose.translation.cwiseAbs().maxCoeff() + axis.cwiseAbs().maxCoeff();
  for (Vec3d& corner : corners) {
    const double along = stretch * corner.cwiseAbs().maxCoeff();
    corner = triangle.placed.pose(corner);
    reach = std::max({reach, along, corner.cwiseAbs().maxCoeff()});
  }
  const double error = rounding * reach, radius = round.shape->radius;
  const auto is_proven = [&](const TriangleDistance& nearest) {
    const Vec3d way = nearest.on_a - nearest.on_b;
    if (!(nearest.distance > least_part * reach)) return false;
    outcome.normal = way / nearest.distance;
    double above = std::numeric_limits<double>::infinity(), below = -above;
    for (const Vec3d& end : core) above = std::min(above, outcome.normal.dot(end - nearest.on_b));
    for (const Vec3d& corner : corners)
      below = std::max(below, outcome.normal.dot(corner - nearest.on_b));
    outcome.lower = above - below - error - radius;
    outcome.upper = nearest.distance + error - radius;
    outcome.distance = nearest.distance - radius;
    outcome.witness_a = nearest.on_b;
    outcome.witness_b = nearest.on_a - radius * outcome.normal;
    return outcome.upper - outcome.lower < 4 * error;
  };
  TriangleDistance nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (const Vec3d& end : core) {
    const Vec3d on_triangle = closest_of(end, corners);
    const double distance = (end - on_triangle).norm();
    if (distance < nearest.distance) nearest = {end, on_triangle, distance};
    if (round.half_length == 0) break;
  }
  if (!is_proven(nearest) &&
      (round.half_length == 0 || !is_proven(distance_to_edges(core, corners)))) {
    return false;
  }
  outcome.answer = Answer::overlapping;
  outcome.status = Status::ok;
  return outcome.upper < -round.placed.error;
}

bool PartDepths::find_depth(Outcome& outcome) {
  outcome = {};
  for (const bool is_first : {true, false}) {
    const Side &round = is_first ? a_ : b_, &triangle = is_first ? b_ : a_;
    if (round.shape == nullptr || triangle.shape != nullptr) continue;
    if (round.shape->core > SupportCore::segment) continue;
    if (!find_depth_of_round(round, triangle, outcome)) continue;
    if (is_first) outcome = swapped(outcome);
    return true;
  }
  outcome = {};
  for (Side* side : {&a_, &b_}) {
    if (side->shape == nullptr) side->shape = &side->triangle.prepare(side->corners);
  }
  const SupportShape<double>&a = *a_.shape, &b = *b_.shape;
  if (a.core == SupportCore::halfspace || b.core == SupportCore::halfspace) return false;
  query_.solve(a, a_.placed.pose, b, b_.placed.pose, Task::penetration, nullptr, outcome);
  return outcome.status == Status::ok && outcome.answer == Answer::overlapping &&
         outcome.upper < -(a_.placed.error + b_.placed.error);
}

std::span<const Outcome> PartDepths::find(const PlacedConcave& a, const PlacedConcave& b,
                                          std::span<const IndexPair> pairs, ConvexPairs& others) {
  outcomes_.resize(pairs.size());
  left_.clear();
  left_pairs_.clear();
  a_.part = b_.part = none;
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    place(a, pairs[i].a, a_);
    place(b, pairs[i].b, b_);
    if (find_depth(outcomes_[i])) continue;
    left_.push_back(i);
    left_pairs_.push_back(pairs[i]);
  }
  if (left_.empty()) return outcomes_;
  const auto found = others.solve(Task::penetration, bodies_[a.body], a.pose, bodies_[b.body],
                                  b.pose, left_pairs_);
  for (std::size_t k = 0; k < left_.size(); ++k) outcomes_[left_[k]] = found[k];
  return outcomes_;
}

}  // namespace touchstone
