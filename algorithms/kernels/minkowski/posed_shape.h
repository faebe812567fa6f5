// The support map of a shape at the orientation of its body. Used through support.h by every narrow
// phase with support maps.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {

// The core of a shape, read at run time.
struct GenericCore {
  template <class Scalar>
  static SupportCore of(const SupportShape<Scalar>& shape) {
    return shape.core;
  }
};
// The core of a shape, known at compile time.
template <SupportCore core>
struct SpecialisedCore {
  template <class Scalar>
  static constexpr SupportCore of(const SupportShape<Scalar>&) {
    return core;
  }
};

// Indices of the corners of a core: a point has 0; a segment and a box have a bit for each axis,
// set if the corner is on the negative side; a hull has its vertices' indices. Round cores have no
// corners.
inline constexpr std::uint32_t no_corner = ~std::uint32_t{0};

// The corners of the two cores whose difference is a point.
struct CornerPair {
  std::uint32_t a = no_corner, b = no_corner;
};

// A shape at the orientation of its body, around its centre, in the unit of a query.
template <class Scalar>
class PosedShape {
 public:
  // `unit` is the power of two, in metres, by which results are divided.
  PosedShape(const SupportShape<Scalar>& shape, const Mat3d& rotation, double unit)
      : shape_(&shape),
        matrix_((rotation * (shape.unit / unit)).template cast<Scalar>()),
        radius_(static_cast<Scalar>(shape.radius / unit)) {}

  // Returns the point of the core that is furthest in the direction, relative to the centre. The
  // direction need not have unit length, but its square must neither overflow nor underflow.
  // `Which` gives the core.
  template <class Which = GenericCore>
  Vec3<Scalar> support(const Vec3<Scalar>& direction);

  // How far the core reaches along the direction, from the centre.
  Scalar support_value(const Vec3<Scalar>& direction);

  // Returns true if the core has a corner with that index.
  bool has_corner(std::uint32_t number) const { return number < corners(); }
  // The corner with that index, relative to the centre.
  Vec3<Scalar> corner(std::uint32_t number) const;
  // The index of the last support vertex of a hull.
  std::uint32_t last_corner() const {
    return shape_->cells.empty() ? vertex_ : shape_->cells.number(vertex_);
  }

  Scalar radius() const { return radius_; }
  const SupportShape<Scalar>& shape() const { return *shape_; }
  const Mat3<Scalar>& matrix() const { return matrix_; }

 private:
  using Core = typename SupportShape<Scalar>::Core;

  // The point of the disc with this radius, normal to z, that is furthest along (dx, dy); its
  // centre if the direction is along z.
  static Vec3<Scalar> disc_support(Scalar radius, const Vec3<Scalar>& d, Scalar z) {
    const Scalar square = d.x() * d.x() + d.y() * d.y();
    if (!(square > least_square)) {
      const Scalar greatest = std::max(std::abs(d.x()), std::abs(d.y()));
      if (!(greatest > 0)) return {0, 0, z};
      return disc_support(radius, d / greatest, z);
    }
    const Scalar factor = radius / std::sqrt(square);
    return {factor * d.x(), factor * d.y(), z};
  }

  std::uint32_t corners() const {
    switch (shape_->core) {
      case Core::point: return 1;
      case Core::segment:
      case Core::box: return 8;
      case Core::hull: return static_cast<std::uint32_t>(shape_->corners.size());
      default: return 0;
    }
  }

  // Squares below this have lost digits: their root would place points outside the core.
  static constexpr Scalar least_square =
      std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon();

  const SupportShape<Scalar>* shape_;
  Mat3<Scalar> matrix_;
  Scalar radius_;
  std::uint32_t vertex_ = 0;  // hull: the last support; with a cube map its place there
};

template <class Scalar>
template <class Which>
inline Vec3<Scalar> PosedShape<Scalar>::support(const Vec3<Scalar>& direction) {
  const Core core = Which::of(*shape_);
  const Vec3<Scalar>& e = shape_->extents;
  if (core == Core::point) return Vec3<Scalar>::Zero();
  if (core == Core::segment) {
    return std::copysign(e.z(), matrix_.col(2).dot(direction)) * matrix_.col(2);
  }
  const Vec3<Scalar> d = matrix_.transpose() * direction;
  switch (core) {
    case Core::box:
      return matrix_ * Vec3<Scalar>{std::copysign(e.x(), d.x()), std::copysign(e.y(), d.y()),
                                    std::copysign(e.z(), d.z())};
    case Core::cylinder: return matrix_ * disc_support(e.x(), d, std::copysign(e.z(), d.z()));
    case Core::cone: {
      // The tip is further than the rim of the base if 2 h dz > r |(dx, dy)|.
      const bool tip = 2 * e.z() * d.z() > e.x() * std::sqrt(d.x() * d.x() + d.y() * d.y());
      return tip ? Vec3<Scalar>(e.z() * matrix_.col(2)) : matrix_ * disc_support(e.x(), d, -e.z());
    }
    case Core::ellipsoid: {
      Vec3<Scalar> stretched = e.cwiseProduct(d);
      Scalar square = stretched.squaredNorm();
      if (!(square > least_square)) {
        const Scalar greatest = stretched.cwiseAbs().maxCoeff();
        if (!(greatest > 0)) return Vec3<Scalar>::Zero();
        stretched /= greatest;
        square = stretched.squaredNorm();
      }
      return matrix_ * e.cwiseProduct(stretched / std::sqrt(square));
    }
    case Core::hull:
      if (!shape_->cells.empty()) {
        vertex_ = shape_->cells.furthest(d).place;
        return matrix_ * shape_->cells.vertex(vertex_);
      }
      vertex_ = shape_->furthest(d);
      return matrix_ * shape_->vertex(vertex_);
    case Core::point:
    case Core::segment:
    case Core::halfspace: break;  // a half-space has no furthest point: see halfspace.h
  }
  return Vec3<Scalar>::Zero();
}

template <class Scalar>
inline Scalar PosedShape<Scalar>::support_value(const Vec3<Scalar>& direction) {
  const Vec3<Scalar>& e = shape_->extents;
  switch (shape_->core) {
    case Core::segment: return e.z() * std::abs(matrix_.col(2).dot(direction));
    case Core::box: return e.dot((matrix_.transpose() * direction).cwiseAbs());
    default: return direction.dot(support(direction));
  }
}

template <class Scalar>
inline Vec3<Scalar> PosedShape<Scalar>::corner(std::uint32_t number) const {
  const Vec3<Scalar>& e = shape_->extents;
  const auto side = [&](int axis) { return (number >> axis & 1) != 0 ? -e[axis] : e[axis]; };
  switch (shape_->core) {
    case Core::segment: return side(2) * matrix_.col(2);
    case Core::box: return matrix_ * Vec3<Scalar>{side(0), side(1), side(2)};
    case Core::hull: return matrix_ * shape_->vertex(number);
    default: return Vec3<Scalar>::Zero();
  }
}

}  // namespace touchstone
