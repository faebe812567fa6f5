// Binds an algorithm to one case and solves its pair.
#include "harness/process/solve_case.h"

#include <array>
#include <memory>
#include <span>
#include <utility>

namespace touchstone::process {

BoundCase::BoundCase(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                     const files::Case& c)
    : shapes_{c.shape_a, c.shape_b},
      poses_{c.pose_a, c.pose_b},
      query_(entry.make(settings), shapes_) {}

Outcome BoundCase::solve(Task task) {
  return query_.solve_as_batch(
      task, {.shape_a = 0, .pose_a = poses_[0], .shape_b = 1, .pose_b = poses_[1]});
}

Outcome solve_case(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                   const files::Case& c, Task task) {
  return BoundCase(entry, settings, c).solve(task);
}

namespace {

// Turns the manifold of the pair (a, b) into that of (b, a).
Manifold swapped(Manifold manifold) {
  manifold.normal = Vec3d::Zero() - manifold.normal;  // 0 - n keeps a zero positive
  for (ContactPoint& point : manifold.points) std::swap(point.on_a, point.on_b);
  return manifold;
}

}  // namespace

Manifold solve_manifold(const ManifoldEntry& entry, const ManifoldSettings& settings,
                        const files::Case& c) {
  const std::array<Shape, 2> shapes = {c.shape_a, c.shape_b};
  const std::array<Pose, 2> poses = {c.pose_a, c.pose_b};
  constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
  const bool swap = needs_swap(c.shape_a.kind, c.shape_b.kind);
  const std::span<const std::uint32_t> a(&bodies[swap ? 1 : 0], 1);
  const std::span<const std::uint32_t> b(&bodies[swap ? 0 : 1], 1);
  const PairBatch batch = {.kind_a = shapes[a[0]].kind,
                           .kind_b = shapes[b[0]].kind,
                           .pairs = {.first = a, .second = b, .shape_of = bodies, .poses = poses}};
  Manifold manifold;
  const std::unique_ptr<ContactManifold> algorithm = entry.make(settings);
  algorithm->bind(shapes);
  algorithm->solve(batch, {&manifold, 1});
  return swap ? swapped(manifold) : manifold;
}

}  // namespace touchstone::process
