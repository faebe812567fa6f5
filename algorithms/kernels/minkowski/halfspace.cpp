// Signed distance of a half-space and a body, or of two half-spaces.
#include "algorithms/kernels/minkowski/halfspace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

// The transformed half-space in doubles, if its matrix is near to a rotation. `normal` is the matrix of cofactors times
// n, as it is; `most` sums the absolute values of all products of which it consists, and likewise for the height.
class PlainPlane {
 public:
  PlainPlane(const SupportShape<double>& b, const Pose& pose) {
    const double *const m = pose.rotation.data(), *const n = b.normal.data();
    double determinant = 0, most_determinant = 0;
    for (int j = 0; j < 3; ++j) {
      if (n[j] == 0) continue;
      const double *const own = m + 3 * j, *const next = m + 3 * ((j + 1) % 3),
                          *const last = m + 3 * ((j + 2) % 3);
      determinant = most_determinant = 0;
      for (int k = 0; k < 3; ++k) {
        const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        const double plus = next[k1] * last[k2], minus = next[k2] * last[k1];
        const double cofactor = plus - minus, sum = std::abs(plus) + std::abs(minus);
        normal_[k] += cofactor * n[j];
        most_[k] += sum * std::abs(n[j]);
        determinant += cofactor * own[k];
        most_determinant += sum * std::abs(own[k]);
      }
    }
    constexpr double nearly_one = 1e-8;
    const double square =
        normal_[0] * normal_[0] + normal_[1] * normal_[1] + normal_[2] * normal_[2];
    usable_ = std::abs(square - 1) < nearly_one && determinant > 0.5;
    inverse_ = 1.5 - 0.5 * square;  // of the root of a number next to one
    height_ = b.offset * determinant;
    most_height_ = std::abs(b.offset) * most_determinant;
  }

  // Solves a point, segment, box or hull with a ball around it over the half-space. Returns false if the bounds would
  // be further apart than the greatest that are accepted (see Bounds), or if a matrix is far from a rotation.
  bool solve(const SupportShape<double>& a, const Pose& pose_a, const Pose& pose_b, Task task,
             Outcome& outcome) const;

 private:
  static constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  // The height of a box is off by at most 14 roundings of the sum of all products. That of a hull's vertex is off by 2
  // more, since vertices are rounded, and another vertex may be lower by 6. The bounds of a box are accepted up to 32
  // roundings of the lengths, whose sum is below 2.8 units of the long doubles, so that they are within 88 of the 256
  // roundings of the resolution. The lengths of other bodies are below 4 units, and their bounds within 256.
  struct Bounds {
    double rounding, widest_part;
  };
  static constexpr Bounds of_boxes = {15 * u, 32 * u}, of_others = {26 * u, 64 * u};

  double normal_[3] = {}, most_[3] = {}, height_, most_height_, inverse_;
  bool usable_;
};

