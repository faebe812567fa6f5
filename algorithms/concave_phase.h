// The contract of a concave phase: queries of pairs of bodies that need not be convex. Concave phases
// and the harness include this.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/mid_phase.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {

enum class ConcaveTask : std::uint8_t {
  intersect,  // do the closed bodies share a point?
  distance,   // the distance, with its points; only the answer if they share a point
  contacts,   // all pairs of parts that share a point
};

std::string_view to_string(ConcaveTask task);

struct ConcaveSettings {
  Precision scalar = Precision::float64;
  // What finds pairs of parts, for algorithms that leave this to another one; never null for them.
  std::function<std::unique_ptr<MidPhase>()> mid_phase = {};
  // What answers for pairs of convex parts, and of a convex part and a triangle; never null.
  std::function<std::unique_ptr<NarrowPhase>()> narrow_phase = {};
  // By how much of the pair's size (its bodies and the way between them) the bounds of a distance may be apart that
  // `narrow_phase` finds to a coarser tolerance than its usual one.
  std::optional<double> tolerance = {};
  // For `measure`, of a mesh and a convex part: a normal along which neighbours of the triangle are in the
  // way is no way out of the mesh, as at an edge inside of a flat surface. The contact gets the nearest normal of a
  // face around its point, on the side of the part's origin, and the depth along it. Without it each triangle has the
  // contact that it would have alone.
  bool welds = false;
};

// A bound body and its place.
struct PlacedConcave {
  std::uint32_t body;
  Pose pose;
};

// How two parts that share a point touch: moving b by depth * normal leaves these two parts without
// common interior.
struct PartContact {
  IndexPair parts;
  Status status = Status::unsupported;
  Vec3d normal = Vec3d::Constant(Outcome::none);  // unit vector in the world, from a to b
  double depth = Outcome::none;                   // metres; the least such, and 0 for a touch
  Vec3d point = Vec3d::Constant(Outcome::none);   // in the world: amid the two witness points
  bool is_welded = false;  // the normal and the depth are those of the face: ConcaveSettings::welds
};

// One instance for each worker, never shared between threads.
class ConcavePhase {
 public:
  virtual ~ConcavePhase() = default;

  // May come again, for another scene in place of this one; the bodies stay alive and unchanged until
  // then. Their numbers are finite, and a mesh's indices are those of its vertices.
  virtual void bind(std::span<const ConcaveBody> bodies) = 0;

  // Writes the answer: `separated`, or `overlapping` if the closed bodies share a point, a touch
  // included, or `unknown`. Of a solid mesh the points inside belong to the body. The world
  // position of a point is that of its body's pose, taken literally; a part of a compound has the
  // product of the poses instead, and if rounding that product hides the verdict the answer is
  // unknown and the status degenerate. With ConcaveTask::contacts, `pairs` gets each pair of parts
  // (triangles, or convex parts) that share a point once, in any order; a body inside of a solid one
  // has no such pair, and overlaps. Distances and points are in metres in the world; the bounds are
  // certified where there are some. Never throws on finite input.
  virtual void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b,
                     Outcome& outcome, std::vector<IndexPair>& pairs) = 0;

  // Writes the contact of each of these pairs of parts, which share a point, in their order. Returns
  // false if the algorithm has none, which is the default.
  virtual bool measure(const PlacedConcave& /*a*/, const PlacedConcave& /*b*/,
                       std::span<const IndexPair> /*pairs*/,
                       std::vector<PartContact>& /*contacts*/) {
    return false;
  }
};

struct ConcaveEntry {
  AlgorithmInfo info;
  std::vector<ConcaveTask> tasks;
  std::vector<Precision> scalars;
  // True for the pairs of bodies that it supports; null means all. Others are `unsupported`.
  bool (*supports)(const ConcaveBody& a, const ConcaveBody& b) = nullptr;
  // True if it finds pairs of parts of two meshes with ConcaveSettings::mid_phase, so that its times
  // depend on that.
  bool takes_mid_phase = false;
  // True if `measure` has contacts, and if it heeds ConcaveSettings::welds.
  bool measures = false, welds = false;
  // True if it is wrong where its doubles are: its answers are no promise.
  bool approximate = false;
  // Null if it is not built.
  std::function<std::unique_ptr<ConcavePhase>(const ConcaveSettings&)> make;
};

}  // namespace touchstone
