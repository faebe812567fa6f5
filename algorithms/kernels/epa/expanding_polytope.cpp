// The surface of EPA around the origin, and its witness points.
#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/epa/expanding_polytope.inl"
#include "algorithms/kernels/epa/origin_projection.h"

namespace touchstone {

template <class Scalar>
ExpandingPolytope<Scalar>::ExpandingPolytope(int max_iterations)
    : max_iterations_(max_iterations), surface_(static_cast<std::size_t>(max_iterations) + 4) {}

// Returns true if the origin is on the inner side of every face by more than rounding.
template <class Scalar>
bool ExpandingPolytope<Scalar>::encloses_origin() const {
  return surface_.all_faces([&](int face) {
    const std::array<Vec3<Scalar>, 3> corners = surface_.points(surface_.corners(face));
    const TrianglePlane<Scalar> plane = triangle_plane(corners);
    if (plane.flat) return true;
    const Scalar doubt = lever(project_origin(plane, corners));
    return surface_.distance(face) > doubt * SupportPair<Scalar>::rounding;
  });
}

// Projects the origin on the face of the upper bound. If several faces lie in its plane, the one
// that contains the projection is used.
template <class Scalar>
void ExpandingPolytope<Scalar>::find_witnesses(const std::array<int, 3>& best,
                                               Expansion<Scalar>& result) const {
  OriginProjection<Scalar> foot(best, surface_.points(best));
  if (!foot.is_inside()) {
    const Vec3<Scalar> normal = result.normal;
    const Scalar height = normal.dot(surface_.vertex(best[0]).difference);
    const auto in_plane = [&](int vertex) {
      const Scalar off = normal.dot(surface_.vertex(vertex).difference) - height;
      return std::abs(off) <= SupportPair<Scalar>::rounding;
    };
    surface_.all_faces([&](int face) {
      const std::array<int, 3> corners = surface_.corners(face);
      if (std::ranges::all_of(corners, in_plane)) foot.consider(corners, surface_.points(corners));
      return true;
    });
  }
  const std::array<Scalar, 3> weights = foot.weights();
  result.a.setZero();
  result.b.setZero();
  for (int i = 0; i < 3; ++i) {
    result.a += weights[i] * surface_.vertex(foot.vertices()[i]).a;
    result.b += weights[i] * surface_.vertex(foot.vertices()[i]).b;
  }
}

template class ExpandingPolytope<float>;
template class ExpandingPolytope<double>;
template Expansion<float> ExpandingPolytope<float>::expand(SupportPair<float>&,
                                                           const Simplex<float>&,
                                                           const ExpansionGoal<float>&);
template Expansion<double> ExpandingPolytope<double>::expand(SupportPair<double>&,
                                                             const Simplex<double>&,
                                                             const ExpansionGoal<double>&);

}  // namespace touchstone
