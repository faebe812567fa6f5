// The projection of the origin on a polytope's face that consists of triangles. Used by
// expanding_polytope and gjk-lanes.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// Selects the triangle that contains the projection, or is closest to that, among triangles in one
// plane. If all are flat it gives the centre of the first.
template <class Scalar>
class OriginProjection {
 public:
  OriginProjection(const std::array<int, 3>& vertices, const std::array<Vec3<Scalar>, 3>& corners)
      : vertices_(vertices) {
    consider(vertices, corners);
  }

  void consider(const std::array<int, 3>& vertices, const std::array<Vec3<Scalar>, 3>& corners) {
    const TrianglePlane<Scalar> plane = triangle_plane(corners);
    if (plane.flat) return;
    const std::array<Scalar, 3> weights = project_origin(plane, corners);
    const Scalar least = std::min({weights[0], weights[1], weights[2]});
    if (!(least > least_)) return;
    least_ = least;
    weights_ = weights;
    vertices_ = vertices;
  }

  bool is_inside() const { return least_ >= 0; }
  const std::array<int, 3>& vertices() const { return vertices_; }
  // Barycentric weights of these vertices; none is negative.
  std::array<Scalar, 3> weights() const {
    std::array<Scalar, 3> weights;
    Scalar sum = 0;
    for (int i = 0; i < 3; ++i) sum += weights[i] = std::max(weights_[i], Scalar{0});
    for (Scalar& weight : weights) weight /= sum;
    return weights;
  }

 private:
  Scalar least_ = -std::numeric_limits<Scalar>::infinity();
  std::array<Scalar, 3> weights_ = {1, 1, 1};
  std::array<int, 3> vertices_;
};

}  // namespace touchstone
