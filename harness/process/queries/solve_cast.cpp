// Binds a cast to one case and solves its pair.
#include "harness/process/queries/solve_cast.h"

#include <algorithm>
#include <vector>

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

}  // namespace touchstone::process
