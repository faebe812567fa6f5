// Part of certified: supports of cores from the shapes' own numbers, with bounds on their rounding.
// Includes core and kernels.
//
// Computed in long double or double. A sum carries the total magnitude of its terms, and is off by
// a few units (half epsilons) of that.
// Paper:   Wilkinson, "Rounding Errors in Algebraic Processes", 1963.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/core/shape.h"
#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {

// A shape and the box around its core to which the bounds are relative. The shape must outlive this
// object.
struct BoundedShape {
  explicit BoundedShape(const Shape& s);

  const Shape* shape;
  SupportShape<double> support;
  Vec3d reach;  // the greatest magnitude of each body coordinate in the core, metres
  // Hull: the vertices' coordinates, for vector instructions.
  Eigen::ArrayXd x, y, z;

 private:
  void set_coordinates(const std::vector<Vec3d>& vertices);
};

// A proven interval: lower <= signed distance <= upper (metres). Infinite if nothing is proven.
struct DistanceBounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

using Wide = long double;
using Wide3 = Vec3<Wide>;
using WideMatrix = Mat3<Wide>;

// Half a unit in the last place of 1. Products of a dozen doubles neither overflow nor underflow if
// the exponents are those of x87 or wider.
inline constexpr Wide wide_unit = std::numeric_limits<Wide>::epsilon() / 2;
inline constexpr bool is_wide = std::numeric_limits<Wide>::max_exponent >= 16384;

inline Wide3 wide(const Vec3d& x) { return x.cast<Wide>(); }

// The nearest double below or above a number.
double round_down(Wide x);
double round_up(Wide x);

// A number and the total magnitude of its terms; the number is off by a few units of that.
template <class Real>
struct Sum {
  Real value = 0, terms = 0;
};

// Lists the hull's vertices that may be furthest along g given the rounding of doubles. It may list
// others. `values` is memory to work in.
void find_furthest(const BoundedShape& hull, const Vec3d& g, Eigen::ArrayXd& values,
                   std::vector<std::uint32_t>& furthest);

// Finds a hull's support along g in long double: tests all vertices that may be furthest.
class AllThatMayBe {
 public:
  AllThatMayBe(Eigen::ArrayXd& values, std::vector<std::uint32_t>& furthest)
      : values_(values), furthest_(furthest) {}
  Wide operator()(const BoundedShape& body, const Wide3& g) const {
    const std::vector<Vec3d>& vertices = body.shape->hull->vertices;
    find_furthest(body, g.cast<double>(), values_, furthest_);
    Wide most = -std::numeric_limits<Wide>::infinity();
    for (const std::uint32_t i : furthest_) most = std::max(most, g.dot(wide(vertices[i])));
    return most;
  }

 private:
  Eigen::ArrayXd& values_;
  std::vector<std::uint32_t>& furthest_;
};
// Finds a hull's support along g in double: the best vertex by coordinates from the centre. That
// vertex and any better one are off by 4 units of terms that are at most twice those of the reach,
// since the centre is in the hull's box.
struct BestByScan {
  double operator()(const BoundedShape& body, const Vec3d& g) const {
    const std::uint32_t best = body.support.furthest(g);
    // The last block is padded with the first vertex.
    const std::vector<Vec3d>& vertices = body.shape->hull->vertices;
    return g.dot(vertices[best < vertices.size() ? best : 0]);
  }
};

// The support of a core along g, in body coordinates. `terms` results from |g| and the core's
// reach. If g is off by 8 units of `g_terms`, with at most 6 roundings on the way and 16 units from
// a hull's scan, the value is off by 32 units of `terms`. It is off by 16 if g is off by 3 and a
// hull's vertices are compared in Real.
template <class Real, class HullSupport>
Sum<Real> support(const BoundedShape& body, const Vec3<Real>& g, const Vec3<Real>& g_terms,
                  const HullSupport& hull_support) {
  const Shape& shape = *body.shape;
  Sum<Real> sum;
  sum.terms = g_terms.dot(body.reach.cast<Real>());
  const Real radius = shape.radius, half = shape.half_length;
  const auto across = [&] { return radius * std::sqrt(g.x() * g.x() + g.y() * g.y()); };
  switch (shape.kind) {
    case ShapeKind::sphere:
    case ShapeKind::halfspace: break;
    case ShapeKind::capsule: sum.value = half * std::abs(g.z()); break;
    case ShapeKind::box: sum.value = g.cwiseAbs().dot(body.reach.cast<Real>()); break;
    case ShapeKind::cylinder: sum.value = across() + half * std::abs(g.z()); break;
    case ShapeKind::cone: sum.value = std::max(half * g.z(), across() - half * g.z()); break;
    case ShapeKind::ellipsoid: {
      const Vec3<Real> stretched = g.cwiseProduct(body.reach.cast<Real>());
      sum.value = std::sqrt(stretched.dot(stretched));
      break;
    }
    case ShapeKind::hull: sum.value = hull_support(body, g); break;
  }
  return sum;
}

}  // namespace touchstone
