// Pairs of parts as batches of a narrow phase.
//
// Where poses were rounded by e in all, a verdict is certain if it is the same of one body scaled: if a
// ball of radius r around its origin is inside, scaling by 1 + e / r moves each support plane outward by
// e at least, and by 1 - e / r inward. That asks for verdicts only. Depths of curved bodies, which would
// tell too, take milliseconds.
#include "algorithms/concave/part_pairs/convex_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/placed_box.h"

namespace touchstone {
namespace {

constexpr std::uint32_t none = ~0u;

Shape triangle_shape(const TriangleCorners& corners) {
  Hull hull;
  hull.vertices.assign(corners.begin(), corners.end());
  hull.dimension = 2;
  hull.neighbours = {{1, 2}, {0, 2}, {0, 1}};
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::make_shared<const Hull>(std::move(hull));
  return shape;
}

// The radius of a ball around the shape's origin that is inside, and is scaled with the pose (metres).
double ball_in(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::box: return shape.half_extents.minCoeff();
    case ShapeKind::cylinder: return std::min(shape.radius, shape.half_length);
    case ShapeKind::cone: {
      const double slant = std::hypot(shape.radius, 2 * shape.half_length);
      return slant > 0 ? shape.radius / slant * shape.half_length : 0;
    }
    case ShapeKind::ellipsoid: return shape.radii.minCoeff();
    default: return 0;
  }
}

// The least factor by which a rotation that is nearly one shrinks vectors; 0 of other matrices.
double least_factor(const Mat3d& rotation) {
  const Mat3d squares = rotation.transpose() * rotation;
  const double skew = (squares - Mat3d::Identity()).cwiseAbs().rowwise().sum().maxCoeff();
  return skew < 0.1 ? 0.9 : 0;
}

}  // namespace

void ConvexPairs::bind(std::span<const BoundBody> bodies) {
  bodies_ = bodies;
  parts_.clear();
  first_part_.clear();
  for (const BoundBody& body : bodies) {
    first_part_.push_back(static_cast<std::uint32_t>(parts_.size()));
    for (const ConvexPart& part : body.given->parts) parts_.push_back(part.shape);
  }
  if (for_parts_ == nullptr && !parts_.empty()) for_parts_ = make_();
  if (for_parts_ != nullptr) for_parts_->bind(parts_);
}

void ConvexPairs::add(const Shape& shape, std::uint32_t number, const Pose& pose,
                      const Placed& placed) {
  if (has_triangles_) {
    number = static_cast<std::uint32_t>(shapes_.size());
    shapes_.push_back(shape);
  }
  shape_of_.push_back(number);
  poses_.push_back(pose);
  placed_.push_back(placed);
}

std::uint32_t ConvexPairs::place(const BoundBody& body, const Pose& pose, std::uint32_t part) {
  if (body.mesh() != nullptr) {
    add(triangle_shape(body.corners(part)), none, pose, {ShapeKind::hull, 0, 0, 0});
  } else {
    const ConvexPart& convex = body.given->parts[part];
    const double reach = reach_of({{tight_box(convex.shape, Pose{})}});
    const ComposedPose placed = body.place(pose, part, reach);
    const double ball =
        placed.error > 0 ? least_factor(placed.pose.rotation) * ball_in(convex.shape) : 0;
    const auto number = static_cast<std::size_t>(&body - bodies_.data());
    add(convex.shape, first_part_[number] + part, placed.pose,
        {convex.shape.kind, placed.error, reach, ball});
  }
  return static_cast<std::uint32_t>(poses_.size() - 1);
}

std::span<const Outcome> ConvexPairs::solve(Task task, const BoundBody& a, const Pose& pose_a,
                                            const BoundBody& b, const Pose& pose_b,
                                            std::span<const IndexPair> pairs) {
  has_triangles_ = a.mesh() != nullptr || b.mesh() != nullptr;
  shapes_.clear();
  shape_of_.clear();
  poses_.clear();
  placed_.clear();
  first_.clear();
  second_.clear();
  const auto grow = [](std::vector<std::uint32_t>& numbers, const BoundBody& body) {
    const std::size_t parts = body.given->part_count();
    if (numbers.size() < parts) numbers.resize(parts, none);
  };
  grow(number_in_a_, a);
  grow(number_in_b_, b);
  for (const IndexPair& pair : pairs) {
    std::uint32_t &in_a = number_in_a_[pair.a], &in_b = number_in_b_[pair.b];
    if (in_a == none) in_a = place(a, pose_a, pair.a);
    if (in_b == none) in_b = place(b, pose_b, pair.b);
    first_.push_back(in_a);
    second_.push_back(in_b);
  }
  for (const IndexPair& pair : pairs) number_in_a_[pair.a] = number_in_b_[pair.b] = none;
  if (has_triangles_) {
    if (for_triangles_ == nullptr) for_triangles_ = make_();
    for_triangles_->bind(shapes_);
  }
  asked_.resize(pairs.size());
  std::iota(asked_.begin(), asked_.end(), 0u);
  outcomes_.resize(pairs.size());
  solve_in_order(task, asked_, outcomes_);
  consider_rounding(task);
  return outcomes_;
}