bool PlainPlane::solve(const SupportShape<double>& a, const Pose& pose_a, const Pose& pose_b,
                       Task task, Outcome& outcome) const {
  constexpr double scaling = 20 * u;
  constexpr double least_length = 1e-280;  // products of shorter ones lose digits
  if (!usable_) return false;
  const double *const r = pose_a.rotation.data(), *const to = pose_a.translation.data(),
                      *const from = pose_b.translation.data(), *const c = a.centre.data();
  double height = -height_, size = most_height_;
  for (int k = 0; k < 3; ++k) {
    const double offset = to[k] - from[k];
    height += normal_[k] * offset;
    size += most_[k] * std::abs(offset);
  }
  double along[3], greatest = 0;
  for (int k = 0; k < 3; ++k) {
    const double* const axis = r + 3 * k;
    along[k] = normal_[0] * axis[0] + normal_[1] * axis[1] + normal_[2] * axis[2];
    height += along[k] * c[k];
    for (int i = 0; i < 3; ++i) greatest = std::max(greatest, std::abs(axis[i]));
  }
  // The lowest point of the core from the centre, and an upper bound on the sum of its coordinates.
  double point[3] = {}, extents = 0;
  switch (a.core) {
    case SupportCore::point: break;
    case SupportCore::segment:
      extents = a.unit * a.extents[2];
      point[2] = along[2] > 0 ? -extents : extents;
      break;
    case SupportCore::box:
      for (int k = 0; k < 3; ++k) {
        const double half = a.unit * a.extents[k];
        point[k] = along[k] > 0 ? -half : half;
        extents += half;
      }
      break;
    case SupportCore::hull: {
      const Vec3d vertex = a.vertex(a.furthest({-along[0], -along[1], -along[2]}));
      for (int k = 0; k < 3; ++k) point[k] = a.unit * vertex[k];
      extents = 1.7320508075688774 * a.size;
      break;
    }
    default: return false;
  }
  const double lengths = std::abs(height) + extents + a.radius;
  for (int k = 0; k < 3; ++k) height += along[k] * point[k];
  // No number of the matrix of a is above one, but for rounding.
  const double centre = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]);
  size += (extents + centre) * (most_[0] + most_[1] + most_[2]) + a.radius;
  const Bounds& bounds = a.core == SupportCore::box ? of_boxes : of_others;
  const double error = bounds.rounding * size + scaling * std::abs(height);
  if (!(greatest < 1.001 && lengths > least_length && error <= bounds.widest_part / 2 * lengths))
    return false;
  const double distance = height * inverse_ - a.radius;
  Vec3d down = Vec3d::Zero(), on_a = Vec3d::Zero();
  if (task != Task::intersect) {
    down = -inverse_ * Vec3d(normal_[0], normal_[1], normal_[2]);
    on_a = pose_a.translation + a.radius * down;
    for (int k = 0; k < 3; ++k) {
      const double reach = c[k] + point[k];
      for (int i = 0; i < 3; ++i) on_a[i] += reach * r[3 * k + i];
    }
  }
  answer(task, distance, error, bounds.widest_part * lengths, down, on_a, outcome);
  outcome.iterations = 0;
  outcome.support_calls = 1;
  return true;
}

// Solves any pair of a bounded body and a half-space.
template <class Scalar>
void solve_in_long_doubles(const SupportShape<Scalar>& a, const Pose& pose_a,
                           const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                           Outcome& outcome) {
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

}  // namespace

template <class Scalar>
void solve_halfspace(const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                     Outcome& outcome) {
  if constexpr (std::is_same_v<Scalar, double>) {
    if (PlainPlane(b, pose_b).solve(a, pose_a, pose_b, task, outcome)) return;
  }
  solve_in_long_doubles(a, pose_a, b, pose_b, task, outcome);
}

template <class Scalar>
void solve_halfspace_batch(std::span<const SupportShape<Scalar>> shapes, const BodyPairs& pairs,
                           Task task, std::span<Outcome> outcomes) {
  std::conditional_t<std::is_same_v<Scalar, double>, std::optional<PlainPlane>, int> plane{};
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    const std::uint32_t first = pairs.first[i], second = pairs.second[i];
    const SupportShape<Scalar>&a = shapes[pairs.shape_of[first]],
          &b = shapes[pairs.shape_of[second]];
    const Pose &pose_a = pairs.poses[first], &pose_b = pairs.poses[second];
    if constexpr (std::is_same_v<Scalar, double>) {
      if (!plane || second != pairs.second[i - 1]) plane.emplace(b, pose_b);
      if (plane->solve(a, pose_a, pose_b, task, outcomes[i])) continue;
    }
    solve_in_long_doubles(a, pose_a, b, pose_b, task, outcomes[i]);
  }
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
template void solve_halfspace_batch(std::span<const SupportShape<float>>, const BodyPairs&, Task,
                                    std::span<Outcome>);
template void solve_halfspace_batch(std::span<const SupportShape<double>>, const BodyPairs&, Task,
                                    std::span<Outcome>);
template void solve_halfspaces(const SupportShape<float>&, const Pose&, const SupportShape<float>&,
                               const Pose&, Task, Outcome&);
template void solve_halfspaces(const SupportShape<double>&, const Pose&,
                               const SupportShape<double>&, const Pose&, Task, Outcome&);

}  // namespace touchstone
