// Part of part-pairs: meshes in the order of their trees' leaves.
#pragma once

#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/kernels/bvh/wide_bvh.h"
#include "algorithms/kernels/triangles/block_extent.h"
#include "algorithms/kernels/triangles/triangle_block.h"

namespace touchstone {

// Without nodes where the body is no mesh.
struct MeshTree {
  WideBvh tree;
  std::vector<TriangleBlock> blocks;  // one a leaf
  std::vector<BlockExtent> extents;   // of the blocks, along their normals
};
using MeshTrees = std::vector<MeshTree>;  // one a body

inline MeshTree mesh_tree(const BoundBody& body) {
  MeshTree made;
  if (body.mesh() == nullptr) return made;
  made.tree = build_wide_bvh(body.boxes);
  made.blocks = triangle_blocks(*body.mesh(), made.tree.order);
  made.extents.reserve(made.blocks.size());
  for (const TriangleBlock& block : made.blocks) made.extents.push_back(extent_along_normal(block));
  return made;
}

}  // namespace touchstone
