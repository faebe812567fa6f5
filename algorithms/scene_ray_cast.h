// The contract of ray casts at whole scenes: which body a ray meets first, where, and how it is turned
// there. A hit test with the mouse's ray is one such cast. Ray casts of scenes and the harness include
// this.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/outcome.h"
#include "algorithms/ray_cast.h"

namespace touchstone {

// A body at its place.
struct SceneBody {
  ConcaveBody body;  // a convex body is a compound of one part
  Pose pose;
};

struct SceneRayHit {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  bool hit = false;
  Status status = Status::unsupported;
  std::uint32_t body = none;
  std::uint32_t part = none;  // the triangle of a mesh, or the convex part
  double t = Outcome::none;   // in lengths of the direction
  // Unit vector of the surface in the world, towards the ray's origin; NaN if the ray begins in a convex
  // part, where the surface is degenerate, and where `any` of an algorithm does not tell.
  Vec3d normal = Vec3d::Constant(Outcome::none);
};

// Convex parts are solid: a ray that begins in one hits it at t = 0. Meshes are their triangles, as for
// RayCast. Rays are in world coordinates. Of several hits at one t, some one is reported. Improper rays
// are answered as by RayCast.
//
// One instance for each worker, never shared between threads.
class SceneRayCast {
 public:
  virtual ~SceneRayCast() = default;

  // Builds what casts need; may come again, for another scene. Meshes and hulls live until then, or the end.
  virtual void bind(std::span<const SceneBody> bodies) = 0;
  // Moves the bodies to these poses, one for each.
  virtual void place(std::span<const Pose> poses) = 0;

  // Writes the whole of hits[i] for each ray i. Never throws.
  virtual void cast(RayTask task, std::span<const Ray> rays, std::span<SceneRayHit> hits) = 0;
};

struct SceneRayCastEntry {
  AlgorithmInfo info;
  std::vector<RayTask> tasks;
  // Null if it is not built. All is in doubles.
  std::function<std::unique_ptr<SceneRayCast>()> make;
};

}  // namespace touchstone
