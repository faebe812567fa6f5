// Part of the oracle: which triangles of a mesh, or which boxes, a ray may meet, and which triangles may be
// nearest to a point.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone::oracle {

// A binary tree over boxes, of triangles or of anything. Those of triangles are exact, since their numbers
// are vertices'; what is left out is left out for certain, in spite of all roundings of doubles. Lists are in
// the order of the numbers.
class BoxTree {
 public:
  using Triangles = std::span<const std::array<std::uint32_t, 3>>;
  struct Box {
    Vec3d low, high;  // finite
  };

  // Both must live as long as the tree is asked. Vertices are finite.
  void build(std::span<const Vec3d> vertices, Triangles triangles);
  void build(std::span<const Box> boxes);

  // Writes all triangles, or boxes, that have a point of the ray from `origin` on, and perhaps more.
  // Numbers are finite.
  void meet_ray(const Vec3d& origin, const Vec3d& direction,
                std::vector<std::uint32_t>& found) const;

  // Writes all triangles that may have the point of the mesh that is nearest to `point`, and perhaps more.
  // The tree is one of triangles.
  void may_be_nearest(const Vec3d& point, std::vector<std::uint32_t>& found) const;

 private:
  // The children of node i are 2 i + 1 and 2 i + 2; a leaf has one item, or none.
  void build_of(std::span<const Box> boxes);
  void fill(std::size_t node, std::span<const Box> boxes, std::span<std::uint32_t> part);
  // Calls take(number) at each leaf below nodes for whose boxes enters(box) holds.
  template <class Enter, class Take>
  void walk(Enter&& enters, Take&& take) const;
  std::array<Vec3d, 3> corners(std::uint32_t triangle) const;

  std::span<const Vec3d> vertices_;
  Triangles triangles_;
  std::vector<Box> nodes_;
  std::vector<std::uint32_t> of_leaf_;
  std::size_t leaves_ = 0;  // a power of two
};

}  // namespace touchstone::oracle
