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
      set_coordinates(s.hull->vertices);
      reach = {x.abs().maxCoeff(), y.abs().maxCoeff(), z.abs().maxCoeff()};
      break;
    case ShapeKind::sphere:
    case ShapeKind::halfspace: break;
  }
}

void BoundedShape::set_coordinates(const std::vector<Vec3d>& vertices) {
  const auto count = static_cast<Eigen::Index>(vertices.size());
  const Eigen::Map<const Eigen::Array3Xd> all(vertices.front().data(), 3, count);
  x = all.row(0);
  y = all.row(1);
  z = all.row(2);
}

double round_down(Wide x) {
  const auto rounded = static_cast<double>(x);
  return rounded > x ? std::nextafter(rounded, -std::numeric_limits<double>::infinity()) : rounded;
}
double round_up(Wide x) { return -round_down(-x); }

void find_furthest(const BoundedShape& hull, const Vec3d& g, Eigen::ArrayXd& values,
                   std::vector<std::uint32_t>& furthest) {
  values = g.x() * hull.x + g.y() * hull.y + g.z() * hull.z;
  const double most = values.maxCoeff<Eigen::PropagateNumbers>();
  // Each value is off by four half units of epsilon of the terms (g's own rounding, products,
  // sums); two values are compared, and half as much covers the bound's own rounding. The last two
  // terms cover underflow.
  const double doubt = 6 * std::numeric_limits<double>::epsilon() * g.cwiseAbs().dot(hull.reach) +
                       std::numeric_limits<double>::min() +
                       std::numeric_limits<double>::denorm_min() * hull.reach.sum();
  furthest.clear();
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    // This form of the comparison keeps NaN.
    if (!(values[i] < most - doubt)) furthest.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace touchstone
