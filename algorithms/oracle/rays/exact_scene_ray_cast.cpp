// Exact: rays at scenes in integers, behind the contract of ray casts at scenes.
// Paper:   none. A ray at a convex part is a point that moves: see cast/exact_cast for what moves exactly. A
//          ray at a triangle is one in the plane of three placed points: see ray_triangle.
// Steps:   1. Leave out what the ray passes for certain (box_tree over boxes in the world).
//          2. Of the triangles and half-spaces that are left, compare the fractions at which the ray is first
//             in them.
//          3. For each other convex part that is left, a power of two times the direction is a displacement
//             that passes it; a point moves by it, and the oracle of casts says when they first touch.
//          4. Times of convex parts are brackets. A hit whose bracket is before all others' is the first.
// Departs: it shares no code with the algorithms that it judges.
// Fails:   triangles and half-spaces are exact; spheres, capsules, boxes and hulls are but for the time,
//          which is within 2^-80 of the displacement; the others have an enclosure. Where brackets do not tell
//          which hit is first or whether one is within t_max, or the oracle of casts does not know, the status is
//          `not_converged`; so it is for each ray where the matrix of a half-space has no inverse, and where no
//          double times the direction passes a convex part. Normals are not
//          given. Of parts that are hit at one time, the first is reported. Poses of parts within bodies are
//          multiplied in doubles.
// Cost:    O(log n) a ray where parts are small, some microseconds for each triangle and a tenth of a
//          millisecond for each convex part that may be hit; O(n) memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algorithms/cast.h"
#include "algorithms/core/bounds.h"
#include "algorithms/oracle/rays/box_tree.h"
#include "algorithms/oracle/rays/ray_half_space.h"
#include "algorithms/oracle/rays/ray_triangle.h"
#include "algorithms/oracle/solid.h"
#include "algorithms/scene_ray_cast.h"

namespace touchstone::entries {
std::vector<CastEntry> oracle_exact_cast();
}  // namespace touchstone::entries

namespace touchstone {
namespace {

using Box = oracle::BoxTree::Box;

// The box of a placed triangle, widened by more than all roundings.
Box box_of(const std::array<Vec3d, 3>& triangle, const Pose& pose) {
  Box box{Vec3d::Constant(HUGE_VAL), Vec3d::Constant(-HUGE_VAL)};
  for (const Vec3d& v : triangle) {
    const Vec3d at = pose(v);
    const Vec3d size = pose.rotation.cwiseAbs() * v.cwiseAbs() + pose.translation.cwiseAbs();
    const Vec3d margin = 0x1p-48 * size + Vec3d::Constant(1e-290);
    box.low = box.low.cwiseMin(at - margin);
    box.high = box.high.cwiseMax(at + margin);
  }
  return box;
}

Box box_of(const Shape& shape, const Pose& pose) {
  const Aabb box = tight_box(shape, pose);
  Box wide;
  for (Eigen::Index k = 0; k < 3; ++k) {
    wide.low[k] = box.min[static_cast<std::size_t>(k)];
    wide.high[k] = box.max[static_cast<std::size_t>(k)];
  }
  return wide;
}

// The greatest coordinates of the shape's core, and its radius. Not of a half-space.
Eigen::Vector4d size_of(const Shape& shape) {
  const oracle::Solid solid(shape);
  Vec3d greatest = solid.extents;
  for (const Vec3d& v : solid.vertices) greatest = greatest.cwiseMax(v.cwiseAbs());
  return {greatest.x(), greatest.y(), greatest.z(), solid.radius};
}

class ExactSceneCast final : public SceneRayCast {
 public:
  ExactSceneCast() : cast_(entries::oracle_exact_cast().front().make({})) {}

  void bind(std::span<const SceneBody> bodies) override {
    shapes_.clear();
    within_.clear();
    parts_.clear();
    std::vector<Pose> poses;
    for (std::uint32_t b = 0; b < bodies.size(); ++b) {
      const ConcaveBody& body = bodies[b].body;
      poses.push_back(bodies[b].pose);
      for (std::uint32_t p = 0; p < body.part_count(); ++p) {
        if (body.mesh) {
          parts_.push_back({b, p, 0, body.mesh.get()});
          continue;
        }
        parts_.push_back({b, p, static_cast<std::uint32_t>(shapes_.size()), nullptr});
        shapes_.push_back(body.parts[p].shape);
        within_.push_back(body.parts[p].pose);
      }
    }
    Shape point;  // a ball without a radius
    shapes_.push_back(point);
    sizes_.clear();
    for (const Shape& shape : shapes_) sizes_.push_back(size_of(shape));
    place(poses);
    cast_->bind(shapes_);
  }

