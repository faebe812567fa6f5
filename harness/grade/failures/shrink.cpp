// Shrinks a failing case step by step: vertices, kinds, poses, numbers.
#include "harness/grade/failures/shrink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/signed_permutation.h"
#include "harness/grade/failures/case_numbers.h"

namespace touchstone::grade {
namespace {

// Returns whether every size that was not zero is still not zero, so that a solid stays solid.
bool keeps_sizes(const Shape& before, const Shape& after) {
  if (before.kind != after.kind) return true;
  const auto kept = [](double x, double y) { return x == 0 || y > 0; };
  if (before.kind == ShapeKind::hull) return after.hull->dimension >= before.hull->dimension;
  bool all = kept(before.radius, after.radius) && kept(before.half_length, after.half_length);
  for (int i = 0; i < 3; ++i) {
    all = all && kept(before.half_extents[i], after.half_extents[i]) &&
          kept(before.radii[i], after.radii[i]);
  }
  return all;
}

class Shrinker {
 public:
  Shrinker(const files::Case& c, const FailurePredicate& still_fails, int budget)
      : best_(c), still_fails_(still_fails), budget_(budget) {}

  files::Case run() {
    do {
      changed_ = false;
      drop_vertices(&files::Case::shape_a);
      drop_vertices(&files::Case::shape_b);
      simplify_shapes();
      move_to_origin();
      simplify_rotations();
      bake_poses();
      round_all();
    } while (changed_ && budget_ > 0);
    return std::move(best_);
  }

 private:
  bool keep_if_fails(files::Case candidate) {
    if (budget_ <= 0 || !keeps_sizes(best_.shape_a, candidate.shape_a) ||
        !keeps_sizes(best_.shape_b, candidate.shape_b)) {
      return false;
    }
    for (Pose* pose : {&candidate.pose_a, &candidate.pose_b}) {
      pose->translation.array() += 0.0;  // turns negative zeros into positive ones
    }
    --budget_;
    if (!still_fails_(candidate)) return false;
    best_ = std::move(candidate);
    changed_ = true;
    return true;
  }

  // --- vertices ---------------------------------------------------------------------------------

  void drop_vertices(Shape files::Case::*shape) {
    if ((best_.*shape).kind != ShapeKind::hull) return;
    const auto count = [&] { return (best_.*shape).hull->vertices.size(); };
    for (std::size_t chunk = count() / 2; chunk >= 1; chunk /= 2) {
      for (std::size_t first = 0; first < count() && count() > 1 && budget_ > 0;) {
        std::vector<Vec3d> vertices = (best_.*shape).hull->vertices;
        const std::size_t dropped = std::min({chunk, count() - first, count() - 1});
        const auto begin = vertices.begin() + static_cast<std::ptrdiff_t>(first);
        vertices.erase(begin, begin + static_cast<std::ptrdiff_t>(dropped));
        files::Case candidate = best_;
        candidate.*shape = hull_of(std::move(vertices));
        if (!keep_if_fails(std::move(candidate))) first += chunk;
      }
    }
  }

  // --- kinds of shapes --------------------------------------------------------------------------

  void simplify_shapes() {
    for (Shape files::Case::*shape : {&files::Case::shape_a, &files::Case::shape_b}) {
      const Shape& now = best_.*shape;
      Shape simpler;  // a sphere
      simpler.radius = now.kind == ShapeKind::ellipsoid ? now.radii.maxCoeff() : now.radius;
      const bool round = now.kind == ShapeKind::capsule || now.kind == ShapeKind::cylinder ||
                         now.kind == ShapeKind::cone || now.kind == ShapeKind::ellipsoid;
      if (!round) continue;
      files::Case candidate = best_;
      candidate.*shape = simpler;
      keep_if_fails(std::move(candidate));
    }
  }

  // --- places and rotations ---------------------------------------------------------------------

  // Gives hulls the identity as rotation, and makes their first vertex the local origin.
  void bake_poses() {
    for (const bool first : {true, false}) {
      Shape files::Case::*shape = first ? &files::Case::shape_a : &files::Case::shape_b;
      Pose files::Case::*pose = first ? &files::Case::pose_a : &files::Case::pose_b;
      if ((best_.*shape).kind != ShapeKind::hull) continue;
      const auto try_vertices = [&](const Pose& new_pose, const auto& change) {
        std::vector<Vec3d> vertices = (best_.*shape).hull->vertices;
        for (Vec3d& v : vertices) v = change(v);
        files::Case candidate = best_;
        candidate.*shape = hull_of(std::move(vertices));
        candidate.*pose = new_pose;
        keep_if_fails(std::move(candidate));
      };
      const Pose old = best_.*pose;
      if (old.rotation != Mat3d::Identity()) {
        try_vertices({Mat3d::Identity(), old.translation},
                     [&](const Vec3d& v) { return base::times(old.rotation, v); });
      }
      const Mat3d rotation = (best_.*pose).rotation;
      const Vec3d origin = (best_.*shape).hull->vertices.front();
      if (!origin.isZero(0)) {
        try_vertices({rotation, old.translation + base::times(rotation, origin)},
                     [&](const Vec3d& v) -> Vec3d { return v - origin; });
      }
    }
  }

