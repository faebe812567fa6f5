// Part of the oracle, used by the checks of certificates: a mesh in rationals, and what its surface winds
// around.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/oracle/certificates/rational_pose.h"

namespace touchstone::oracle {

using RationalTriangle = std::array<RationalVector, 3>;

// Throws Fault if a triangle names no vertex, or a number is not finite.
class RationalMesh {
 public:
  explicit RationalMesh(const TriangleMesh& mesh);

  std::size_t size() const { return triangles_.size(); }
  const RationalVector& vertex(std::uint32_t number) const { return vertices_[number]; }
  RationalTriangle triangle(std::size_t number) const;

  // Throws Fault unless each edge, known by where its ends are, goes one way as often as the other.
  void require_closed() const;

  // The first triangle of each piece that hangs together by shared vertices.
  std::vector<std::uint32_t> one_of_each_piece() const;

  // Places all vertices.
  RationalMesh placed(const RationalPose& pose) const;

  // How often the closed surface winds around the point, if that is not on it. The point is moved by (d, d^2, 0) for
  // an infinitely small d > 0; where it is on the surface the number is that of the region there, which
  // touches it.
  int winding(const RationalVector& point) const;

 private:
  std::vector<RationalVector> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace touchstone::oracle
