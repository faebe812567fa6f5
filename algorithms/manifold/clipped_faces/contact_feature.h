// What of a body lies furthest in a direction: a face, an edge or a point.
//
// A support map knows one furthest point. Bodies that lie on each other touch in more, which is
// the face or edge around that point if it is about across the direction.
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

// The faces of a hull, and which of them meet in a vertex. A flat hull has two, on either side; a
// segment or a point a loop without a normal.
template <class Scalar>
class HullFaces {
 public:
  HullFaces() = default;
  explicit HullFaces(const Hull& hull);

  std::size_t size() const { return normals_.size(); }
  // In body coordinates; unit or zero.
  const Vec3<Scalar>& normal(std::uint32_t face) const { return normals_[face]; }
  // Vertices, anticlockwise seen from outside.
  std::span<const std::uint32_t> loop(std::uint32_t face) const {
    return {&loops_[loop_begin_[face]], loop_begin_[face + 1] - loop_begin_[face]};
  }
  // The faces with this vertex; none for one that is inside the hull or stands twice.
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

// A shape as the search for features wants it.
template <class Scalar>
struct FeatureShape {
  explicit FeatureShape(const Shape& shape)
      : support(shape),
        faces(shape.kind == ShapeKind::hull ? HullFaces<Scalar>(*shape.hull) : HullFaces<Scalar>()),
        complete(shape.kind != ShapeKind::hull || shape.hull->dimension < 3 ||
                 !shape.hull->faces.empty()) {}

  SupportShape<Scalar> support;
  HullFaces<Scalar> faces;
  bool complete;  // false for a solid hull that came without faces: nothing of it is found
};

// Three points or more are a convex polygon, two a segment; none: the furthest point is alone, and
// whoever asks knows it. In the frame of who asked.
template <class Scalar>
struct ContactFeature {
  std::vector<Vec3<Scalar>> points;
  Vec3<Scalar> normal = Vec3<Scalar>::Zero();  // of a polygon: unit, outward
  bool numbered = false;                       // its edges are the same in every frame, and
  std::uint16_t number = 0;                    // the body's face of this number is the polygon
};

// The greatest sine of the angle by which a face or an edge is off being across the direction, so
// as to be taken for more than its furthest point.
template <class Scalar>
inline constexpr Scalar greatest_tilt = Scalar{0.42};  // 25 degrees

// The feature that supports the body in the direction (unit), about `centre`; `rotation` is that of
// its pose. The rim of a cylinder
// or cone is a polygon in it that has the furthest point as a corner.
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
