// Depths of pairs of parts. GJK and EPA in doubles tell most of them, with bounds that hold beyond their
// rounding; a narrow phase that proves more takes several times as long to prepare two shapes.
#include "algorithms/concave/part_pairs/part_depths.h"

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/placed_box.h"

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
    side.shape = &side.triangle.prepare(bound.corners(part));
    side.placed = {body.pose, 0};
    return;
  }
  const std::size_t number = first_part_[body.body] + part;
  side.shape = &parts_[number];
  side.placed = bound.place(body.pose, part, reaches_[number]);
}

bool PartDepths::find_depth(Outcome& outcome) {
  const SupportShape<double>&a = *a_.shape, &b = *b_.shape;
  outcome = {};
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
