#include "algorithms/kernels/support.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// Where a hull has more vertices than this, climbing along its edges beats looking at all of them.
constexpr std::size_t most_vertices_to_scan = 48;
// Hull vertices are padded to a multiple of this.
constexpr std::size_t lanes = 8;

// The vertex that lies furthest in the direction; of several, the first.
template <class Scalar>
std::uint32_t scan(const SupportShape<Scalar>& hull, const Vec3<Scalar>& d) {
  // Every lane keeps its own best, so that the compiler can keep the lanes in vector registers.
  using Index = std::conditional_t<sizeof(Scalar) == 8, std::int64_t, std::int32_t>;
  Scalar best[lanes];
  Index place[lanes];
  std::fill_n(best, lanes, -std::numeric_limits<Scalar>::infinity());
  std::fill_n(place, lanes, Index{0});
  const Scalar* const x = hull.x.data();
  const Scalar* const y = hull.y.data();
  const Scalar* const z = hull.z.data();
  for (std::size_t i = 0; i < hull.x.size(); i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) {
      const Scalar value = d.x() * x[i + k] + d.y() * y[i + k] + d.z() * z[i + k];
      const bool better = value > best[k];
      best[k] = better ? value : best[k];
      place[k] = better ? static_cast<Index>(i) : place[k];
    }
  }
  std::size_t lane = 0;
  for (std::size_t k = 1; k < lanes; ++k) {
    if (best[k] > best[lane]) lane = k;
  }
  return static_cast<std::uint32_t>(place[lane]) + static_cast<std::uint32_t>(lane);
}

// The same, from vertex to better neighbour. On a convex surface the last one is the best.
template <class Scalar>
std::uint32_t climb(const SupportShape<Scalar>& hull, const Vec3<Scalar>& d, std::uint32_t from) {
  const auto value = [&](std::uint32_t i) {
    return d.x() * hull.x[i] + d.y() * hull.y[i] + d.z() * hull.z[i];
  };
  Scalar best = value(from);
  for (std::uint32_t at = from;;) {
    for (std::uint32_t k = hull.neighbours_begin[at]; k < hull.neighbours_begin[at + 1]; ++k) {
      const Scalar candidate = value(hull.neighbour[k]);
      if (candidate > best) {
        best = candidate;
        from = hull.neighbour[k];
      }
    }
    if (from == at) return at;
    at = from;
  }
}

// The point of the disc of this radius, normal to z, furthest along (dx, dy); its centre where the
// direction is along z.
template <class Scalar>
Vec3<Scalar> disc_support(Scalar radius, const Vec3<Scalar>& d, Scalar z) {
  const Scalar length = std::sqrt(d.x() * d.x() + d.y() * d.y());
  const Scalar factor = length > 0 ? radius / length : Scalar{0};
  return {factor * d.x(), factor * d.y(), z};
}

template <class Scalar>
void prepare_hull(SupportShape<Scalar>& shape, const Hull& hull) {
  const std::vector<Vec3d>& vertices = hull.vertices;
  // The mean is taken relative to the first vertex: exact enough wherever the hull lies.
  Vec3d mean = Vec3d::Zero();
  for (const Vec3d& vertex : vertices) mean += vertex - vertices[0];
  shape.centre = vertices[0] + mean / static_cast<double>(vertices.size());
  for (const Vec3d& vertex : vertices) {
    shape.size = std::max(shape.size, (vertex - shape.centre).stableNorm());
  }
  shape.unit = power_of_two_above(shape.size);

  const std::size_t padded = (vertices.size() + lanes - 1) / lanes * lanes;
  for (std::size_t i = 0; i < padded; ++i) {
    const Vec3d& vertex = vertices[i < vertices.size() ? i : 0];
    const Vec3<Scalar> point = ((vertex - shape.centre) / shape.unit).template cast<Scalar>();
    shape.x.push_back(point.x());
    shape.y.push_back(point.y());
    shape.z.push_back(point.z());
  }

  if (vertices.size() <= most_vertices_to_scan || hull.neighbours.size() != vertices.size()) return;
  const auto has_some = [](const std::vector<std::uint32_t>& list) { return !list.empty(); };
  const auto first = std::find_if(hull.neighbours.begin(), hull.neighbours.end(), has_some);
  if (first == hull.neighbours.end()) return;
  shape.climb_from = static_cast<std::uint32_t>(first - hull.neighbours.begin());
  shape.neighbours_begin.push_back(0);
  for (const std::vector<std::uint32_t>& list : hull.neighbours) {
    shape.neighbour.insert(shape.neighbour.end(), list.begin(), list.end());
    shape.neighbours_begin.push_back(static_cast<std::uint32_t>(shape.neighbour.size()));
  }
}

}  // namespace

double power_of_two_above(double length) {
  // The exponent field, read from the bits: the numbers need no more care than that.
  const auto field = static_cast<int>(std::bit_cast<std::uint64_t>(length) >> 52 & 0x7ff);
  if (field == 0) return 1;
  const int exponent = std::clamp(field + 1, 64, 1982);
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent) << 52);
}

