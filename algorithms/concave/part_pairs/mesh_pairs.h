// Part of part-pairs: what finds the pairs of triangles of two placed meshes that share a point.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/concave/part_pairs/mesh_tree.h"
#include "algorithms/concave_phase.h"

namespace touchstone {

class MeshPairs {
 public:
  virtual ~MeshPairs() = default;

  // The bodies stay alive and unchanged.
  virtual void bind(std::span<const BoundBody> bodies) = 0;
  // Hands over the pairs of two meshes' triangles that share a point, each once, until `take` returns
  // false.
  virtual void find(const PlacedConcave& a, const PlacedConcave& b, const TakePartPairs& take) = 0;
};

// Says whether two triangles share a point, in one frame in which each coordinate is off by at most
// `error`: 1 they do, 0 they do not, -1 undecided.
using RoughTest = int (*)(const TriangleCorners& a, const TriangleCorners& b, double error);

// A mid-phase and one of the tests; undecided pairs are tested in integers.
std::unique_ptr<MeshPairs> tested_pairs(std::shared_ptr<MidPhase> mid_phase, RoughTest test);

// Wide trees whose leaves are tested as a whole by the signs of volumes (kernels/triangles), without
// a mid-phase. The trees are those of the bodies that are bound.
std::unique_ptr<MeshPairs> fused_pairs(std::shared_ptr<const MeshTrees> trees);

// The signs of volumes for one pair.
int test_by_signs(const TriangleCorners& a, const TriangleCorners& b, double error);
// Paper: Moller, "A fast triangle-triangle intersection test", JGT 2(2), 1997. Decides always, in
// doubles.
int test_by_moller(const TriangleCorners& a, const TriangleCorners& b, double error);
// Paper: Guigue, Devillers, "Fast and robust triangle-triangle overlap test using orientation
//        predicates", JGT 8(1), 2003. Decides always, in doubles.
int test_by_guigue_devillers(const TriangleCorners& a, const TriangleCorners& b, double error);

}  // namespace touchstone