  // Moves both bodies so that one is at the origin with the identity as rotation: the first one,
  // but preferably a body that is no hull.
  void move_to_origin() {
    std::array<Pose files::Case::*, 2> order = {&files::Case::pose_a, &files::Case::pose_b};
    if (best_.shape_a.kind == ShapeKind::hull && best_.shape_b.kind != ShapeKind::hull) {
      std::swap(order[0], order[1]);
    }
    for (Pose files::Case::*first : order) {
      if (!best_.pose_a.translation.isZero(0) && !best_.pose_b.translation.isZero(0)) {
        files::Case candidate = best_;
        const Vec3d away = (best_.*first).translation;
        candidate.pose_a.translation -= away;
        candidate.pose_b.translation -= away;
        keep_if_fails(std::move(candidate));
      }
      if (best_.pose_a.rotation != Mat3d::Identity() &&
          best_.pose_b.rotation != Mat3d::Identity()) {
        files::Case candidate = best_;
        const Mat3d back = (best_.*first).rotation.transpose();
        for (Pose* pose : {&candidate.pose_a, &candidate.pose_b}) {
          *pose = {base::product(back, pose->rotation), base::times(back, pose->translation)};
        }
        (candidate.*first).rotation = Mat3d::Identity();
        keep_if_fails(std::move(candidate));
      }
    }
  }

  void simplify_rotations() {
    for (Pose files::Case::*pose : {&files::Case::pose_a, &files::Case::pose_b}) {
      if (is_signed_permutation((best_.*pose).rotation)) {
        try_rotation(pose, Mat3d::Identity());
        continue;
      }
      if (try_rotation(pose, Mat3d::Identity())) continue;
      if (try_rotation(pose, nearest_signed_permutation((best_.*pose).rotation))) continue;
      // Quaternions of whole numbers: each step up in size halves the error.
      const std::array<double, 4> q = quaternion_of((best_.*pose).rotation);
      for (double steps = 1; steps <= 1024; steps *= 2) {
        std::array<double, 4> whole;
        std::ranges::transform(q, whole.begin(), [&](double x) { return std::round(x * steps); });
        if (try_rotation(pose, base::rotation_of(whole))) break;
      }
    }
  }

  bool try_rotation(Pose files::Case::*pose, const Mat3d& rotation) {
    // A rotation that was found before is not replaced by a finer one.
    if ((best_.*pose).rotation == rotation) return true;
    files::Case candidate = best_;
    (candidate.*pose).rotation = rotation;
    return keep_if_fails(std::move(candidate));
  }

  static bool is_signed_permutation(const Mat3d& m) {
    return (m.array() == 0 || m.array().abs() == 1).all();
  }

  static Mat3d nearest_signed_permutation(const Mat3d& m) {
    const geometry::SignedPermutation* best = nullptr;
    double greatest = -4;
    for (const geometry::SignedPermutation& turn : geometry::signed_permutations()) {
      const double likeness = (turn.matrix().array() * m.array()).sum();
      if (likeness > greatest) {
        greatest = likeness;
        best = &turn;
      }
    }
    return best->matrix();
  }

  // Scales the quaternion so that its greatest part is 1.
  static std::array<double, 4> quaternion_of(const Mat3d& m) {
    const Eigen::Quaterniond q(m);
    const double greatest = q.coeffs().cwiseAbs().maxCoeff();
    return {q.w() / greatest, q.x() / greatest, q.y() / greatest, q.z() / greatest};
  }

  // --- numbers ----------------------------------------------------------------------------------

  // Replaces each number x by change(place, x). Returns false if nothing changes, or if a
  // half-space would lose its normal.
  template <class Change>
  bool try_numbers(const Change& change) {
    files::Case candidate = best_;
    if (!change_numbers(candidate, change)) return false;
    if (candidate.shape_a.normal.isZero(0) || candidate.shape_b.normal.isZero(0)) return false;
    return keep_if_fails(std::move(candidate));
  }

  void round_all() {
    constexpr std::array<int, 7> few_digits = {1, 2, 3, 4, 6, 9, 13};
    // The first try changes all numbers at once.
    for (const int digits : few_digits) {
      if (try_numbers([&](std::size_t, double x) { return rounded(x, digits); })) break;
    }
    const std::vector<double> values = numbers_of(best_);
    for (std::size_t i = 0; i < values.size() && budget_ > 0; ++i) {
      const double value = values[i];
      const auto try_value = [&](double simpler) {
        return simpler != value &&
               try_numbers([&](std::size_t place, double x) { return place == i ? simpler : x; });
      };
      if (value == 0 || try_value(0) || try_value(value < 0 ? -1 : 1)) continue;
      const int digits_now = digits_of(value);
      for (const int digits : few_digits) {
        if (digits >= digits_now || try_value(rounded(value, digits))) break;
      }
    }
  }

  files::Case best_;
  const FailurePredicate& still_fails_;
  int budget_;
  bool changed_ = false;
};

}  // namespace

files::Case shrink(const files::Case& c, const FailurePredicate& still_fails, int budget) {
  return Shrinker(c, still_fails, budget).run();
}

}  // namespace touchstone::grade
