// The contract of point queries: the closest point of a triangle mesh, and whether a point is inside.
// Point queries and the harness include this.
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

// What is asked of each point.
enum class PointTask : std::uint8_t {
  closest,  // the nearest point of the triangles, and its distance
  side,     // whether the point is inside of what the surface winds around
};

enum class PointSide : std::uint8_t { outside, surface, inside, unknown };

struct PointAnswer {
  static constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

  Status status = Status::unsupported;
  PointSide side = PointSide::unknown;   // the side task alone
  std::uint32_t triangle = no_triangle;  // one that has the closest point
  double distance = Outcome::none;       // metres, >= 0; NaN if the mesh has no triangle
  Vec3d closest = Vec3d::Constant(Outcome::none);
};

// Triangles are closed, and may be degenerate. For `side` the surface is closed: each edge goes one
// way as often as the other. A point on a triangle is on the surface; any other is inside if the
// surface winds around it, either way. A point with NaN or infinity has the status `degenerate`.
// Where products of coordinates vanish, as of 4.9e-324, the answer to `side` may be `degenerate`.
//
// One instance for each worker, never shared between threads.
class PointQuery {
 public:
  virtual ~PointQuery() = default;

  // Builds what is needed. May come again, for another mesh in place of this one, which must live until
  // then, or the instance's end. Its vertices are finite; it may have no triangles.
  virtual void bind(const TriangleMesh& mesh) = 0;

  // Writes the whole of answers[i] for each point i (mesh coordinates, metres). Never throws.
  virtual void query(PointTask task, std::span<const Vec3d> points,
                     std::span<PointAnswer> answers) = 0;
};

struct PointQueryEntry {
  AlgorithmInfo info;
  std::vector<PointTask> tasks;
  Precision scalar = Precision::float64;  // what it calculates in
  // Null if it is not built.
  std::function<std::unique_ptr<PointQuery>()> make;
};

std::string_view to_string(PointTask task);
std::string_view to_string(PointSide side);

}  // namespace touchstone
