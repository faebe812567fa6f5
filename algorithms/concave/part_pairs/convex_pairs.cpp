// Pairs of parts as a batch of a narrow phase.
#include "algorithms/concave/part_pairs/convex_pairs.h"

#include <algorithm>
#include <map>
#include <utility>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/placed_box.h"

namespace touchstone {
namespace {

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

}  // namespace

std::uint32_t ConvexPairs::place(const BoundBody& body, const Pose& pose, std::uint32_t part) {
  if (body.mesh() != nullptr) {
    shapes_.push_back(triangle_shape(body.corners(part)));
    poses_.push_back(pose);
    roundings_.push_back(0);
  } else {
    const ConvexPart& convex = body.given->parts[part];
    const ComposedPose placed =
        composed(pose, convex.pose, reach_of({{tight_box(convex.shape, Pose{})}}));
    const double grown = pose.rotation.cwiseAbs().rowwise().sum().maxCoeff() * convex.rounding;
    shapes_.push_back(convex.shape);
    poses_.push_back(placed.pose);
    roundings_.push_back(placed.error + 2 * grown);
  }
  return static_cast<std::uint32_t>(shapes_.size() - 1);
}

std::span<const Outcome> ConvexPairs::solve(Task task, const BoundBody& a, const Pose& pose_a,
                                            const BoundBody& b, const Pose& pose_b,
                                            std::span<const IndexPair> pairs) {
  shapes_.clear();
  poses_.clear();
  roundings_.clear();
  first_.clear();
  second_.clear();
  std::map<std::uint32_t, std::uint32_t> number_a, number_b;
  for (const IndexPair& pair : pairs) {
    const auto [in_a, new_a] = number_a.try_emplace(pair.a, 0);
    if (new_a) in_a->second = place(a, pose_a, pair.a);
    const auto [in_b, new_b] = number_b.try_emplace(pair.b, 0);
    if (new_b) in_b->second = place(b, pose_b, pair.b);
    first_.push_back(in_a->second);
    second_.push_back(in_b->second);
  }
  narrow_phase_->bind(shapes_);
  outcomes_.assign(pairs.size(), Outcome{});
  numbers_.resize(pairs.size());
  for (std::uint32_t i = 0; i < pairs.size(); ++i) numbers_[i] = i;
  solve_in_order(task, numbers_, outcomes_);
  consider_rounding(task);
  return outcomes_;
}

// Solves the pairs with these numbers, in batches of equal kinds.
void ConvexPairs::solve_in_order(Task task, std::span<const std::uint32_t> pairs,
                                 std::span<Outcome> outcomes) {
  std::map<std::pair<ShapeKind, ShapeKind>, std::vector<std::uint32_t>> of_kinds;
  const auto needs_swap = [&](std::uint32_t i) {
    return shapes_[first_[i]].kind > shapes_[second_[i]].kind;
  };
  for (const std::uint32_t i : pairs) {
    of_kinds[std::minmax(shapes_[first_[i]].kind, shapes_[second_[i]].kind)].push_back(i);
  }
  std::vector<std::uint32_t> shape_of(shapes_.size()), a, b;
  for (std::uint32_t k = 0; k < shape_of.size(); ++k) shape_of[k] = k;
  std::vector<Outcome> found;
  for (const auto& [kinds, numbers] : of_kinds) {
    a.clear();
    b.clear();
    for (const std::uint32_t i : numbers) {
      a.push_back(needs_swap(i) ? second_[i] : first_[i]);
      b.push_back(needs_swap(i) ? first_[i] : second_[i]);
    }
    found.assign(numbers.size(), Outcome{});
    const PairBatch batch = {
        .kind_a = kinds.first,
        .kind_b = kinds.second,
        .pairs = {.first = a, .second = b, .shape_of = shape_of, .poses = poses_}};
    narrow_phase_->solve(task, batch, found);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      outcomes[numbers[k]] = needs_swap(numbers[k]) ? swapped(found[k]) : found[k];
    }
  }
}

// Where poses were rounded, a verdict holds if the signed distance is further from zero than the
// rounding: another query tells.
void ConvexPairs::consider_rounding(Task task) {
  std::vector<Outcome> more(1);
  for (std::uint32_t i = 0; i < outcomes_.size(); ++i) {
    const double rounding = roundings_[first_[i]] + roundings_[second_[i]];
    if (rounding == 0) continue;
    Outcome& outcome = outcomes_[i];
    const bool apart = outcome.answer == Answer::separated;
    Outcome measured = outcome;
    if (task == Task::intersect || !apart) {
      more[0] = Outcome{};
      const std::array<std::uint32_t, 1> pair = {i};
      std::vector<Outcome> all(outcomes_.size());
      solve_in_order(apart ? Task::distance : Task::penetration, pair, all);
      measured = all[i];
    }
    // Bounds that the narrow phase does not give are taken to be a millionth off.
    const double distance = measured.distance;
    const double lower = std::isfinite(measured.lower) ? measured.lower : distance * (1 - 1e-6);
    const double upper = std::isfinite(measured.upper) ? measured.upper : distance * (1 - 1e-6);
    if (apart ? lower > rounding : upper < -rounding) {
      if (task != Task::intersect && apart) {
        outcome.lower = lower - rounding;
        outcome.upper =
            (std::isfinite(measured.upper) ? measured.upper : distance * (1 + 1e-6)) + rounding;
      }
      continue;
    }
    outcome.answer = Answer::unknown;
    outcome.status = Status::degenerate;
  }
}

}  // namespace touchstone
