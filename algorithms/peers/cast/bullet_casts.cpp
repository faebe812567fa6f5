// Bullet: its three convex casts.
// Paper:   van den Bergen, "Ray casting against general convex objects with application to continuous
//          collision detection", 2004 (bullet-subsimplex-cast, bullet-gjk-cast); conservative advancement:
//          Mirtich 1996 (bullet-continuous-cast). The library is Bullet 3.24.
// Departs: poses are relative to body a's origin at the start, subtracted in double before the
//          conversion to Bullet's scalars. Shapes have no margin beyond their surface, as in Bullet's narrow
//          phases here (bullet_bodies.h); with its default of 0.04 boxes and hulls would be rounded. Hulls
//          keep the body's origin, about which they turn. Bullet caps a turn at 45 degrees, so that
//          motions of bullet-continuous-cast are cut into parts below that; the other two know no
//          rotation. tolerance: bullet-subsimplex-cast stops at its square, as Bullet compares
//          a squared length; its default is 1e-4, that is 1 cm. The others end within a fixed millimetre.
// Fails:   all compute in float. bullet-gjk-cast misses about half of the hits of boxes and hulls.
//          bullet-subsimplex-cast reports contact from 1 cm on. None sees bodies that overlap at the
//          start: subsimplex never, continuous about half. Bullet reports no failure.
// Cost:    GJK steps; bullet-continuous-cast runs a whole GJK, and EPA, a step.
#include "algorithms/cast.h"

#include "algorithms/peers/not_built.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {
namespace {

std::unique_ptr<btConvexShape> make_cast_shape(const Shape& shape) {
  if (shape.kind != ShapeKind::hull) return std::move(make_body(shape).shape);
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3d& v : shape.hull->vertices) hull->addPoint(to_bullet(v), false);
  hull->setMargin(0);
  hull->recalcLocalAabb();
  return hull;
}

btTransform transform_at(const Pose& pose, const Motion& motion, const Vec3d& origin, double time) {
  const double angle = motion.rotation_vector.norm();
  Mat3d rotation = pose.rotation;
  if (angle > 0) {
    const Eigen::AngleAxisd turn(time * angle, motion.rotation_vector / angle);
    rotation = turn.toRotationMatrix() * pose.rotation;
  }
  const Vec3d offset = (pose.translation - origin) + time * motion.displacement;
  return btTransform(to_matrix(rotation), to_bullet(offset));
}

struct Subsimplex {
  btVoronoiSimplexSolver simplex;
  btSubsimplexConvexCast cast;
  Subsimplex(const btConvexShape* a, const btConvexShape* b) : cast(a, b, &simplex) {}
};
struct Gjk {
  btVoronoiSimplexSolver simplex;
  btGjkConvexCast cast;
  Gjk(const btConvexShape* a, const btConvexShape* b) : cast(a, b, &simplex) {}
};
struct Continuous {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btContinuousConvexCollision cast;
  Continuous(const btConvexShape* a, const btConvexShape* b) : cast(a, b, &simplex, &depth) {}
};

template <class Algorithm>
class BulletCast final : public Cast {
 public:
  explicit BulletCast(const CastSettings& settings) : settings_(settings) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_.clear();
    for (const Shape& shape : shapes) shapes_.push_back(make_cast_shape(shape));
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      outcomes[i] = {};
      Algorithm algorithm(shapes_[pairs.shape_of[a]].get(), shapes_[pairs.shape_of[b]].get());
      cast(algorithm.cast, pairs.poses[a], batch.motions[a], pairs.poses[b], batch.motions[b],
           outcomes[i]);
    }
  }

 private:
  void cast(btConvexCast& algorithm, const Pose& pose_a, const Motion& motion_a, const Pose& pose_b,
            const Motion& motion_b, CastOutcome& outcome) const {
    constexpr double most_turn = 43 * std::numbers::pi / 180;
    const double turn = std::max(motion_a.rotation_vector.norm(), motion_b.rotation_vector.norm());
    const int parts = std::max(1, static_cast<int>(std::ceil(turn / most_turn)));
    const Vec3d& origin = pose_a.translation;
    outcome.answer = CastAnswer::miss;
    outcome.status = Status::not_reported;
    for (int k = 0; k < parts; ++k) {
      const double begin = static_cast<double>(k) / parts, end = (k + 1.0) / parts;
      btConvexCast::CastResult result;
      if (settings_.tolerance) {
        result.m_subSimplexCastEpsilon =
            static_cast<btScalar>(*settings_.tolerance * *settings_.tolerance);
      }
      const bool hit =
          algorithm.calcTimeOfImpact(transform_at(pose_a, motion_a, origin, begin),
                                     transform_at(pose_a, motion_a, origin, end),
                                     transform_at(pose_b, motion_b, origin, begin),
                                     transform_at(pose_b, motion_b, origin, end), result);
      const double fraction = result.m_fraction;
      if (!hit || !(fraction >= 0 && fraction <= 1)) continue;
      outcome.answer = CastAnswer::hit;
      outcome.toi = begin + fraction * (end - begin);
      const Vec3d normal = -from_bullet(result.m_normal);
      if (normal.norm() > 0.5) outcome.normal = normal;
      outcome.point = origin + from_bullet(result.m_hitPoint);
      return;
    }
  }

  CastSettings settings_;
  std::vector<std::unique_ptr<btConvexShape>> shapes_;
};

template <class Algorithm>
std::unique_ptr<Cast> make_cast(const CastSettings& settings) {
  return std::make_unique<BulletCast<Algorithm>>(settings);
}
constexpr auto make_subsimplex = make_cast<Subsimplex>;
constexpr auto make_gjk = make_cast<Gjk>;
constexpr auto make_continuous = make_cast<Continuous>;

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {

std::vector<CastEntry> peers_bullet_casts() {
  const auto bounded = [](ShapeKind, ShapeKind kind_b, bool) {
    return kind_b != ShapeKind::halfspace;
  };
  return {{.info = {.name = "bullet-subsimplex-cast",
                    .citation = "Bullet 3.24, btSubsimplexConvexCast",
                    .origin = Origin::peer,
                    .known_defect =
                        "reports contact from 1 cm on, and misses bodies that begin in contact"},
           .scalars = {Precision::float32},
           .default_tolerance = 1e-2,
           .supports = bounded,
           .make = bullet::make_subsimplex},
          {.info = {.name = "bullet-gjk-cast",
                    .citation = "Bullet 3.24, btGjkConvexCast",
                    .origin = Origin::peer,
                    .known_defect = "misses about half of the hits of boxes and hulls"},
           .scalars = {Precision::float32},
           .fixed_tolerance = 1e-3,
           .supports = bounded,
           .make = bullet::make_gjk},
          {.info = {.name = "bullet-continuous-cast",
                    .citation = "Bullet 3.24, btContinuousConvexCollision, with "
                                "btGjkEpaPenetrationDepthSolver",
                    .origin = Origin::peer,
                    .known_defect = "misses about half of the bodies that begin in contact"},
           .scalars = {Precision::float32},
           .rotation = true,
           .fixed_tolerance = 1e-3,
           .supports = bounded,
           .make = bullet::make_continuous}};
}

}  // namespace touchstone::entries
