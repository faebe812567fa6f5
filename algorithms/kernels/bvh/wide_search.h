// The leaves of a wide tree that a convex body in another frame may meet: one box, with a ball around
// each of its points, against eight boxes of a node. Used by concave phases.
// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (boxes of two frames; of the fifteen axes
//        only the six of faces are tested).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/kernels/bvh/wide_descent.h"

namespace touchstone {

// A box and a radius in their own frame, and how a tree's boxes are seen from there.
struct SearchBox {
  struct Extent {
    std::array<float, 3> centre, half;  // grown by bounds on all rounding
  };
  Extent own;   // along the axes of the box
  Extent seen;  // along those of the tree; infinite where the map between them has no inverse
  BoxView view;
  float radius, seen_radius;  // of the ball in both frames (metres)
};

// `low` and `high` are corners of the box, which may be infinite. `map` takes the tree's coordinates to
// the box's, off by at most `error`; `reach` bounds the magnitudes of the tree's (metres).
SearchBox search_box(const Vec3d& low, const Vec3d& high, double radius, const Pose& map,
                     double error, double reach);

class WideSearch {
 public:
  // Returns false to end the search.
  using Visit = bool (*)(void* context, std::uint32_t leaf);

  // Calls `visit` for every leaf but those whose boxes are surely further from the box than the
  // radius. Returns false if `visit` ended it.
  bool run(const WideBvh& tree, const SearchBox& box, Visit visit, void* context);

 private:
  std::vector<std::uint32_t> open_;  // nodes
};

}  // namespace touchstone
