// Exact: rays at scenes as casts of a point, behind the contract of ray casts at scenes.
// Paper:   none; a ray is a point that moves. See cast/exact_cast for what moves exactly.
// Steps:   1. For each triangle and convex part, a power of two times the direction is a displacement
//             that passes it; a point moves by it, and the oracle of casts says when they first touch.
//          2. Times are compared by their brackets.
// Departs: it has no tree, and shares no code with the algorithms that it judges.
// Fails:   spheres, capsules, boxes, hulls and triangles are exact but for the time, which is within 2^-80
//          of the displacement; the others have an enclosure, which for half-spaces
//          often tells nothing. Where a bracket does not tell whether a hit is
//          within t_max, or the oracle of casts does not know, the status is `not_converged`. Normals
//          are not given. Of parts that are hit at one time, the first is reported.
// Cost:    O(n) a ray: a tenth of a millisecond a part.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/cast.h"
#include "algorithms/core/bounds.h"
#include "algorithms/scene_ray_cast.h"

namespace touchstone::entries {
std::vector<CastEntry> oracle_exact_cast();
}  // namespace touchstone::entries

namespace touchstone {
namespace {

class ExactSceneCast final : public SceneRayCast {
 public:
  ExactSceneCast() : cast_(entries::oracle_exact_cast().front().make({})) {}

  void bind(std::span<const SceneBody> bodies) override {
    shapes_.clear();
    parts_.clear();
    within_.clear();
    std::vector<Pose> poses;
    for (std::uint32_t b = 0; b < bodies.size(); ++b) {
      const ConcaveBody& body = bodies[b].body;
      poses.push_back(bodies[b].pose);
      for (std::uint32_t p = 0; p < body.part_count(); ++p) {
        parts_.push_back({b, p});
        shapes_.push_back(body.mesh ? triangle(*body.mesh, p) : body.parts[p].shape);
        within_.push_back(body.mesh ? Pose{} : body.parts[p].pose);
      }
    }
    Shape point;  // a ball without a radius
    shapes_.push_back(point);
    place(poses);
    cast_->bind(shapes_);
  }

  void place(std::span<const Pose> poses) override {
    poses_.resize(parts_.size() + 1);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Pose& body = poses[parts_[i].body];
      const bool same = within_[i].rotation.isIdentity(0) && within_[i].translation.isZero(0);
      poses_[i] =
          same ? body : Pose{body.rotation * within_[i].rotation, body(within_[i].translation)};
    }
  }

  void cast(RayTask, std::span<const Ray> rays, std::span<SceneRayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
  }

 private:
  struct Part {
    std::uint32_t body, part;
  };

  static Shape triangle(const TriangleMesh& mesh, std::uint32_t number) {
    auto hull = std::make_shared<Hull>();
    hull->dimension = 2;
    for (const std::uint32_t v : mesh.triangles[number]) hull->vertices.push_back(mesh.vertices[v]);
    Shape shape;
    shape.kind = ShapeKind::hull;
    shape.hull = std::move(hull);
    return shape;
  }

  // A power of two times the direction that passes every point of the shape's box.
  static double length_past(const Ray& ray, const Shape& shape, const Pose& pose) {
    double reach = 1e-300;
    if (shape.kind == ShapeKind::halfspace) {
      const Vec3d n = (pose.rotation * shape.normal).stableNormalized();
      const Vec3d from = pose.rotation.transpose() * (ray.origin - pose.translation);
      const double slope = std::abs(n.dot(ray.direction));
      const double height =
          std::abs(shape.normal.dot(from) - shape.offset) / shape.normal.stableNorm();
      // Beyond that a plane that the ray nearly runs along is not looked for.
      reach = std::min(height / slope, 1e15 * (1 + height)) * ray.direction.stableNorm();
    } else {
      const Aabb box = tight_box(shape, pose);
      for (std::size_t k = 0; k < 3; ++k) {
        const double at = ray.origin[static_cast<Eigen::Index>(k)];
        reach = std::max({reach, std::abs(static_cast<double>(box.min[k]) - at),
                          std::abs(static_cast<double>(box.max[k]) - at)});
      }
    }
    const double ratio = 4 * reach / ray.direction.cwiseAbs().maxCoeff();
    return std::ldexp(1.0, std::clamp(std::ilogb(ratio) + 1, -900, 900));
  }

  SceneRayHit closest(const Ray& ray) {
    SceneRayHit best;
    const bool proper = ray.origin.allFinite() && ray.direction.allFinite() &&
                        !ray.direction.isZero(0) && !std::isnan(ray.t_max);
    best.status = proper ? Status::ok : Status::degenerate;
    if (!proper || !(ray.t_max >= 0)) return best;
    double best_upper = 0;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const double length = length_past(ray, shapes_[i], poses_[i]);
      CastOutcome outcome = cast_at(ray, length, i);
      if (outcome.answer == CastAnswer::miss) continue;
      if (outcome.answer == CastAnswer::unknown) {
        best.status = Status::not_converged;
        continue;
      }
      const double lower = outcome.lower * length, upper = outcome.upper * length;
      if (lower > ray.t_max) continue;
      if (upper > ray.t_max) {
        best.status = Status::not_converged;
        continue;
      }
      if (best.hit && lower >= best_upper) continue;
      best.hit = true;
      best.body = parts_[i].body;
      best.part = parts_[i].part;
      best.t = outcome.toi * length;
      best_upper = upper;
    }
    return best;
  }

  // The point that the ray moves against a part that rests.
  CastOutcome cast_at(const Ray& ray, double length, std::uint32_t part) {
    const auto point = static_cast<std::uint32_t>(parts_.size());
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
  std::vector<Shape> shapes_;  // of the parts, and the point's
  std::vector<Pose> within_;   // of the parts in their bodies
  std::vector<Pose> poses_;    // of the shapes in the world
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<SceneRayCastEntry> oracle_exact_scene_ray_cast() {
  return {{.info = {.name = "exact",
                    .citation = "Touchstone's oracle: a point that moves, in integers",
                    .origin = Origin::oracle},
           .tasks = {RayTask::closest, RayTask::any},
           .make = [] { return std::make_unique<ExactSceneCast>(); }}};
}

}  // namespace touchstone::entries
