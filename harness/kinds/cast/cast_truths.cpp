// Asks the oracle.
#include "harness/kinds/cast/cast_kind.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "algorithms/core/bounds.h"
#include "algorithms/oracle/solid.h"
#include "algorithms/registry.h"
#include "harness/families/grid_touches.h"
#include "harness/families/moving_pairs.h"
#include "harness/process/solve_cast.h"

namespace touchstone::kinds {
namespace {

using files::CastCase;

double reach_from(const CastCase& c, const Vec3d& origin) {
  double reach = std::numeric_limits<double>::min();
  const auto add = [&](const Shape& shape, const Pose& pose, const Motion& motion) {
    reach = std::max({reach, double{loose_reach(shape, pose.rotation)} +
                                 (pose.translation - origin).cwiseAbs().maxCoeff() +
                                 motion.displacement.cwiseAbs().maxCoeff()});
  };
  add(c.shape_a, c.pose_a, c.motion_a);
  add(c.shape_b, c.pose_b, c.motion_b);
  return reach;
}

}  // namespace

double span_of_motion(const CastCase& c) { return reach_from(c, c.pose_a.translation); }

CastTruths::CastTruths(std::span<const CastCase> cases)
    : cases_(cases), exact_(cases.size()), least_(cases.size()) {
  for (const CastCase& c : cases) reaches_.push_back(reach_from(c, Vec3d::Zero()));
}

double CastTruths::path(std::size_t i) const {
  const CastCase& c = cases_[i];
  return (c.motion_b.displacement - c.motion_a.displacement).norm() +
         reaches_[i] * (c.motion_a.rotation_vector.norm() + c.motion_b.rotation_vector.norm());
}

const CastOutcome& CastTruths::of(std::size_t i) {
  if (!exact_[i])
    exact_[i] = process::solve_cast(*registry::find<CastEntry>("exact"), {}, cases_[i]);
  return *exact_[i];
}

oracle::Measure CastTruths::measure_at(std::size_t i, double time) {
  const CastCase& c = cases_[i];
  const oracle::Solid a(c.shape_a), b(c.shape_b);
  return oracle_.measure({a, families::pose_at(c.pose_a, c.motion_a, time)},
                         {b, families::pose_at(c.pose_b, c.motion_b, time)});
}

// The bodies get no deeper along the best fixed direction than one gets into what the other sweeps. Of
// kinds that sweep no shape, a depth that they have at some time is known.
CastTruths::Depth CastTruths::depth_on_the_way(std::size_t i, double tolerance) {
  constexpr int looks = 8;
  const auto is_deep = [&](double time) {
    return -measure_at(i, time).upper > 1.01 * tolerance + 1e-15 * reaches_[i];
  };
  if (is_deep(0)) return Depth::some;
  const CastCase& c = cases_[i];
  const Vec3d way = c.motion_b.displacement - c.motion_a.displacement;
  if (!least_[i]) {
    const auto of_b = families::swept(c.shape_b, c.pose_b, way);
    const auto of_a = of_b ? std::nullopt : families::swept(c.shape_a, c.pose_a, -way);
    if (of_b || of_a) {
      const oracle::Solid a(of_a ? of_a->shape : c.shape_a), b(of_b ? of_b->shape : c.shape_b);
      least_[i] =
          oracle_.measure({a, of_a ? of_a->pose : c.pose_a}, {b, of_b ? of_b->pose : c.pose_b});
    }
  }
  if (least_[i]) {
    // The start and the path between the bodies are as they are given.
    const double doubt = 0.01 * tolerance + 1e-15 * span_of_motion(c);
    if (-least_[i]->upper > tolerance + doubt) return Depth::some;
    return -least_[i]->lower < tolerance - doubt ? Depth::none : Depth::unknown;
  }
  for (int look = 1; look <= looks; ++look) {
    if (is_deep(1.0 * look / looks)) return Depth::some;
  }
  return Depth::unknown;
}

CastOutcome CastTruths::of_approach(std::size_t i, double tolerance) {
  CastOutcome exact = of(i);
  // Bodies that are apart by more than the tolerance do not begin in contact.
  if (exact.answer != CastAnswer::hit || is_apart(i, 0, tolerance)) return exact;
  switch (depth_on_the_way(i, tolerance)) {
    case Depth::some: return exact;
    case Depth::unknown: exact.answer = CastAnswer::unknown; return exact;
    case Depth::none: break;
  }
  // What is no contact at the start may be one later, however shallow.
  if (exact.lower > 0) {
    exact.answer = CastAnswer::unknown;
    return exact;
  }
  return {.answer = CastAnswer::miss, .status = Status::ok};
}

bool CastTruths::is_apart(std::size_t i, double time, double tolerance) {
  if (!(time >= 0 && time <= 1)) return true;
  const CastCase& c = cases_[i];
  const double turns = 1 + c.motion_a.rotation_vector.norm() + c.motion_b.rotation_vector.norm();
  return measure_at(i, time).lower > 1.01 * tolerance + 1e-15 * turns * reaches_[i];
}

}  // namespace touchstone::kinds
