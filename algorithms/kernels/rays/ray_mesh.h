// A mesh as rays and points walk it: the tree, and its leaves' triangles side by side in floats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/outcome.h"
#include "algorithms/kernels/bvh/wide_bvh.h"

namespace touchstone::ray_tree {

// Eight triangles, a lane each: x, y and z of the first vertices, of the second and of the third, in
// the frame of the tree. Lanes behind the last triangle have its number and NaN, which nothing hits.
// 320 bytes.
struct alignas(64) Leaf {
  std::array<std::array<float, 8>, 9> corners;
  std::array<std::uint32_t, 8> triangle;
};

// Coordinates of the tree's frame are (x - centre) * scale, up to 1 in magnitude; the scale is a
// power of two.
struct Frame {
  Vec3d centre = Vec3d::Zero();
  double scale = 1;
};

class RayMesh {
 public:
  // With float32, the vertices are rounded to floats first. The mesh must outlive this.
  RayMesh(const TriangleMesh& mesh, Precision scalar);

  const WideBvh& tree() const { return tree_; }
  const std::vector<Leaf>& leaves() const { return leaves_; }
  const Frame& frame() const { return frame_; }
  // True if the leaves' floats are the vertices, and not their nearest floats.
  bool is_exact() const { return exact_; }
  std::size_t triangles() const { return mesh_->triangles.size(); }

  using Corners = std::array<Vec3d, 3>;
  // The vertices of a triangle as they are.
  Corners corners(std::uint32_t triangle) const;
  // Those of a leaf's lane, from the leaf itself if it is exact.
  Corners corners(const Leaf& leaf, std::size_t lane) const {
    if (!exact_) return corners(leaf.triangle[lane]);
    const auto vertex = [&](std::size_t k) {
      const auto at = [&](std::size_t axis) {
        return static_cast<double>(leaf.corners[3 * k + axis][lane]) * size_ +
               frame_.centre[static_cast<int>(axis)];
      };
      return Vec3d(at(0), at(1), at(2));
    };
    return {vertex(0), vertex(1), vertex(2)};
  }

 private:
  Vec3d vertex(std::uint32_t number) const;
  bool try_frame(const Frame& frame);

  const TriangleMesh* mesh_;
  Precision scalar_;
  Frame frame_;
  double size_ = 1;  // 1 / scale
  bool exact_ = false;
  WideBvh tree_;
  std::vector<Leaf> leaves_;
};

}  // namespace touchstone::ray_tree