  void place(std::span<const Pose> poses) override {
    poses_of_bodies_.assign(poses.begin(), poses.end());
    poses_.resize(shapes_.size());
    unbounded_.clear();
    std::vector<Box> boxes(parts_.size());
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      const Pose& body = poses[part.body];
      if (part.mesh != nullptr) {
        boxes[i] = box_of(corners(part), body);
      } else {
        const Pose& within = within_[part.shape];
        const bool same = within.rotation.isIdentity(0) && within.translation.isZero(0);
        poses_[part.shape] =
            same ? body : Pose{body.rotation * within.rotation, body(within.translation)};
        boxes[i] = box_of(shapes_[part.shape], poses_[part.shape]);
      }
      if (boxes[i].low.allFinite() && boxes[i].high.allFinite()) continue;
      unbounded_.push_back(i);
      boxes[i] = {Vec3d::Zero(), Vec3d::Zero()};
    }
    tree_.build(boxes);
  }

  void cast(RayTask, std::span<const Ray> rays, std::span<SceneRayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
  }

 private:
  struct Part {
    std::uint32_t body, part;
    std::uint32_t shape;       // of a convex part
    const TriangleMesh* mesh;  // null: a convex part
  };

  static std::array<Vec3d, 3> corners(const Part& part) {
    const auto& [a, b, c] = part.mesh->triangles[part.part];
    return {part.mesh->vertices[a], part.mesh->vertices[b], part.mesh->vertices[c]};
  }

  // A power of two that makes the direction, exactly, a displacement past every point of the shape. None if no
  // double is one.
  std::optional<double> length_past(const Ray& ray, std::uint32_t shape) const {
    const Pose& pose = poses_[shape];
    const Vec3d reach = (pose.translation - ray.origin).cwiseAbs() +
                        pose.rotation.cwiseAbs() * sizes_[shape].head<3>();
    const double far = std::max(1e-300, reach.maxCoeff() + sizes_[shape][3]);
    const double ratio = 4 * far / ray.direction.cwiseAbs().maxCoeff();
    if (!std::isfinite(ratio)) return {};
    const double length = std::ldexp(1.0, std::max(std::ilogb(ratio) + 1, -900));
    const Vec3d way = length * ray.direction;
    if (!way.allFinite() || way / length != ray.direction) return {};
    return length;
  }

  SceneRayHit closest(const Ray& ray) {
    SceneRayHit best;
    const bool proper = ray.origin.allFinite() && ray.direction.allFinite() &&
                        !ray.direction.isZero(0) && !std::isnan(ray.t_max);
    best.status = proper ? Status::ok : Status::degenerate;
    if (!proper || !(ray.t_max >= 0)) return best;
    tree_.meet_ray(ray.origin, ray.direction, asked_);
    asked_.insert(asked_.end(), unbounded_.begin(), unbounded_.end());
    std::ranges::sort(asked_);
    asked_.erase(std::ranges::unique(asked_).begin(), asked_.end());
    hits_.clear();
    ask_flat_parts(ray, best.status);
    for (const std::uint32_t i : asked_) {
      if (!is_flat(parts_[i])) ask_convex(ray, i);
    }
    take_first(best);
    return best;
  }

  // A part that the ray is first in at a time of this bracket; or perhaps is, and not before `lower`.
  struct PartHit {
    std::uint32_t part = 0;
    double lower = 0, upper = HUGE_VAL, t = 0;
    bool is_certain = true;

    // At one time the part with the lesser number is first.
    bool is_before(const PartHit& other) const {
      return upper < other.lower || (upper <= other.lower && part < other.part);
    }
  };

  // Takes the hit that is certain and proven to be before all others.
  void take_first(SceneRayHit& best) const {
    const PartHit* first = nullptr;
    for (const PartHit& hit : hits_) {
      if (hit.is_certain && (first == nullptr || hit.t < first->t)) first = &hit;
    }
    const auto is_behind = [&](const PartHit& hit) {
      return first != nullptr && (&hit == first || first->is_before(hit));
    };
    if (!std::ranges::all_of(hits_, is_behind)) best.status = Status::not_converged;
    if (first == nullptr) return;
    best.hit = true;
    best.body = parts_[first->part].body;
    best.part = parts_[first->part].part;
    best.t = first->t;
  }

  bool is_flat(const Part& part) const {
    return part.mesh != nullptr || shapes_[part.shape].kind == ShapeKind::halfspace;
  }

