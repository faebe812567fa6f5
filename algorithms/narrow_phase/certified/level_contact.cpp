// Part of certified: the exact gaps of level_contact.h, and the point that two faces share.
#include "algorithms/narrow_phase/certified/level_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// Sums of numbers below this do not overflow, nor do products of two.
constexpr double greatest = 0x1p400;

// Returns the rounded sum, and sets `rest` to what rounding took from it.
double add(double a, double b, double& rest) {
  const double sum = a + b, of_b = sum - a;
  rest = (a - (sum - of_b)) + (b - of_b);
  return sum;
}

// The exact sum, off by at most a unit in its last place, and with its sign; zero if that is zero.
double sum_exactly(const std::array<double, 4>& terms) {
  // Parts whose digits do not overlap, from the least on.
  std::array<double, 4> parts = {};
  for (std::size_t n = 0; n < terms.size(); ++n) {
    double sum = terms[n];
    for (std::size_t k = 0; k < n; ++k) sum = add(sum, parts[k], parts[k]);
    parts[n] = sum;
  }
  // The paper's compression: the last part takes all that it has digits for.
  double sum = parts[3], rest = 0;
  std::size_t bottom = 3;
  for (std::size_t k = 3; k-- > 0;) {
    sum = add(sum, parts[k], rest);
    if (rest == 0) continue;
    parts[bottom--] = sum;
    sum = rest;
  }
  for (std::size_t k = bottom + 1; k < parts.size(); ++k) sum = add(parts[k], sum, rest);
  return sum;
}

// The sum with its exact sign, quickly where that is plain.
double sum_of(const std::array<double, 4>& terms) {
  const double sum = (terms[0] + terms[1]) + (terms[2] + terms[3]);
  double size = 0;
  for (const double x : terms) size += std::abs(x);
  return std::abs(sum) > 4 * std::numeric_limits<double>::epsilon() * size ? sum
                                                                           : sum_exactly(terms);
}

// The number of the box's own axis that is along this axis of the world, or -1.
int level_axis(const Mat3d& rotation, int axis) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(rotation(axis, k)) != 1) continue;
    return rotation(axis, (k + 1) % 3) == 0 && rotation(axis, (k + 2) % 3) == 0 ? k : -1;
  }
  return -1;
}

// A matrix of which a face keeps its shape, but for a thousandth.
bool is_nearly_rotation(const Mat3d& m) {
  return ((m.transpose() * m - Mat3d::Identity()).cwiseAbs().maxCoeff()) < 1e-3;
}

struct Gap {
  int axis = -1, own_a = -1, own_b = -1;
  double value = -std::numeric_limits<double>::infinity();
};

struct SharedPoint {
  bool proven = false;
  Vec3d point;  // world
};

// A point of the face of b at which the gap is zero, if one is within that of a by more than
// rounding and than it misses the face of a found for it.
SharedPoint shared_point(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                         const Gap& gap) {
  if (!is_nearly_rotation(pose_a.rotation) || !is_nearly_rotation(pose_b.rotation)) return {};
  const Vec3d offset = pose_b.translation - pose_a.translation;
  const double side = offset[gap.axis] < 0 ? -1 : 1;
  // Places on the faces: the ends along the axes that are level.
  Vec3d low_a = -0x1.fcp-1 * a.half_extents, high_a = -low_a;
  Vec3d low_b = -b.half_extents, high_b = b.half_extents;
  const double end_a = side * pose_a.rotation(gap.axis, gap.own_a) * a.half_extents[gap.own_a];
  const double end_b = -side * pose_b.rotation(gap.axis, gap.own_b) * b.half_extents[gap.own_b];
  low_a[gap.own_a] = high_a[gap.own_a] = end_a;
  low_b[gap.own_b] = high_b[gap.own_b] = end_b;
  Vec3d at_a = (pose_a.rotation.transpose() * offset).cwiseMax(low_a).cwiseMin(high_a);
  Vec3d point, miss;
  const double size = offset.lpNorm<1>() + a.half_extents.sum() + b.half_extents.sum();
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * size;
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    const Vec3d from_b = pose_a.rotation * at_a - offset;
    const Vec3d at_b = (pose_b.rotation.transpose() * from_b).cwiseMax(low_b).cwiseMin(high_b);
    point = offset + pose_b.rotation * at_b;
    at_a = (pose_a.rotation.transpose() * point).cwiseMax(low_a).cwiseMin(high_a);
    miss = point - pose_a.rotation * at_a;
    if (miss.cwiseAbs().maxCoeff() <= rounding) break;
  }
  double room = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (k != gap.own_a) room = std::min(room, a.half_extents[k] - std::abs(at_a[k]));
  }
  return {room > 4 * (miss.norm() + rounding), pose_a.translation + point};
}

// Boxes that are level along all axes: half extents along the axes of the world, and exact gaps.
struct UprightPair {
  Vec3d half_a, half_b, gaps;
};

