// The contract of ray casts: where rays meet a triangle mesh. Ray casts and the harness include
// this.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/outcome.h"

namespace touchstone {

// The points origin + t * direction with 0 <= t <= t_max, both ends included. t is in lengths of
// the direction, which need not be 1.
struct Ray {
  Vec3d origin = Vec3d::Zero();      // mesh coordinates (metres)
  Vec3d direction = Vec3d::UnitX();  // not zero
  double t_max = std::numeric_limits<double>::infinity();
};

// What is asked of each ray.
enum class RayTask : std::uint8_t {
  closest,  // the hit with the least t; of several triangles there, the one with the lowest number
  any,      // whether there is a hit; the hit that is reported is some hit
};

struct RayHit {
  static constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

  bool hit = false;
  Status status = Status::unsupported;
  std::uint32_t triangle = no_triangle;  // without a hit, and where `any` of a peer does not tell
  // NaN in the same cases. The point is vertex 0 + u * (vertex 1 - vertex 0) + v * (vertex 2 - vertex 0).
  double t = Outcome::none;
  double u = Outcome::none, v = Outcome::none;
};

struct RayCastSettings {
  Precision scalar = Precision::float64;
};

// Triangles are closed: their edges and vertices belong to them. They have two sides; `solid` has
// no meaning here. Triangles may be degenerate: a segment or a point is hit where the ray meets it. A
// ray in the plane of a triangle hits it where it enters it, or at t = 0 if it begins in it.
//
// With float32, vertices, origins, directions and t_max are rounded to floats first, and the answer
// is that for these. An algorithm may calculate in more than that.
//
// The answer to a ray with NaN or infinity (but for t_max = infinity), or with direction zero, is no
// hit, with the status `degenerate`. A t_max below zero leaves nothing to hit.
//
// The time is that of the triangle to some units in the last place of the coordinates, not of the time itself: from an
// origin a hair off a face (1e-11 of the size), t has as few correct digits.
//
// One instance for each worker, never shared between threads.
class RayCast {
 public:
  virtual ~RayCast() = default;

  // Builds what is needed. May come again, for another mesh in place of this one, which must live until
  // then, or the instance's end. Its vertices are finite; it may have no triangles.
  virtual void bind(const TriangleMesh& mesh) = 0;

  // Writes the whole of hits[i] for each ray i. Never throws.
  virtual void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) = 0;
};

struct RayCastEntry {
  AlgorithmInfo info;
  std::vector<RayTask> tasks;
  std::vector<Precision> scalars;
  // True if every answer with `ok` is exact: whether the ray hits, and which triangle is first.
  bool exact_verdicts = false;
  // Null if it is not built.
  std::function<std::unique_ptr<RayCast>(const RayCastSettings&)> make;
};

std::string_view to_string(RayTask task);

}  // namespace touchstone
