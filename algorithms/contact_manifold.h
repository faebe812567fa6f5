// The contract of contact manifolds: the few points that represent the area in which two convex
// bodies touch, as a physics engine's solver uses them. Manifold algorithms and the harness include
// this.
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

// A point of the contact area on both bodies: on_a is a point of a, on_b a point of b (world,
// metres), and on_a - on_b is depth * normal. A negative depth means that the bodies do not touch
// there yet; peers report such points within margins of their own, ours never do.
struct ContactPoint {
  Vec3d on_a = Vec3d::Constant(Outcome::none);
  Vec3d on_b = Vec3d::Constant(Outcome::none);
  double depth = Outcome::none;
  // The number of the faces and edges that meet here: equal in two frames for the same ones, so
  // that a solver can start from its last impulse, and different within a manifold. 0 if unknown.
  std::uint64_t feature = 0;
};

// Up to four points. Those kept of a larger area are its deepest, and others that span a large
// area with it.
struct Manifold {
  static constexpr int most_points = 4;

  Answer answer = Answer::unknown;
  Status status = Status::unsupported;
  // Unit vector from a to b in the world: moving b by the greatest depth along it separates the
  // bodies.
  Vec3d normal = Vec3d::Constant(Outcome::none);
  int count = 0;  // number of points; none if separated
  std::array<ContactPoint, most_points> points{};

  std::span<const ContactPoint> contacts() const {
    return {points.data(), static_cast<std::size_t>(count)};
  }
};

struct ManifoldSettings {
  Precision scalar = Precision::float64;
};

// One instance for each worker, never shared between threads.
class ContactManifold {
 public:
  virtual ~ContactManifold() = default;

  // Prepares the shapes, as NarrowPhase::bind does; may come again as that may.
  virtual void bind(std::span<const Shape> shapes) = 0;

  // Writes the whole of manifolds[i] for each pair i. The batch is that of a narrow phase. Bodies
  // that overlap have at least one point. If rounding hides whether they do, the answer is unknown,
  // and there may be points of zero depth. Never throws on finite input.
  virtual void solve(const PairBatch& batch, std::span<Manifold> manifolds) = 0;
};

struct ManifoldEntry {
  AlgorithmInfo info;
  std::vector<Precision> scalars;
  // True for the kinds of pairs that it supports, kind_a <= kind_b; solve never gets others.
  bool (*supports)(ShapeKind kind_a, ShapeKind kind_b) = nullptr;
  // Null if it is not built.
  std::function<std::unique_ptr<ContactManifold>(const ManifoldSettings&)> make;
};

}  // namespace touchstone
