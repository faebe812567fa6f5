// Signed distance of a half-space and a body, or of two half-spaces.
#include "algorithms/kernels/minkowski/halfspace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "algorithms/core/cofactors.h"
#include "algorithms/kernels/minkowski/resolution.h"

namespace touchstone {
namespace {

// Far from the world's origin a plane's position is a small difference of large numbers, so it is
// computed in long double.
using Wide = long double;
using Wide3 = Eigen::Matrix<Wide, 3, 1>;

Wide3 wide(const Vec3d& x) { return x.cast<Wide>(); }

// The transformed half-space: points y with normal . (y - t) <= height. Planes map by the inverse
// transpose of the matrix: the matrix of its cofactors divided by the determinant.
struct WorldPlane {
  Wide3 normal;  // unit
  Wide height;
};

template <class Scalar>
WorldPlane world_plane(const SupportShape<Scalar>& halfspace, const Pose& pose) {
  const Mat3<Wide> matrix = pose.rotation.cast<Wide>();
  const Mat3<Wide> cofactors = cofactor_matrix(matrix);
  const Wide determinant = matrix.row(0).dot(cofactors.row(0));
  const Wide3 normal = cofactors * wide(halfspace.normal);
  const Wide length = std::copysign(normal.norm(), determinant);
  return {normal / length, halfspace.offset * (determinant / length)};
}

// Relative rounding of lengths that cancel.
constexpr Wide wide_rounding = 64 * std::numeric_limits<Wide>::epsilon();

// Writes the results that the task asks for. Lengths are in metres; `widest` is the resolution;
// `normal` is from a to b; `on_a` is the witness point on a.
void answer(Task task, double distance, double rounding, double widest, const Vec3d& normal,
            const Vec3d& on_a, Outcome& outcome) {
  const bool apart = distance > rounding;
  const bool common = distance < -rounding;
  if (apart || common) {
    outcome.answer = apart ? Answer::separated : Answer::overlapping;
    outcome.status = Status::ok;
  } else if (!write_if_touching(distance - rounding, distance + rounding, widest, outcome)) {
    outcome.answer = Answer::unknown;
    outcome.status = Status::not_converged;
    clear_numbers(outcome);
  }
  if (!asks_for_number(task, outcome.answer)) return;
  outcome.distance = distance;
  outcome.lower = distance - rounding;
  outcome.upper = distance + rounding;
  outcome.normal = normal;
  outcome.witness_a = on_a;
  outcome.witness_b = on_a + distance * normal;
}

// Solves a box over a half-space in double. Returns false if the bounds would be further apart than
// 32 roundings of the lengths, up to 1.4 times those in long double, or if the matrix of b is far from a rotation.
//
// `normal` is the matrix of b's cofactors times n, as it is; `size` sums the absolute values of all
// products of which it and the heights consist. No height is off by more than 14 roundings of that.
bool solve_plain_box(const SupportShape<double>& a, const Pose& pose_a,
                     const SupportShape<double>& b, const Pose& pose_b, Task task,
                     Outcome& outcome) {
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  constexpr double rounding = 15 * u, scaling = 20 * u, widest_part = 32 * u, nearly_one = 1e-8;
  constexpr double least_length = 1e-280;  // products of shorter ones lose digits
  const double *const m = pose_b.rotation.data(), *const r = pose_a.rotation.data();
  const double *const n = b.normal.data(), *const to = pose_a.translation.data(),
                      *const from = pose_b.translation.data();
  double normal[3] = {}, most[3] = {}, determinant = 0, most_determinant = 0;
  for (int j = 0; j < 3; ++j) {
    if (n[j] == 0) continue;
    const double *const own = m + 3 * j, *const next = m + 3 * ((j + 1) % 3),
                        *const last = m + 3 * ((j + 2) % 3);
    determinant = most_determinant = 0;
    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const double plus = next[k1] * last[k2], minus = next[k2] * last[k1];
      const double cofactor = plus - minus, sum = std::abs(plus) + std::abs(minus);
      normal[k] += cofactor * n[j];
      most[k] += sum * std::abs(n[j]);
      determinant += cofactor * own[k];
      most_determinant += sum * std::abs(own[k]);
    }
  }
  const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  if (!(std::abs(square - 1) < nearly_one && determinant > 0.5)) return false;
  double height = -b.offset * determinant, size = std::abs(b.offset) * most_determinant;
  for (int k = 0; k < 3; ++k) {
    const double offset = to[k] - from[k];
    height += normal[k] * offset;
    size += most[k] * std::abs(offset);
  }
  const double offsets = std::abs(height);
  double extents = 0, greatest = 0, half[3], along[3];
  for (int k = 0; k < 3; ++k) {
    const double* const axis = r + 3 * k;
    half[k] = a.unit * a.extents[k];
    along[k] = normal[0] * axis[0] + normal[1] * axis[1] + normal[2] * axis[2];
    height -= half[k] * std::abs(along[k]);
    extents += half[k];
    for (int i = 0; i < 3; ++i) greatest = std::max(greatest, std::abs(axis[i]));
  }
  // No number of the matrix of a is above one, but for rounding.
  size += extents * (most[0] + most[1] + most[2]);
  const double lengths = offsets + extents;
  // The sum of these lengths is below 2.8 units of the long doubles, so that the bounds are within 88 of the 256
  // roundings of the resolution.
  const double error = rounding * size + scaling * std::abs(height);
  if (!(greatest < 1.001 && lengths > least_length && error <= widest_part / 2 * lengths))
    return false;
  // The root of a number next to one.
  const double inverse = 1.5 - 0.5 * square;
  const double distance = height * inverse;
  Vec3d down = Vec3d::Zero(), on_a = Vec3d::Zero();
  if (task != Task::intersect) {
    down = -inverse * Vec3d(normal[0], normal[1], normal[2]);
    on_a = pose_a.translation;
    for (int k = 0; k < 3; ++k) {
      const double reach = along[k] > 0 ? -half[k] : half[k];
      for (int i = 0; i < 3; ++i) on_a[i] += reach * r[3 * k + i];
    }
  }
  answer(task, distance, error, widest_part * lengths, down, on_a, outcome);
  outcome.iterations = 0;
  outcome.support_calls = 1;
  return true;
}

}  // namespace

