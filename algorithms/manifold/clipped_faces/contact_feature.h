// Part of clipped-faces: the feature of a body (a face, an edge or a point) that is furthest in a
// direction.
//
// A support map returns one furthest point. Bodies that rest on each other touch in a face or an
// edge around that point, if the face or edge is nearly perpendicular to the direction.
// Paper: Gregorius, "Robust contact creation for physics simulations", GDC 2015.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/shape.h"
#include "algorithms/core/vec.h"
#include "algorithms/kernels/minkowski/posed_shape.h"
#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {

// The faces of a hull and, for each vertex, the faces that meet there. A flat hull has two faces,
// one on either side; a segment or a point has one loop without a normal.
template <class Scalar>
class HullFaces {
 public:
  HullFaces() = default;
  explicit HullFaces(const Hull& hull);

  std::size_t size() const { return normals_.size(); }
  // Body coordinates; unit length, or zero for a loop without a normal.
  const Vec3<Scalar>& normal(std::uint32_t face) const { return normals_[face]; }
  // Vertex indices, anticlockwise seen from outside.
  std::span<const std::uint32_t> loop(std::uint32_t face) const {
    return {&loops_[loop_begin_[face]], loop_begin_[face + 1] - loop_begin_[face]};
  }
  // The faces with this vertex; empty for a vertex inside the hull and for a repeated one.
  std::span<const std::uint32_t> around(std::uint32_t vertex) const {
    return {around_.data() + around_begin_[vertex],
            around_begin_[vertex + 1] - around_begin_[vertex]};
  }
  std::span<const std::uint32_t> all_loops() const { return loops_; }

 private:
  void add(const std::vector<std::uint32_t>& loop, const Vec3d& normal);

  std::vector<Vec3<Scalar>> normals_;
  std::vector<std::uint32_t> loop_begin_ = {0}, loops_;
  std::vector<std::uint32_t> around_begin_, around_;
};

// A shape with the data that the search for features needs.
template <class Scalar>
struct FeatureShape {
  explicit FeatureShape(const Shape& shape)
      : support(shape),
        faces(shape.kind == ShapeKind::hull ? HullFaces<Scalar>(*shape.hull) : HullFaces<Scalar>()),
        complete(shape.kind != ShapeKind::hull || shape.hull->dimension < 3 ||
                 !shape.hull->faces.empty()) {}

  SupportShape<Scalar> support;
  HullFaces<Scalar> faces;
  bool complete;  // false for a solid hull that came without faces: it has no features
};

// A feature in the frame of the caller: a convex polygon (three points or more), a segment (two) or
// empty, when the feature is only the furthest point, which the caller already has.
template <class Scalar>
struct ContactFeature {
  std::vector<Vec3<Scalar>> points;
  Vec3<Scalar> normal = Vec3<Scalar>::Zero();  // a polygon's: unit, outward
  bool numbered = false;     // true if the edges have the same numbers in every frame and
  std::uint16_t number = 0;  // this is the number of the body's face
};

// The greatest sine of the angle between the direction's perpendicular and a face or an edge that
// still counts as a feature; beyond it only the furthest point does.
template <class Scalar>
inline constexpr Scalar greatest_tilt = static_cast<Scalar>(0.42);  // 25 degrees

// Finds the feature that supports the body in `direction` (unit). `centre` is the body's place in
// the frame and `rotation` its pose's. The rim of a cylinder or cone becomes an inscribed polygon
// with the furthest point as a corner.
template <class Scalar>
void find_feature(const FeatureShape<Scalar>& shape, const Mat3<Scalar>& rotation,
                  const PosedShape<Scalar>& turned, const Vec3<Scalar>& centre,
                  const Vec3<Scalar>& direction, ContactFeature<Scalar>& feature);

extern template class HullFaces<float>;
extern template class HullFaces<double>;
extern template void find_feature(const FeatureShape<float>&, const Mat3<float>&,
                                  const PosedShape<float>&, const Vec3<float>&, const Vec3<float>&,
                                  ContactFeature<float>&);
extern template void find_feature(const FeatureShape<double>&, const Mat3<double>&,
                                  const PosedShape<double>&, const Vec3<double>&,
                                  const Vec3<double>&, ContactFeature<double>&);

}  // namespace touchstone
