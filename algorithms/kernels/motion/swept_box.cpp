// Swept boxes, rounded outward.
#include "algorithms/kernels/motion/swept_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algorithms/core/bounds.h"
#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr float greatest = std::numeric_limits<float>::max();
// The angle between two attitudes whose boxes are computed (radians). Half of it is lost by 3 % of
// the body's reach.
constexpr double attitude_step = 0.5;
// From about one turn on, the box holds every attitude.
constexpr double whole_turn = 6.5;

// The greatest float <= x + y and the least float >= x + y. The error of the sum is exact (Knuth's
// two-sum), and says on which side of the exact sum the rounded one is. A sum that is off is not 0.
float sum_down(double x, double y) {
  const double sum = x + y;
  const double part = sum - x;
  const double error = (x - (sum - part)) + (y - part);  // NaN if the sum is infinite
  return round_down(step_down_if(error < 0, sum));
}
float sum_up(double x, double y) { return -sum_down(-x, -y); }

Aabb joined(const Aabb& a, const Aabb& b) {
  Aabb all;
  for (std::size_t k = 0; k < 3; ++k) {
    all.min[k] = std::min(a.min[k], b.min[k]);
    all.max[k] = std::max(a.max[k], b.max[k]);
  }
  return all;
}

// The box of a body in all attitudes of its rotation, with its origin at rest. A point that turns by
// `step` about an axis moves on an arc, of radius r at most the reach, which is no further than
// r (1 - cos(step / 2)) <= r step^2 / 8 from its chord; the chord's ends are in the boxes of the two
// attitudes, and so is the chord in their joint box. On top comes the rounding of the attitudes
// (relative_motion.h), twice.
Aabb turning_box(const Shape& shape, const Pose& pose, const Vec3d& rotation_vector) {
  const double reach = loose_reach(shape, pose.rotation) * (1 + 64 * epsilon);
  const Aabb loose = loose_box(reach, pose.translation);
  const double angle = rotation_vector.stableNorm();
  if (!(angle < whole_turn)) return loose;
  const double steps = std::max(1.0, std::ceil(angle / attitude_step));
  const double step = angle / steps;
  Aabb box = tight_box(shape, pose);
  for (double k = 1; k <= steps; ++k) {
    const Pose turned = {rotation_by(k / steps * rotation_vector) * pose.rotation,
                         pose.translation};
    box = joined(box, tight_box(shape, turned));
  }
  const double margin = reach * (0.126 * step * step + (8 * angle + 60) * epsilon);
  for (std::size_t k = 0; k < 3; ++k) {
    box.min[k] = std::max(loose.min[k], sum_down(box.min[k], -margin));
    box.max[k] = std::min(loose.max[k], sum_up(box.max[k], margin));
  }
  return box;
}

Aabb everything() {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  return {{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}};
}

}  // namespace

MovingBox moving_box_of(const Shape& shape, const Pose& pose, const Motion& motion) {
  const bool turns = motion.turns();
  // Most bodies of a scene of obstacles are at rest.
  if (!turns && motion.displacement.isZero(0)) return {tight_box(shape, pose), {0, 0, 0}, 0};
  if (turns && shape.kind == ShapeKind::halfspace) return {everything(), {0, 0, 0}, 0};
  MovingBox body;
  body.box = turns ? turning_box(shape, pose, motion.rotation_vector) : tight_box(shape, pose);
  for (std::size_t k = 0; k < 3; ++k) {
    const double displacement = motion.displacement[static_cast<Eigen::Index>(k)];
    const double within =
        std::clamp(displacement, -static_cast<double>(greatest), static_cast<double>(greatest));
    const auto rounded = static_cast<float>(within);
    // At time t the body is t times this further than the box, which grows by all of it.
    const double rest = displacement - static_cast<double>(rounded);
    body.displacement[k] = rounded;
    body.box.min[k] = sum_down(body.box.min[k], std::min(rest, 0.0));
    body.box.max[k] = sum_up(body.box.max[k], std::max(rest, 0.0));
  }
  return body;
}

Aabb swept_box_of(const MovingBox& body, double begin, double end) {
  // Each box is written where it is to be: a copy of numbers just written would wait for them.
  if (body.box.is_empty()) return body.box;
  const auto cut = [](float end_of_box) { return std::clamp(end_of_box, -greatest, greatest); };
  const std::array<float, 3>&min = body.box.min, &max = body.box.max;
  if (body.displacement == std::array{0.0F, 0.0F, 0.0F})
    return {{cut(min[0]), cut(min[1]), cut(min[2])}, {cut(max[0]), cut(max[1]), cut(max[2])}};
  // Products are exact: 24 bits times 21.
  const auto low = [&](std::size_t k) {
    const double move = body.displacement[k];
    return cut(sum_down(min[k], std::min(begin * move, end * move)));
  };
  const auto high = [&](std::size_t k) {
    const double move = body.displacement[k];
    return cut(sum_up(max[k], std::max(begin * move, end * move)));
  };
  return {{low(0), low(1), low(2)}, {high(0), high(1), high(2)}};
}

}  // namespace touchstone