// Solves the pairs with these numbers, in batches of equal kinds.
void ConvexPairs::solve_in_order(Task task, std::span<const std::uint32_t> pairs,
                                 std::span<Outcome> outcomes) {
  const auto kind = [&](std::uint32_t body) { return placed_[body].kind; };
  const auto needs_swap = [&](std::uint32_t i) { return kind(first_[i]) > kind(second_[i]); };
  const auto kinds_of = [&](std::uint32_t k) {
    const ShapeKind one = kind(first_[pairs[k]]), other = kind(second_[pairs[k]]);
    return std::pair(std::min(one, other), std::max(one, other));
  };
  order_.resize(pairs.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::sort(order_, {}, [&](std::uint32_t k) { return std::pair(kinds_of(k), k); });
  NarrowPhase& narrow_phase = has_triangles_ ? *for_triangles_ : *for_parts_;
  for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
    const auto kinds = kinds_of(order_[begin]);
    a_.clear();
    b_.clear();
    for (; end < order_.size() && kinds_of(order_[end]) == kinds; ++end) {
      const std::uint32_t i = pairs[order_[end]];
      a_.push_back(needs_swap(i) ? second_[i] : first_[i]);
      b_.push_back(needs_swap(i) ? first_[i] : second_[i]);
    }
    found_.assign(end - begin, Outcome{});
    const PairBatch batch = {
        .kind_a = kinds.first,
        .kind_b = kinds.second,
        .pairs = {.first = a_, .second = b_, .shape_of = shape_of_, .poses = poses_}};
    narrow_phase.solve(task, batch, found_);
    for (std::size_t k = begin; k < end; ++k) {
      const Outcome& found = found_[k - begin];
      outcomes[order_[k]] = needs_swap(pairs[order_[k]]) ? swapped(found) : found;
    }
  }
}

void ConvexPairs::consider_rounding(Task task) {
  ask_scaled(task);
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < outcomes_.size(); ++i) {
    if (next < scaled_.size() && scaled_[next] == i) {
      const bool apart = verdicts_[next].answer == Answer::separated;
      const bool is_sure = verdicts_[next].answer != Answer::unknown;
      ++next;
      if (is_sure && apart == (outcomes_[i].answer == Answer::separated)) continue;
    }
    if (placed_[first_[i]].rounding + placed_[second_[i]].rounding > 0) consider_rounding(task, i);
  }
}

// Asks for the verdicts of pairs with a body scaled, where a verdict is all that is needed.
void ConvexPairs::ask_scaled(Task task) {
  scaled_.clear();
  asked_.clear();
  for (std::uint32_t i = 0; i < outcomes_.size(); ++i) {
    const Answer answer = outcomes_[i].answer;
    if (answer == Answer::unknown || asks_for_number(task, answer) || !add_scaled(i)) continue;
    scaled_.push_back(i);
    asked_.push_back(static_cast<std::uint32_t>(first_.size() - 1));
  }
  verdicts_.resize(asked_.size());
  if (!asked_.empty()) solve_in_order(Task::intersect, asked_, verdicts_);
}

bool ConvexPairs::add_scaled(std::uint32_t pair) {
  const std::uint32_t first = first_[pair], second = second_[pair];
  const bool is_first = placed_[first].ball >= placed_[second].ball;
  const std::uint32_t body = is_first ? first : second;
  const Placed placed = placed_[body];
  const double rounding = placed_[first].rounding + placed_[second].rounding;
  // The second part is the rounding of the scaled matrix.
  const double part = (2 * rounding + 0x1p-48 * placed.reach) / placed.ball;
  if (!(rounding > 0 && part < 1e-3)) return false;
  Pose pose = poses_[body];
  pose.rotation *= outcomes_[pair].answer == Answer::separated ? 1 + part : 1 - part;
  poses_.push_back(pose);
  shape_of_.push_back(std::uint32_t{shape_of_[body]});
  placed_.push_back(placed);
  const auto scaled = static_cast<std::uint32_t>(poses_.size() - 1);
  first_.push_back(is_first ? scaled : first);
  second_.push_back(is_first ? second : scaled);
  return true;
}

// The verdict holds if the signed distance is further from zero than the rounding: another query tells,
// if this one has not.
void ConvexPairs::consider_rounding(Task task, std::uint32_t pair) {
  const double rounding = placed_[first_[pair]].rounding + placed_[second_[pair]].rounding;
  Outcome& outcome = outcomes_[pair];
  const bool apart = outcome.answer == Answer::separated;
  Outcome measured = outcome;
  if (!asks_for_number(task, outcome.answer)) {
    const std::array<std::uint32_t, 1> number = {pair};
    solve_in_order(apart ? Task::distance : Task::penetration, number, {&measured, 1});
  }
  // Bounds that the narrow phase does not give are taken to be a millionth off.
  const double distance = measured.distance;
  const double lower = std::isfinite(measured.lower) ? measured.lower : distance * (1 - 1e-6);
  const double upper = std::isfinite(measured.upper) ? measured.upper : distance * (1 - 1e-6);
  if (apart ? lower > rounding : upper < -rounding) {
    if (asks_distance(task) && apart) {
      outcome.lower = lower - rounding;
      outcome.upper =
          (std::isfinite(measured.upper) ? measured.upper : distance * (1 + 1e-6)) + rounding;
    }
    return;
  }
  outcome.answer = Answer::unknown;
  outcome.status = Status::degenerate;
}

}  // namespace touchstone
