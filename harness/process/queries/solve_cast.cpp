// Binds a cast to one case and solves its pair.
#include "harness/process/queries/solve_cast.h"

#include <array>
#include <span>

#include "algorithms/pair_query.h"

namespace touchstone::process {

CastOutcome solve_cast(const CastEntry& entry, const CastSettings& settings,
                       const files::CastCase& c) {
  const std::array<Shape, 2> shapes = {c.shape_a, c.shape_b};
  const std::array<Pose, 2> poses = {c.pose_a, c.pose_b};
  const std::array<Motion, 2> motions = {c.motion_a, c.motion_b};
  constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
  const bool swap = needs_swap(shapes[0].kind, shapes[1].kind);
  const std::span<const std::uint32_t> a(&bodies[swap ? 1 : 0], 1);
  const std::span<const std::uint32_t> b(&bodies[swap ? 0 : 1], 1);
  const CastBatch batch = {.kind_a = shapes[a[0]].kind,
                           .kind_b = shapes[b[0]].kind,
                           .pairs = {.first = a, .second = b, .shape_of = bodies, .poses = poses},
                           .motions = motions};
  const std::unique_ptr<Cast> cast = entry.make(settings);
  cast->bind(shapes);
  CastOutcome outcome;
  cast->solve(batch, {&outcome, 1});
  if (swap) outcome.normal = Vec3d::Zero() - outcome.normal;  // 0 - n keeps a zero positive
  return outcome;
}

}  // namespace touchstone::process
