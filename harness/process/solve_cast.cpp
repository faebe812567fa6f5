// Binds a cast to the shapes of cases and asks for their pairs.
#include "harness/process/solve_cast.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "algorithms/oracle/cast/prove_cast.h"
#include "algorithms/oracle/certificates/cast_certificate_check.h"
#include "algorithms/pair_query.h"

namespace touchstone::process {

void solve_casts(const CastEntry& entry, const CastSettings& settings,
                 std::span<const files::CastCase* const> cases, std::span<CastOutcome> outcomes) {
  std::vector<Shape> shapes;
  std::vector<Pose> poses;
  std::vector<Motion> motions;
  std::vector<std::uint32_t> bodies, first, second;
  for (const files::CastCase* c : cases) {
    const bool swap = needs_swap(c->shape_a.kind, c->shape_b.kind);
    const auto next = static_cast<std::uint32_t>(shapes.size());
    first.push_back(swap ? next + 1 : next);
    second.push_back(swap ? next : next + 1);
    for (const Shape* shape : {&c->shape_a, &c->shape_b}) shapes.push_back(*shape);
    for (const Pose* pose : {&c->pose_a, &c->pose_b}) poses.push_back(*pose);
    for (const Motion* motion : {&c->motion_a, &c->motion_b}) motions.push_back(*motion);
    bodies.insert(bodies.end(), {next, next + 1});
  }
  const CastBatch batch = {
      .kind_a = shapes[first[0]].kind,
      .kind_b = shapes[second[0]].kind,
      .pairs = {.first = first, .second = second, .shape_of = bodies, .poses = poses},
      .motions = motions};
  const std::unique_ptr<Cast> cast = entry.make(settings);
  cast->bind(shapes);
  std::ranges::fill(outcomes, CastOutcome{});
  cast->solve(batch, outcomes);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (first[i] < second[i]) continue;
    outcomes[i].normal = Vec3d::Zero() - outcomes[i].normal;  // 0 - n keeps a zero positive
  }
}

CastOutcome solve_cast(const CastEntry& entry, const CastSettings& settings,
                       const files::CastCase& c) {
  CastOutcome outcome;
  const files::CastCase* const one = &c;
  solve_casts(entry, settings, {&one, 1}, {&outcome, 1});
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
