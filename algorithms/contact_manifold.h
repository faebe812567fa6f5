// The contract of contact manifolds: the few points that stand for the area in which two convex
// bodies touch, as a physics engine's solver takes them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {

// A point of the contact area, seen on either body: on_a is a point of a, on_b a point of b (world,
// metres), and on_a - on_b is depth * normal. A negative depth is that of a place where the bodies
// do not touch yet; peers report such places within margins of their own, ours never do.
struct ContactPoint {
  Vec3d on_a = Vec3d::Constant(Outcome::none);
  Vec3d on_b = Vec3d::Constant(Outcome::none);
  double depth = Outcome::none;
  // Of the same faces and edges in two frames the same, so that a solver may start from its last
  // impulse there; different within a manifold. 0: not known.
  std::uint64_t feature = 0;
};

// At most four points: those that are kept of a larger area are its deepest, and such others that
// the area between them is large.
struct Manifold {
  static constexpr int most_points = 4;

  Answer answer = Answer::unknown;
  Status status = Status::unsupported;
  // Unit vector from a to b in the world: moving b by the greatest depth along it separates the
  // bodies.
  Vec3d normal = Vec3d::Constant(Outcome::none);
  int count = 0;  // of points; none where the bodies are apart
  std::array<ContactPoint, most_points> points{};

  std::span<const ContactPoint> contacts() const {
    return {points.data(), static_cast<std::size_t>(count)};
  }
};

struct ManifoldSettings {
  Precision scalar = Precision::float64;
};

// One instance a worker, never shared between threads.
class ContactManifold {
 public:
  virtual ~ContactManifold() = default;

  // As of NarrowPhase.
  virtual void bind(std::span<const Shape> shapes) = 0;

  // Answers pair i into manifolds[i], all of it. The batch is as the narrow phase's, its task is
  // not read. Bodies that overlap have one point at least; where rounding hides whether they do the
  // answer is unknown, and there may be points of no depth. Never throws on finite input.
  virtual void solve(const PairBatch& batch, std::span<Manifold> manifolds) = 0;
};

struct ManifoldEntry {
  AlgorithmInfo info;
  std::vector<Precision> scalars;
  // Which pairs it takes, kind_a <= kind_b. A pair that is not taken is never given to solve.
  bool (*supports)(ShapeKind kind_a, ShapeKind kind_b) = nullptr;
  // Null where it is not built.
  std::function<std::unique_ptr<ContactManifold>(const ManifoldSettings&)> make;
};

}  // namespace touchstone
