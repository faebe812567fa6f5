// Part of certified: the core's extents and the vertices that may support a hull.
#include "algorithms/narrow_phase/certified/support_bounds.h"

namespace touchstone {

BoundedShape::BoundedShape(const Shape& s) : shape(&s), support(s), reach(Vec3d::Zero()) {
  switch (s.kind) {
    case ShapeKind::capsule: reach.z() = s.half_length; break;
    case ShapeKind::box: reach = s.half_extents; break;
    case ShapeKind::cylinder:
    case ShapeKind::cone: reach = {s.radius, s.radius, s.half_length}; break;
    case ShapeKind::ellipsoid: reach = s.radii; break;
    case ShapeKind::hull:
      for (const Vec3d& v : s.hull->vertices) reach = reach.cwiseMax(v.cwiseAbs());
      break;
    case ShapeKind::sphere:
    case ShapeKind::halfspace: break;
  }
}

double round_down(Wide x) {
  const auto rounded = static_cast<double>(x);
  return rounded > x ? std::nextafter(rounded, -std::numeric_limits<double>::infinity()) : rounded;
}
double round_up(Wide x) { return -round_down(-x); }

// Lists every vertex that may be furthest along g, given the rounding of doubles. It may list
// others.
void find_furthest(const std::vector<Vec3d>& vertices, const Vec3d& g, const Vec3d& reach,
                   std::vector<double>& values, std::vector<std::uint32_t>& furthest) {
  values.resize(vertices.size());
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3d& v = vertices[i];
    values[i] = g.x() * v.x() + g.y() * v.y() + g.z() * v.z();
    most = std::max(most, values[i]);
  }
  // Each value is off by four half units of epsilon of the terms (g's own rounding, products,
  // sums); two values are compared, and half as much covers the bound's own rounding. The last two
  // terms cover underflow.
  const double doubt = 6 * std::numeric_limits<double>::epsilon() * g.cwiseAbs().dot(reach) +
                       std::numeric_limits<double>::min() +
                       std::numeric_limits<double>::denorm_min() * reach.sum();
  furthest.clear();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    // This form of the comparison keeps NaN.
    if (!(values[i] < most - doubt)) furthest.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace touchstone