template <class Scalar>
void solve_halfspace(const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                     Outcome& outcome) {
  if constexpr (std::is_same_v<Scalar, double>) {
    if (a.core == SupportCore::box && solve_plain_box(a, pose_a, b, pose_b, task, outcome)) return;
  }
  const auto [plane, plane_height] = world_plane(b, pose_b);
  const Wide3 turned_centre = pose_a.rotation.cast<Wide>() * wide(a.centre);
  const Wide3 from_b = turned_centre + (wide(pose_a.translation) - wide(pose_b.translation));
  const auto height = static_cast<double>(plane.dot(from_b) - plane_height);
  const Wide lengths = (turned_centre.cwiseAbs() + wide(pose_a.translation).cwiseAbs() +
                        wide(pose_b.translation).cwiseAbs())
                           .sum() +
                       std::abs(plane_height);

  const double unit = power_of_two_above(std::max(std::abs(height), a.reach(pose_a.rotation)));
  PosedShape<Scalar> turned(a, pose_a.rotation, unit);
  const Vec3<Scalar> outward = plane.template cast<Scalar>();
  const Vec3<Scalar> lowest = turned.support(-outward);
  const Scalar distance =
      static_cast<Scalar>(height / unit) + outward.dot(lowest) - turned.radius();

  const Vec3d normal = -plane.template cast<double>();
  const Vec3d on_a = pose_a(a.centre) + unit * (lowest.template cast<double>() +
                                                static_cast<double>(turned.radius()) * normal);
  constexpr double rounding = static_cast<double>(SupportPair<Scalar>::rounding);
  answer(task, static_cast<double>(distance) * unit,
         rounding * unit + static_cast<double>(wide_rounding * lengths), unit * resolution<Scalar>,
         normal, on_a, outcome);
  outcome.iterations = 0;
  outcome.support_calls = 1;
}

template <class Scalar>
void solve_halfspaces(const SupportShape<Scalar>& a, const Pose& pose_a,
                      const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                      Outcome& outcome) {
  const auto [normal_a, height_a] = world_plane(a, pose_a);
  const auto [normal_b, own_height_b] = world_plane(b, pose_b);
  constexpr double rounding = static_cast<double>(SupportPair<Scalar>::rounding);
  outcome.iterations = 0;
  outcome.support_calls = 0;
  if (normal_a.dot(normal_b) > 0 || normal_a.cross(normal_b).norm() > rounding) {
    outcome.answer = Answer::overlapping;
    outcome.status = asks_depth(task) ? Status::degenerate : Status::ok;
    if (asks_depth(task)) clear_numbers(outcome);
    return;
  }
  // Heights of the two planes along a's normal, relative to the origin of body a.
  const Wide place_b = normal_a.dot(wide(pose_b.translation) - wide(pose_a.translation));
  const Wide height_b = place_b - own_height_b;
  const double size =
      static_cast<double>(std::max({std::abs(height_a), std::abs(place_b), std::abs(height_b)}));
  const Vec3d normal = normal_a.template cast<double>();
  answer(task, static_cast<double>(height_b - height_a), rounding * size, size * resolution<Scalar>,
         normal, pose_a.translation + static_cast<double>(height_a) * normal, outcome);
}

template void solve_halfspace(const SupportShape<float>&, const Pose&, const SupportShape<float>&,
                              const Pose&, Task, Outcome&);
template void solve_halfspace(const SupportShape<double>&, const Pose&, const SupportShape<double>&,
                              const Pose&, Task, Outcome&);
template void solve_halfspaces(const SupportShape<float>&, const Pose&, const SupportShape<float>&,
                               const Pose&, Task, Outcome&);
template void solve_halfspaces(const SupportShape<double>&, const Pose&,
                               const SupportShape<double>&, const Pose&, Task, Outcome&);

}  // namespace touchstone