  // The first point in a triangle or a half-space.
  std::optional<oracle::RayPoint> first_point(const Ray& ray, const Part& part,
                                              Status& status) const {
    if (part.mesh != nullptr) {
      return oracle::first_point(ray.origin, ray.direction, corners(part),
                                 poses_of_bodies_[part.body]);
    }
    const oracle::Solid solid(shapes_[part.shape]);
    const oracle::Body body(solid, poses_[part.shape]);
    if (oracle::has_plane(body)) return oracle::first_point_below(ray.origin, ray.direction, body);
    status = Status::not_converged;
    return {};
  }

  void ask_flat_parts(const Ray& ray, Status& status) {
    std::optional<oracle::RayPoint> first;
    PartHit hit;
    for (const std::uint32_t i : asked_) {
      const Part& part = parts_[i];
      if (!is_flat(part)) continue;
      auto point = first_point(ray, part, status);
      if (!point) continue;
      if (std::isfinite(ray.t_max) && compare_t(*point, ray.t_max) > 0) continue;
      if (first && compare_t(*point, *first) >= 0) continue;
      first = std::move(point);
      hit.part = i;
    }
    if (!first) return;
    hit.t = oracle::quotient(first->top, first->bottom);
    const int side = compare_t(*first, hit.t);
    hit.lower = side < 0 ? std::nextafter(hit.t, -HUGE_VAL) : hit.t;
    hit.upper = side > 0 ? std::nextafter(hit.t, HUGE_VAL) : hit.t;
    hits_.push_back(hit);
  }

  void ask_convex(const Ray& ray, std::uint32_t number) {
    const Part& part = parts_[number];
    PartHit hit{number, 0, HUGE_VAL, 0, false};
    const std::optional<double> past = length_past(ray, part.shape);
    if (!past) return hits_.push_back(hit);
    const double length = *past;
    const CastOutcome outcome = cast_at(ray, length, part.shape);
    if (outcome.answer == CastAnswer::miss) return;
    if (outcome.lower > 0) hit.lower = outcome.lower * length;
    if (hit.lower > ray.t_max) return;
    if (outcome.answer == CastAnswer::hit && outcome.upper * length <= ray.t_max) {
      hit.upper = outcome.upper * length;
      hit.t = outcome.toi * length;
      hit.is_certain = true;
    }
    hits_.push_back(hit);
  }

  // The point that the ray moves against a part that rests.
  CastOutcome cast_at(const Ray& ray, double length, std::uint32_t part) {
    const auto point = static_cast<std::uint32_t>(shapes_.size() - 1);
    poses_[point] = {Mat3d::Identity(), ray.origin};
    const std::array<std::uint32_t, 2> shape_of = {point, part};
    const std::array<Pose, 2> poses = {poses_[point], poses_[part]};
    const std::array<Motion, 2> motions = {Motion{length * ray.direction}, Motion{}};
    const bool ordered = shapes_[point].kind <= shapes_[part].kind;
    const std::uint32_t first = ordered ? 0 : 1, second = 1 - first;
    CastOutcome outcome;
    cast_->solve({shapes_[shape_of[first]].kind,
                  shapes_[shape_of[second]].kind,
                  {{&first, 1}, {&second, 1}, shape_of, poses},
                  motions},
                 {&outcome, 1});
    return outcome;
  }

  std::unique_ptr<Cast> cast_;
  std::vector<Part> parts_;
  std::vector<Pose> poses_of_bodies_;
  std::vector<Shape> shapes_;             // of the convex parts, and the point's
  std::vector<Eigen::Vector4d> sizes_;    // of the shapes
  std::vector<Pose> within_;              // of the convex parts in their bodies
  std::vector<Pose> poses_;               // of the shapes in the world
  oracle::BoxTree tree_;                  // over the boxes of the parts
  std::vector<std::uint32_t> unbounded_;  // parts without one
  std::vector<std::uint32_t> asked_;      // of the ray at hand, in the parts' order
  std::vector<PartHit> hits_;             // of the ray at hand
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<SceneRayCastEntry> oracle_exact_scene_ray_cast() {
  return {
      {.info =
           {.name = "exact",
            .citation =
                "Touchstone's oracle: placed triangles, and a point that moves at convex parts, in "
                "integers",
            .origin = Origin::oracle},
       .tasks = {RayTask::closest, RayTask::any},
       .make = [] { return std::make_unique<ExactSceneCast>(); }}};
}

}  // namespace touchstone::entries
