// Part of part-pairs: meshes in the order of their trees' leaves.
#pragma once

#include <algorithm>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/core/nearest_float.h"
#include "algorithms/kernels/bvh/wide_bvh.h"
#include "algorithms/kernels/triangles/block_extent.h"
#include "algorithms/kernels/triangles/moved_block.h"

namespace touchstone {

// The triangles of a mesh, a block a leaf: as floats if all its coordinates are floats, which takes half the
// memory, and as doubles otherwise.
class LeafBlocks {
 public:
  LeafBlocks() = default;
  LeafBlocks(const TriangleMesh& mesh, std::span<const std::uint32_t> order) {
    const bool are_floats = std::ranges::all_of(mesh.vertices, [](const Vec3d& v) {
      return std::ranges::all_of(v, [](double x) { return nearest_float(x) == x; });
    });
    if (are_floats) {
      floats_ = triangle_blocks<float>(mesh, order);
    } else {
      doubles_ = triangle_blocks<double>(mesh, order);
    }
  }

  std::size_t size() const { return floats_.size() + doubles_.size(); }
  // Returns what `visit` does of a leaf's block, in floats or doubles.
  template <class Visit>
  auto with(std::size_t leaf, const Visit& visit) const {
    return floats_.empty() ? visit(doubles_[leaf]) : visit(floats_[leaf]);
  }
  // The block of a leaf under a pose.
  void move(std::size_t leaf, const Pose& pose, TriangleBlock& moved) const {
    with(leaf, [&](const auto& block) { touchstone::move(block, pose, moved); });
  }

 private:
  std::vector<FloatTriangleBlock> floats_;
  std::vector<TriangleBlock> doubles_;
};

// Without nodes where the body is no mesh.
struct MeshTree {
  WideBvh tree;
  LeafBlocks blocks;
  std::vector<BlockExtent> extents;  // of the blocks, along their normals
};
using MeshTrees = std::vector<MeshTree>;  // one a body

inline MeshTree mesh_tree(const BoundBody& body) {
  MeshTree made;
  if (body.mesh() == nullptr) return made;
  made.tree = build_wide_bvh(body.boxes);
  made.blocks = LeafBlocks(*body.mesh(), made.tree.order);
  made.extents.reserve(made.blocks.size());
  for (std::size_t leaf = 0; leaf < made.blocks.size(); ++leaf) {
    made.extents.push_back(
        made.blocks.with(leaf, [](const auto& block) { return extent_along_normal(block); }));
  }
  return made;
}

}  // namespace touchstone