// Writes all numbers. `best` has the greatest gap.
void write_numbers(const UprightPair& pair, const Pose& pose_a, const Pose& pose_b, const Gap& best,
                   Outcome& outcome) {
  Vec3d along = Vec3d::Zero();  // the gaps that count, from a to b
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const double to_a = pose_a.translation[k], to_b = pose_b.translation[k];
    const double side = to_b < to_a ? -1 : 1;
    const bool counts = k == best.axis || pair.gaps[k] > 0;
    if (counts) {
      along[k] = side * (best.value > 0 ? pair.gaps[k] : 1);
      ++count;
      outcome.witness_a[k] = to_a + side * pair.half_a[k];
      outcome.witness_b[k] = to_b - side * pair.half_b[k];
    } else {
      // The middle of what they have in common.
      const double low = std::max(to_a - pair.half_a[k], to_b - pair.half_b[k]);
      const double high = std::min(to_a + pair.half_a[k], to_b + pair.half_b[k]);
      outcome.witness_a[k] = outcome.witness_b[k] = low + (high - low) / 2;
    }
  }
  double distance = best.value;
  if (count > 1 && best.value > 0) distance = along.norm();
  outcome.distance = distance;
  // Each gap is off by a unit in its last place, and no more than six roundings follow.
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(distance);
  outcome.lower = distance - rounding;
  outcome.upper = distance + rounding;
  outcome.normal = best.value > 0 ? Vec3d(along / distance) : along;
}

bool in_range(const Shape& box, const Pose& pose) {
  return box.half_extents.maxCoeff() < greatest &&
         pose.translation.cwiseAbs().maxCoeff() < greatest;
}

void write(Answer answer, Outcome& outcome) {
  outcome.answer = answer;
  outcome.status = Status::ok;
  if (answer == Answer::touching) outcome.lower = outcome.upper = 0;
}

}  // namespace

bool decide_level_boxes(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                        Task task, Outcome& outcome) {
  if (!in_range(a, pose_a) || !in_range(b, pose_b)) return false;
  UprightPair pair;
  Gap best;
  unsigned own_axes_a = 0, own_axes_b = 0;  // as bits
  for (int axis = 0; axis < 3; ++axis) {
    const int own_a = level_axis(pose_a.rotation, axis), own_b = level_axis(pose_b.rotation, axis);
    if (own_a < 0 || own_b < 0) continue;
    own_axes_a |= 1u << own_a;
    own_axes_b |= 1u << own_b;
    pair.half_a[axis] = a.half_extents[own_a];
    pair.half_b[axis] = b.half_extents[own_b];
    const auto [from, to] = std::minmax(pose_a.translation[axis], pose_b.translation[axis]);
    const std::array<double, 4> terms = {to, -from, -pair.half_a[axis], -pair.half_b[axis]};
    pair.gaps[axis] = task == Task::intersect ? sum_of(terms) : sum_exactly(terms);
    if (pair.gaps[axis] > best.value) best = {axis, own_a, own_b, pair.gaps[axis]};
  }
  if (own_axes_a == 0) return false;
  const bool upright = (own_axes_a & own_axes_b) == 0b111;
  const Answer answer = best.value > 0    ? Answer::separated
                        : best.value == 0 ? Answer::touching
                        : upright         ? Answer::overlapping
                                          : Answer::unknown;
  if (answer == Answer::unknown) return false;
  const bool asked = asks_for_number(task, answer);
  if (upright) {
    // Squares of gaps in this range neither underflow nor overflow.
    const bool several = (pair.gaps.array() > 0).count() > 1;
    if (asked && several && !(best.value > 1e-100 && best.value < 1e100)) return false;
    if (asked) write_numbers(pair, pose_a, pose_b, best, outcome);
    write(answer, outcome);
    return true;
  }
  if (answer == Answer::separated) {
    if (!asked) write(answer, outcome);
    return !asked;
  }
  const SharedPoint shared = shared_point(a, pose_a, b, pose_b, best);
  if (!shared.proven) return false;
  write(answer, outcome);
  if (!asked) return true;
  outcome.distance = 0;
  const bool ahead = pose_b.translation[best.axis] >= pose_a.translation[best.axis];
  outcome.normal = (ahead ? 1.0 : -1.0) * Vec3d::Unit(best.axis);
  outcome.witness_a = outcome.witness_b = shared.point;
  return true;
}

bool decide_level_plane(const Shape& box, const Pose& pose, const Shape& halfspace,
                        const Pose& pose_of_plane, Task task, Outcome& outcome) {
  int axis = 0;
  halfspace.normal.cwiseAbs().maxCoeff(&axis);
  const double side = halfspace.normal[axis];
  const int own = level_axis(pose.rotation, axis);
  if (own < 0 || std::abs(side) != 1 || halfspace.normal != Vec3d(side * Vec3d::Unit(axis)) ||
      !pose_of_plane.rotation.isIdentity(0) || !in_range(box, pose) ||
      !(pose_of_plane.translation.cwiseAbs().maxCoeff() < greatest &&
        std::abs(halfspace.offset) < greatest)) {
    return false;
  }
  const double gap = sum_of({side * pose.translation[axis], -side * pose_of_plane.translation[axis],
                             -halfspace.offset, -box.half_extents[own]});
  const Answer answer = gap > 0   ? Answer::separated
                        : gap < 0 ? Answer::overlapping
                                  : Answer::touching;
  const bool asked = asks_for_number(task, answer);
  if (asked && gap != 0) return false;
  write(answer, outcome);
  if (!asked) return true;
  outcome.distance = 0;
  outcome.normal = -side * Vec3d::Unit(axis);
  const double end = -side * pose.rotation(axis, own) * box.half_extents[own];
  outcome.witness_a = outcome.witness_b = pose.translation + end * pose.rotation.col(own);
  return true;
}

}  // namespace touchstone
