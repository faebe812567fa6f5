// The 15 axes of two boxes, from products of their matrices.
#include "algorithms/kernels/sat/box_box.h"

#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// Returns the best outward face normal of `from`. `offset` is the vector from its centre to that of
// the other box, and products(i, j) are the products of its normals with the other's edges.
template <class Scalar>
Axis<Scalar> best_face(const PlacedPolytope<Scalar>& from, const Vec3<Scalar>& half,
                       const Vec3<Scalar>& half_other, const Mat3<Scalar>& products,
                       const Vec3<Scalar>& offset, Scalar enough, int& tested) {
  Axis<Scalar> best;
  for (int i = 0; i < 3; ++i) {
    const Vec3<Scalar> normal = from.normals.col(i);
    const Scalar between = normal.dot(offset);
    const Scalar reach =
        from.determinant * half[i] + products.row(i).cwiseAbs().transpose().dot(half_other);
    const Scalar length = normal.norm();
    const Scalar gap = (std::abs(between) - reach) / length;
    ++tested;
    if (gap > best.gap) best = {gap, normal / (between < 0 ? -length : length)};
    if (gap > enough) break;
  }
  return best;
}

}  // namespace

template <class Scalar>
Axis<Scalar> box_axis(const PolytopePair<Scalar>& pair, int& tested) {
  const PlacedPolytope<Scalar>&a = pair.a(), &b = pair.b();
  // Corner 7 of a box is at its half extents.
  const Vec3<Scalar> half_a = a.scale * a.shape->vertex(7), half_b = b.scale * b.shape->vertex(7);
  const Vec3<Scalar>& offset = b.origin;
  const Mat3<Scalar> normals_a = a.normals.transpose() * b.matrix;
  Axis<Scalar> best = best_face<Scalar>(a, half_a, half_b, normals_a, offset, pair.error(), tested);
  if (pair.separates(best)) return best;
  const Mat3<Scalar> normals_b = b.normals.transpose() * a.matrix;
  const Axis<Scalar> of_b =
      best_face<Scalar>(b, half_b, half_a, normals_b, -offset, pair.error(), tested);
  if (of_b.gap > best.gap) best = {of_b.gap, -of_b.normal};
  if (pair.separates(best)) return best;

  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      Vec3<Scalar> normal = a.matrix.col(i).cross(b.matrix.col(j));
      const Scalar sine = normal.norm();
      // The facet is too narrow to matter: the faces beside it are perpendicular to each other.
      if (sine < 64 * std::numeric_limits<Scalar>::epsilon()) continue;
      ++tested;
      // |a_k . (a_i x b_j)| is the product of the third normal of a with b_j, and likewise for b.
      const Scalar between = normal.dot(offset);
      const Scalar reach =
          half_a[i1] * std::abs(normals_a(i2, j)) + half_a[i2] * std::abs(normals_a(i1, j)) +
          half_b[j1] * std::abs(normals_b(j2, i)) + half_b[j2] * std::abs(normals_b(j1, i));
      const Scalar gap = (std::abs(between) - reach) / sine;
      if (gap <= best.gap - pair.error() / sine) continue;
      normal /= between < 0 ? -sine : sine;
      Axis<Scalar> axis{gap, normal};
      if (sine < Scalar{0.5}) {
        normal -= normal.dot(a.matrix.col(i)) * a.matrix.col(i) / a.matrix.col(i).squaredNorm();
        axis = pair.axis_along(normal.normalized());
      }
      if (axis.gap > best.gap) best = axis;
      if (pair.separates(best)) return best;
    }
  }
  return best;
}

template <class Scalar>
Axis<Scalar> box_axis_along(const PolytopePair<Scalar>& pair, const Vec3<Scalar>& normal) {
  Scalar gap = normal.dot(pair.b().origin);
  for (const PlacedPolytope<Scalar>* box : {&pair.a(), &pair.b()}) {
    const Vec3<Scalar> own = box->matrix.transpose() * normal;
    gap -= box->scale * own.cwiseAbs().dot(box->shape->vertex(7));
  }
  return {gap, normal};
}

template Axis<float> box_axis_along(const PolytopePair<float>&, const Vec3<float>&);
template Axis<double> box_axis_along(const PolytopePair<double>&, const Vec3<double>&);
template Axis<float> box_axis(const PolytopePair<float>&, int&);
template Axis<double> box_axis(const PolytopePair<double>&, int&);

}  // namespace touchstone
