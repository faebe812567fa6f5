// Both sides of the boundary mean the same bytes: what is ours is handed over as the module's.
#pragma once

#include <bit>
#include <cstddef>
#include <type_traits>

#include "algorithms/broad_phase.h"
#include "algorithms/cast.h"
#include "algorithms/ccd.h"
#include "algorithms/concave_phase.h"
#include "algorithms/module/touchstone_module.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/point_query.h"
#include "algorithms/ray_cast.h"

namespace touchstone::modules {

static_assert(std::endian::native ==
              std::endian::little);  // expect_known reads two bytes as one number

#define TOUCHSTONE_SAME_PLACE(Ours, ours, Theirs, theirs) \
  static_assert(offsetof(Ours, ours) == offsetof(Theirs, theirs))
#define TOUCHSTONE_SAME_SIZE(Ours, Theirs) \
  static_assert(sizeof(Ours) == sizeof(Theirs) && alignof(Ours) == alignof(Theirs))

TOUCHSTONE_SAME_SIZE(Aabb, TouchstoneModuleBox);
TOUCHSTONE_SAME_PLACE(Aabb, max, TouchstoneModuleBox, max);
TOUCHSTONE_SAME_SIZE(IndexPair, TouchstoneModulePair);
TOUCHSTONE_SAME_SIZE(Vec3d, double[3]);
TOUCHSTONE_SAME_SIZE(Pose, TouchstoneModulePose);
TOUCHSTONE_SAME_PLACE(Pose, translation, TouchstoneModulePose, translation);
static_assert(!Mat3d::IsRowMajor);
TOUCHSTONE_SAME_SIZE(Outcome, TouchstoneModuleOutcome);
TOUCHSTONE_SAME_PLACE(Outcome, status, TouchstoneModuleOutcome, status);
TOUCHSTONE_SAME_PLACE(Outcome, distance, TouchstoneModuleOutcome, distance);
TOUCHSTONE_SAME_PLACE(Outcome, upper, TouchstoneModuleOutcome, upper);
TOUCHSTONE_SAME_PLACE(Outcome, normal, TouchstoneModuleOutcome, normal);
TOUCHSTONE_SAME_PLACE(Outcome, witness_b, TouchstoneModuleOutcome, witness_b);
TOUCHSTONE_SAME_PLACE(Outcome, support_calls, TouchstoneModuleOutcome, support_calls);
static_assert(static_cast<int>(Answer::unknown) == TOUCHSTONE_MODULE_UNKNOWN);
static_assert(static_cast<int>(Status::not_reported) == TOUCHSTONE_MODULE_NOT_REPORTED);
static_assert(static_cast<int>(ShapeKind::halfspace) == TOUCHSTONE_MODULE_HALFSPACE);
static_assert(1 << static_cast<int>(Task::signed_distance) == TOUCHSTONE_MODULE_SIGNED);
TOUCHSTONE_SAME_SIZE(Ray, TouchstoneModuleRay);
TOUCHSTONE_SAME_PLACE(Ray, t_max, TouchstoneModuleRay, t_max);
TOUCHSTONE_SAME_SIZE(RayHit, TouchstoneModuleHit);
TOUCHSTONE_SAME_PLACE(RayHit, status, TouchstoneModuleHit, status);
TOUCHSTONE_SAME_PLACE(RayHit, triangle, TouchstoneModuleHit, triangle);
TOUCHSTONE_SAME_PLACE(RayHit, v, TouchstoneModuleHit, v);
static_assert(1 << static_cast<int>(RayTask::any) == TOUCHSTONE_MODULE_ANY_HIT);
TOUCHSTONE_SAME_SIZE(PointAnswer, TouchstoneModulePointAnswer);
TOUCHSTONE_SAME_PLACE(PointAnswer, side, TouchstoneModulePointAnswer, side);
TOUCHSTONE_SAME_PLACE(PointAnswer, triangle, TouchstoneModulePointAnswer, triangle);
TOUCHSTONE_SAME_PLACE(PointAnswer, closest, TouchstoneModulePointAnswer, closest);
static_assert(static_cast<int>(PointSide::unknown) == TOUCHSTONE_MODULE_SIDE_UNKNOWN);
static_assert(1 << static_cast<int>(PointTask::side) == TOUCHSTONE_MODULE_SIDE);
static_assert(1 << static_cast<int>(ConcaveTask::contacts) == TOUCHSTONE_MODULE_MESH_CONTACTS);
static_assert(sizeof(std::array<std::uint32_t, 3>) == 3 * sizeof(std::uint32_t));
TOUCHSTONE_SAME_SIZE(Motion, TouchstoneModuleMotion);
TOUCHSTONE_SAME_PLACE(Motion, rotation_vector, TouchstoneModuleMotion, rotation_vector);
TOUCHSTONE_SAME_SIZE(CastOutcome, TouchstoneModuleCastOutcome);
TOUCHSTONE_SAME_PLACE(CastOutcome, status, TouchstoneModuleCastOutcome, status);
TOUCHSTONE_SAME_PLACE(CastOutcome, toi, TouchstoneModuleCastOutcome, toi);
TOUCHSTONE_SAME_PLACE(CastOutcome, point, TouchstoneModuleCastOutcome, point);
TOUCHSTONE_SAME_PLACE(CastOutcome, iterations, TouchstoneModuleCastOutcome, iterations);
static_assert(static_cast<int>(CastAnswer::unknown) == TOUCHSTONE_MODULE_CAST_UNKNOWN);
TOUCHSTONE_SAME_SIZE(CcdQuery, TouchstoneModuleFeatures);
TOUCHSTONE_SAME_PLACE(CcdQuery, end, TouchstoneModuleFeatures, end);
TOUCHSTONE_SAME_SIZE(CcdOutcome, TouchstoneModuleFeatureOutcome);
TOUCHSTONE_SAME_PLACE(CcdOutcome, status, TouchstoneModuleFeatureOutcome, status);
TOUCHSTONE_SAME_PLACE(CcdOutcome, toi, TouchstoneModuleFeatureOutcome, toi);
TOUCHSTONE_SAME_PLACE(CcdOutcome, iterations, TouchstoneModuleFeatureOutcome, iterations);
static_assert(static_cast<int>(CcdAnswer::unknown) == TOUCHSTONE_MODULE_CAST_UNKNOWN);
static_assert(static_cast<int>(FeaturePair::edge_edge) == TOUCHSTONE_MODULE_EDGE_EDGE);

#undef TOUCHSTONE_SAME_PLACE
#undef TOUCHSTONE_SAME_SIZE

// What is ours, as the module's.
inline const TouchstoneModuleBox* theirs(const Aabb* boxes) {
  return reinterpret_cast<const TouchstoneModuleBox*>(boxes);
}
inline TouchstoneModulePair* theirs(IndexPair* pairs) {
  return reinterpret_cast<TouchstoneModulePair*>(pairs);
}
inline const TouchstoneModulePose* theirs(const Pose* poses) {
  return reinterpret_cast<const TouchstoneModulePose*>(poses);
}
inline TouchstoneModuleOutcome* theirs(Outcome* outcomes) {
  return reinterpret_cast<TouchstoneModuleOutcome*>(outcomes);
}
inline const TouchstoneModuleRay* theirs(const Ray* rays) {
  return reinterpret_cast<const TouchstoneModuleRay*>(rays);
}
inline TouchstoneModuleHit* theirs(RayHit* hits) {
  return reinterpret_cast<TouchstoneModuleHit*>(hits);
}
inline TouchstoneModulePointAnswer* theirs(PointAnswer* answers) {
  return reinterpret_cast<TouchstoneModulePointAnswer*>(answers);
}
inline const TouchstoneModuleMotion* theirs(const Motion* motions) {
  return reinterpret_cast<const TouchstoneModuleMotion*>(motions);
}
inline TouchstoneModuleCastOutcome* theirs(CastOutcome* outcomes) {
  return reinterpret_cast<TouchstoneModuleCastOutcome*>(outcomes);
}
inline const TouchstoneModuleFeatures* theirs(const CcdQuery* queries) {
  return reinterpret_cast<const TouchstoneModuleFeatures*>(queries);
}
inline TouchstoneModuleFeatureOutcome* theirs(CcdOutcome* outcomes) {
  return reinterpret_cast<TouchstoneModuleFeatureOutcome*>(outcomes);
}

}  // namespace touchstone::modules
