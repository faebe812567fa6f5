// FCL: continuous collision by conservative advancement, and by trying evenly spaced times.
// Paper:   Pan, Chitta, Manocha, "FCL: A general purpose library for collision and proximity queries",
//          ICRA 2012; the library is FCL 0.7.
// Departs: the adapter calls fcl::continuousCollide with motions that it makes itself, by the one
//          constructor of InterpMotion that sets both the velocities and the reference point: the one
//          that FCL makes for CCDM_LINEAR leaves the point unset, and its answers change from run to run.
//          Motions know their end poses only, so that turns are cut into parts of at most 166 degrees.
//          fcl-naive: max_iterations is the number of times that are tried, 10 by default as in FCL's
//          request. Casts get the bodies' poses as they are given.
// Fails:   fcl-advancement ignores the request: steps of time below 1e-5 end it, and contact at the very
//          end is a miss, also on polytopes that overlap at the start, up to a seventh. It has no cap on its
//          steps. fcl-naive passes through whatever is thinner than a step. FCL reports no failure.
// Cost:    a distance of FCL's libccd a step; a collision a time.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "algorithms/cast.h"

#ifdef TOUCHSTONE_HAS_FCL
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include "algorithms/peers/fcl_shapes.h"

namespace touchstone {
namespace {

Pose pose_after(const Pose& pose, const Motion& motion, double time) {
  Pose at = pose;
  const double angle = motion.rotation_vector.norm();
  if (angle > 0) {
    const Eigen::AngleAxisd turn(time * angle, motion.rotation_vector / angle);
    at.rotation = turn.toRotationMatrix() * pose.rotation;
  }
  at.translation += time * motion.displacement;
  return at;
}

class FclCast final : public Cast {
 public:
  FclCast(fcl::CCDSolverType solver, const CastSettings& settings) {
    request_.ccd_solver_type = solver;
    request_.gjk_solver_type = fcl::GST_LIBCCD;
    if (settings.max_iterations) {
      // The naive solver also tries no more times than one over the error.
      request_.num_max_iterations = static_cast<std::size_t>(std::max(2, *settings.max_iterations));
      request_.toc_err = 1.0 / static_cast<double>(request_.num_max_iterations);
    }
  }

  void bind(std::span<const Shape> shapes) override {
    shapes_.clear();
    for (const Shape& shape : shapes) {
      shapes_.push_back(fcl_shapes::make_fcl_shape<double>(shape));
      shapes_.back()->computeLocalAABB();
    }
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      outcomes[i] = {};
      cast(*shapes_[pairs.shape_of[a]], pairs.poses[a], batch.motions[a],
           *shapes_[pairs.shape_of[b]], pairs.poses[b], batch.motions[b], outcomes[i]);
    }
  }

 private:
  static fcl::InterpMotion<double> part(const Pose& pose, const Motion& motion, double begin,
                                        double end) {
    const Pose from = pose_after(pose, motion, begin), to = pose_after(pose, motion, end);
    return {from.rotation, from.translation, to.rotation, to.translation, Vec3d(Vec3d::Zero())};
  }

  void cast(const fcl::ShapeBase<double>& a, const Pose& pose_a, const Motion& motion_a,
            const fcl::ShapeBase<double>& b, const Pose& pose_b, const Motion& motion_b,
            CastOutcome& outcome) const {
    constexpr double most_turn = 166 * std::numbers::pi / 180;
    const double turn = std::max(motion_a.rotation_vector.norm(), motion_b.rotation_vector.norm());
    const int parts = std::max(1, static_cast<int>(std::ceil(turn / most_turn)));
    outcome.answer = CastAnswer::miss;
    outcome.status = Status::not_reported;
    for (int k = 0; k < parts; ++k) {
      const double begin = static_cast<double>(k) / parts, end = (k + 1.0) / parts;
      const auto of_a = part(pose_a, motion_a, begin, end);
      const auto of_b = part(pose_b, motion_b, begin, end);
      fcl::ContinuousCollisionResult<double> result;
      fcl::continuousCollide<double>(&a, &of_a, &b, &of_b, request_, result);
      if (!result.is_collide) continue;
      outcome.answer = CastAnswer::hit;
      outcome.toi = begin + result.time_of_contact * (end - begin);
      return;
    }
  }

  fcl::ContinuousCollisionRequest<double> request_;
  std::vector<std::unique_ptr<fcl::ShapeBase<double>>> shapes_;
};

template <fcl::CCDSolverType solver>
std::unique_ptr<Cast> make_fcl_cast(const CastSettings& settings) {
  return std::make_unique<FclCast>(solver, settings);
}
constexpr auto make_advancement = make_fcl_cast<fcl::CCDC_CONSERVATIVE_ADVANCEMENT>;
constexpr auto make_naive_cast = make_fcl_cast<fcl::CCDC_NAIVE>;

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<CastEntry> peers_fcl_casts() {
  // FCL has no advancement of ellipsoids, and no distance to half-spaces.
  const auto supports = [](ShapeKind kind_a, ShapeKind kind_b, bool) {
    return kind_a != ShapeKind::ellipsoid && kind_b != ShapeKind::ellipsoid &&
           kind_b != ShapeKind::halfspace;
  };
  return {
      {.info = {.name = "fcl-advancement",
                .citation =
                    "FCL 0.7, continuousCollide, CCDC_CONSERVATIVE_ADVANCEMENT, with InterpMotion",
                .origin = Origin::peer,
                .known_defect =
                    "misses contacts at the end, and some of polytopes and at the start"},
       .scalars = {Precision::float64},
       .rotation = true,
       .fixed_share_of_path = 1e-4,
       .supports = supports,
       .make = make_advancement},
      {.info = {.name = "fcl-naive",
                .citation = "FCL 0.7, continuousCollide, CCDC_NAIVE, with InterpMotion",
                .origin = Origin::peer,
                .known_defect = "tries ten times, and misses contacts between them"},
       .scalars = {Precision::float64},
       .rotation = true,
       .fixed_share_of_path = 1e-4,
       .supports = supports,
       .make = make_naive_cast}};
}

}  // namespace touchstone::entries
