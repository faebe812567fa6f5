// Part of part-pairs: convex parts against the triangles of a mesh, a leaf of eight at once.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/concave/part_pairs/mesh_tree.h"
#include "algorithms/concave_phase.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/bvh/wide_search.h"
#include "algorithms/kernels/triangles/convex_signs.h"
#include "algorithms/kernels/triangles/triangle_signs.h"

namespace touchstone {

class ConvexSearch {
 public:
  // Gets triangles that share a point with the part, or, if `open`, may do so. Returns false to end the
  // search.
  using Take =
      std::function<bool(std::uint32_t part, std::span<const std::uint32_t> triangles, bool open)>;

  explicit ConvexSearch(std::shared_ptr<const MeshTrees> trees) : trees_(std::move(trees)) {}

  // The bodies stay alive and unchanged.
  void bind(std::span<const BoundBody> bodies);

  // Searches the mesh for each part of the other body. Returns false, without a call of `take`, X doubles in its frame prove nothing.
  bool find(const PlacedConcave& parts, const PlacedConcave& mesh, const Take& take);

 private:
  struct Part {
    LaneConvex convex;
    double reach;   // in the part's frame, of its box with the radius (metres)
    bool is_plain;  // its pose in the body is the identity, and nothing was rounded
  };
  // A part in its frame, and the mesh seen from there.
  struct Placed {
    const Part* part;
    Pose map;
    double error;
  };

  std::span<const BoundBody> bodies_;
  std::shared_ptr<const MeshTrees> trees_;
  std::vector<std::vector<Part>> parts_;
  std::vector<Placed> placed_;
  WideSearch search_;
};

}  // namespace touchstone
