// Binds a cast to one case and solves its pair.
#include "harness/process/queries/solve_cast.h"

#include <array>
#include <span>
#include <utility>

#include "algorithms/oracle/cast/prove_cast.h"
#include "algorithms/oracle/certificates/cast_certificate_check.h"
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

files::StoredCastCertificate prove_cast(const files::CastCase& c, std::optional<double> tolerance) {
  // A half-space is the second body of a pair.
  const bool swap = needs_swap(c.shape_a.kind, c.shape_b.kind);
  files::StoredCastCertificate stored{c, {}};
  files::CastCase& of = stored.of;
  if (swap) {
    std::swap(of.shape_a, of.shape_b);
    std::swap(of.pose_a, of.pose_b);
    std::swap(of.motion_a, of.motion_b);
  }
  const oracle::Solid solid_a(of.shape_a), solid_b(of.shape_b);
  const oracle::EnclosedBody a = enclosed(of.shape_a, solid_a, of.pose_a, of.motion_a);
  const oracle::EnclosedBody b = enclosed(of.shape_b, solid_b, of.pose_b, of.motion_b);
  oracle::Oracle oracle;
  oracle::prove_cast(oracle, a, b, tolerance.value_or(oracle::default_tolerance(a, b)),
                     stored.certificate);
  return stored;
}

std::string fault_of(const files::StoredCastCertificate& stored) {
  const files::CastCase& of = stored.of;
  const oracle::Solid a(of.shape_a), b(of.shape_b);
  return oracle::fault(stored.certificate, {{a, of.pose_a}, of.motion_a},
                       {{b, of.pose_b}, of.motion_b});
}

}  // namespace touchstone::process
