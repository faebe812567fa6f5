// A program outside the harness: it links our own algorithms, without the registry and the peers, and
// with none of the libraries that those need. It returns 0 if the answers are right.
#include <cmath>
#include <cstdio>

#include "algorithms/broad_phase.h"
#include "algorithms/core/bounds.h"
#include "algorithms/hull/convex_hull.h"
#include "algorithms/narrow_phase.h"

namespace touchstone::entries {
std::vector<BroadPhaseEntry> broad_phase_packed_rtree();
std::vector<NarrowPhaseEntry> narrow_phase_gjk();
}  // namespace touchstone::entries

int main() {
  using namespace touchstone;
  // Three octahedra of radius 1. Only the boxes of the first two overlap.
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_hull({Vec3d(1, 0, 0), Vec3d(-1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, -1, 0),
                          Vec3d(0, 0, 1), Vec3d(0, 0, -1)});
  std::vector<Pose> poses(3);
  poses[1].translation = Vec3d(1.5, 1, 0);
  poses[2].translation = Vec3d(9, 0, 0);

  std::vector<Aabb> boxes;
  for (const Pose& pose : poses) boxes.push_back(tight_box(shape, pose));
  Executor executor(1);
  const auto broad_phase = entries::broad_phase_packed_rtree().at(0).make(executor);
  PairSink sink;
  broad_phase->build(boxes);
  const Status status = broad_phase->find_pairs(sink);
  const std::vector<IndexPair> pairs = sink.gather();
  if (status != Status::ok || pairs.size() != 1 || pairs[0].a != 0 || pairs[0].b != 1) {
    std::puts("the broad phase is wrong");
    return 1;
  }

  const auto narrow_phase = entries::narrow_phase_gjk().at(0).make({});
  narrow_phase->bind({&shape, 1});
  const std::vector<std::uint32_t> first = {pairs[0].a}, second = {pairs[0].b};
  const std::vector<std::uint32_t> shape_of(poses.size(), 0);
  Outcome outcome;
  narrow_phase->solve(
      Task::distance,
      {.kind_a = ShapeKind::hull,
       .kind_b = ShapeKind::hull,
       .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = poses}},
      {&outcome, 1});
  // The edges x + y = 1 and x + y = 1.5 in the plane z = 0.
  const double distance = 0.5 / std::sqrt(2.0);
  if (outcome.answer != Answer::separated || std::abs(outcome.distance - distance) > 1e-9) {
    std::printf("the narrow phase is wrong: %.17g\n", outcome.distance);
    return 1;
  }
}