template <class Scalar>
SupportShape<Scalar>::SupportShape(const Shape& shape) {
  const auto set = [&](Core kind, const Vec3d& metres, double greatest_distance) {
    core = kind;
    size = greatest_distance;
    unit = power_of_two_above(size);
    extents = (metres / unit).template cast<Scalar>();
  };
  const Vec3d round{shape.radius, shape.radius, shape.half_length};
  switch (shape.kind) {
    case ShapeKind::sphere: radius = shape.radius; break;
    case ShapeKind::capsule:
      set(Core::segment, {0, 0, shape.half_length}, shape.half_length);
      radius = shape.radius;
      break;
    case ShapeKind::box: set(Core::box, shape.half_extents, shape.half_extents.stableNorm()); break;
    case ShapeKind::cylinder:
      set(Core::cylinder, round, std::hypot(shape.radius, shape.half_length));
      break;
    case ShapeKind::cone:
      set(Core::cone, round, std::hypot(shape.radius, shape.half_length));
      break;
    case ShapeKind::ellipsoid: set(Core::ellipsoid, shape.radii, shape.radii.maxCoeff()); break;
    case ShapeKind::hull:
      core = Core::hull;
      prepare_hull(*this, *shape.hull);
      break;
    case ShapeKind::halfspace:
      core = Core::halfspace;
      normal = shape.normal;
      offset = shape.offset;
      break;
  }
}

template <class Scalar>
std::vector<SupportShape<Scalar>> make_support_shapes(std::span<const Shape> shapes) {
  std::vector<SupportShape<Scalar>> result;
  result.reserve(shapes.size());
  for (const Shape& shape : shapes) result.emplace_back(shape);
  return result;
}

template <class Scalar>
TurnedShape<Scalar>::TurnedShape(const SupportShape<Scalar>& shape, const Mat3d& rotation,
                                 double unit)
    : shape_(&shape),
      matrix_((rotation * (shape.unit / unit)).template cast<Scalar>()),
      radius_(static_cast<Scalar>(shape.radius / unit)),
      vertex_(shape.climb_from) {}

template <class Scalar>
Vec3<Scalar> TurnedShape<Scalar>::support(const Vec3<Scalar>& direction) {
  using Core = typename SupportShape<Scalar>::Core;
  const Vec3<Scalar>& e = shape_->extents;
  if (shape_->core == Core::point) return Vec3<Scalar>::Zero();
  const Vec3<Scalar> d = matrix_.transpose() * direction;
  switch (shape_->core) {
    case Core::segment: return std::copysign(e.z(), d.z()) * matrix_.col(2);
    case Core::box:
      return matrix_ * Vec3<Scalar>{std::copysign(e.x(), d.x()), std::copysign(e.y(), d.y()),
                                    std::copysign(e.z(), d.z())};
    case Core::cylinder: return matrix_ * disc_support(e.x(), d, std::copysign(e.z(), d.z()));
    case Core::cone: {
      // The tip is further than the rim of the base where 2 h dz > r |(dx, dy)|.
      const bool tip = 2 * e.z() * d.z() > e.x() * std::sqrt(d.x() * d.x() + d.y() * d.y());
      return tip ? Vec3<Scalar>(e.z() * matrix_.col(2)) : matrix_ * disc_support(e.x(), d, -e.z());
    }
    case Core::ellipsoid: {
      const Vec3<Scalar> stretched = e.cwiseProduct(d);
      const Scalar length = stretched.norm();
      if (!(length > 0)) return Vec3<Scalar>::Zero();
      return matrix_ * e.cwiseProduct(stretched / length);
    }
    case Core::hull:
      vertex_ = shape_->neighbours_begin.empty() ? scan(*shape_, d) : climb(*shape_, d, vertex_);
      return matrix_ * Vec3<Scalar>{shape_->x[vertex_], shape_->y[vertex_], shape_->z[vertex_]};
    case Core::point:
    case Core::halfspace: break;  // a half-space has no furthest point: see halfspace.h
  }
  return Vec3<Scalar>::Zero();
}

template <class Scalar>
Vec3d centre_offset(const SupportShape<Scalar>& a, const Pose& pose_a,
                    const SupportShape<Scalar>& b, const Pose& pose_b) {
  if (a.centre.isZero(0) && b.centre.isZero(0)) return pose_b.translation - pose_a.translation;
  // Where the vertices of a hull lie far from its origin, its rotated centre must be known to more
  // digits than a double has.
  const auto wide = [](const auto& x) { return x.template cast<long double>(); };
  const Eigen::Matrix<long double, 3, 1> sum =
      (wide(pose_b.rotation) * wide(b.centre) - wide(pose_a.rotation) * wide(a.centre)) +
      (wide(pose_b.translation) - wide(pose_a.translation));
  return sum.template cast<double>();
}

template <class Scalar>
SupportPair<Scalar>::SupportPair(const SupportShape<Scalar>& a, const Pose& pose_a,
                                 const SupportShape<Scalar>& b, const Pose& pose_b)
    : offset_(centre_offset(a, pose_a, b, pose_b)),
      unit_(power_of_two_above(std::max(
          {offset_.cwiseAbs().maxCoeff(), a.reach(pose_a.rotation), b.reach(pose_b.rotation)}))),
      a_(a, pose_a.rotation, unit_),
      b_(b, pose_b.rotation, unit_),
      centre_b_((offset_ / unit_).template cast<Scalar>()),
      origin_(pose_a(a.centre)),
      is_polytope_(a.is_polytope() && b.is_polytope()) {}

template struct SupportShape<float>;
template struct SupportShape<double>;
template class TurnedShape<float>;
template class TurnedShape<double>;
template class SupportPair<float>;
template class SupportPair<double>;
template std::vector<SupportShape<float>> make_support_shapes(std::span<const Shape>);
template std::vector<SupportShape<double>> make_support_shapes(std::span<const Shape>);
template Vec3d centre_offset(const SupportShape<float>&, const Pose&, const SupportShape<float>&,
                             const Pose&);
template Vec3d centre_offset(const SupportShape<double>&, const Pose&, const SupportShape<double>&,
                             const Pose&);

}  // namespace touchstone
