// Part of certified: the bounds of distance_bounds.h, in long double.
#include "algorithms/narrow_phase/certified/distance_bounds.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/cofactors.h"
#include "algorithms/narrow_phase/certified/enclosure.h"

namespace touchstone {
namespace {

// Maps a support point in doubles to the point of the body's core that it stands for, relative to
// the body's translation, in world axes. That point is in the core up to 8 units of the core's
// reach.
class CorePoint {
 public:
  CorePoint(const BoundedShape& body, const Mat3d& rotation, const WideMatrix& matrix,
            const std::vector<std::uint32_t>& furthest)
      : body_(body), rotation_(rotation), matrix_(matrix), furthest_(furthest) {
    const Shape& shape = *body.shape;
    if (shape.kind == ShapeKind::hull) {
      centre_ = rotation * body.support.centre;
    } else if (shape.kind == ShapeKind::box || shape.kind == ShapeKind::capsule) {
      const Mat3d cofactors = cofactor_matrix(rotation);
      to_signs_ = std::copysign(1.0, rotation.row(0).dot(cofactors.row(0))) * cofactors.transpose();
    } else if (shape.kind != ShapeKind::sphere) {
      const WideMatrix cofactors = cofactor_matrix(matrix);
      to_body_ =
          std::copysign(Wide{1}, matrix.row(0).dot(cofactors.row(0))) * cofactors.transpose();
    }
  }

  // `point` is relative to the core's centre: metres, world axes.
  Wide3 operator()(const Vec3d& point) const {
    const Shape& shape = *body_.shape;
    if (shape.kind == ShapeKind::sphere) return Wide3::Zero();
    if (shape.kind == ShapeKind::hull) return nearest_vertex(point + centre_);
    if (shape.kind == ShapeKind::box || shape.kind == ShapeKind::capsule) {
      return matrix_ * corner(shape, to_signs_ * point);
    }
    return matrix_ * on_surface(shape, to_body_ * wide(point));
  }

 private:
  // The vertex at a place that is off by rounding: looked for where the support is, and then, for
  // corners of faces that are not along its direction, among all.
  Wide3 nearest_vertex(const Vec3d& point) const {
    const std::vector<Vec3d>& vertices = body_.shape->hull->vertices;
    const auto off = [&](const Vec3d& vertex) {
      return (rotation_ * vertex - point).squaredNorm();
    };
    const double near = 2e-14 * body_.support.size;
    for (const std::uint32_t i : furthest_) {
      if (off(vertices[i]) <= near * near) return matrix_ * wide(vertices[i]);
    }
    return matrix_ * wide(*std::ranges::min_element(vertices, {}, off));
  }

  static Wide3 corner(const Shape& shape, const Vec3d& signs) {
    if (shape.kind == ShapeKind::capsule)
      return {0, 0, std::copysign(shape.half_length, signs.z())};
    return {std::copysign(shape.half_extents.x(), signs.x()),
            std::copysign(shape.half_extents.y(), signs.y()),
            std::copysign(shape.half_extents.z(), signs.z())};
  }

  // `p`: the point in body coordinates, in any length.
  static Wide3 on_surface(const Shape& shape, const Wide3& p) {
    const Wide radius = shape.radius, half = shape.half_length;
    switch (shape.kind) {
      case ShapeKind::cylinder: return on_rim(radius, p, std::copysign(half, p.z()));
      case ShapeKind::cone: return p.z() > 0 ? Wide3{0, 0, half} : on_rim(radius, p, -half);
      case ShapeKind::ellipsoid: {
        Wide3 round = Wide3::Zero();
        for (int k = 0; k < 3; ++k) {
          if (shape.radii[k] > 0) round[k] = p[k] / shape.radii[k];
        }
        const Wide length = std::sqrt(round.dot(round));
        if (!(length > 0)) return Wide3::Zero();
        return wide(shape.radii).cwiseProduct(Wide3(round / length));
      }
      default: return Wide3::Zero();
    }
  }

  static Wide3 on_rim(Wide radius, const Wide3& p, Wide z) {
    const Wide length = std::sqrt(p.x() * p.x() + p.y() * p.y());
    if (!(length > 0)) return {0, 0, z};
    return {radius * (p.x() / length), radius * (p.y() / length), z};
  }

  const BoundedShape& body_;
  const Mat3d& rotation_;
  const WideMatrix& matrix_;
  const std::vector<std::uint32_t>& furthest_;
  WideMatrix to_body_;              // a positive multiple of the inverse
  Mat3d to_signs_ = Mat3d::Zero();  // the same in doubles, for cores with corners alone
  Vec3d centre_ = Vec3d::Zero();
};

}  // namespace

// The poses of a pair in long double.
struct WidePair {
  WidePair(const BoundedShape& body_a, const Pose& pose_a, const BoundedShape& body_b,
           const Pose& pose_b)
      : a(body_a),
        b(body_b),
        matrix_a(pose_a.rotation.cast<Wide>()),
        matrix_b(pose_b.rotation.cast<Wide>()),
        size_a(matrix_a.cwiseAbs()),
        size_b(matrix_b.cwiseAbs()),
        offset(wide(pose_b.translation) - wide(pose_a.translation)),
        radii(Wide{body_a.support.radius} + Wide{body_b.support.radius}) {}

  const BoundedShape &a, &b;
  WideMatrix matrix_a, matrix_b, size_a, size_b;  // the sizes have the magnitudes
  Wide3 offset;
  Wide radii;
};

// Returns a lower bound on the signed distance: that along n, of any length.
double DistanceBounder::bound_along(const WidePair& pair, const Wide3& n) {
  const Wide3 n_size = n.cwiseAbs();
  const auto of_a =
      support<Wide>(pair.a, pair.matrix_a.transpose() * n, pair.size_a.transpose() * n_size,
                    AllThatMayBe(values_, furthest_a_));
  const auto of_b =
      support<Wide>(pair.b, pair.matrix_b.transpose() * -n, pair.size_b.transpose() * n_size,
                    AllThatMayBe(values_, furthest_b_));
  // The offset's product is off by 4 units, the supports by 16; the sums add 2.
  const Wide along = n.dot(pair.offset) - of_a.value - of_b.value;
  const Wide terms = n_size.dot(pair.offset.cwiseAbs()) + of_a.terms + of_b.terms;
  // The norm, the quotient and the radii are each off by at most 8 units.
  const Wide apart = (along - 20 * wide_unit * terms) / std::sqrt(n.dot(n));
  return round_down(apart - pair.radii - 8 * wide_unit * (std::abs(apart) + pair.radii));
}

DistanceBounds DistanceBounder::between(const BoundedShape& a, const Pose& pose_a,
                                        const BoundedShape& b, const Pose& pose_b,
                                        const SupportPair<double>& pair,
                                        const Simplex<double>& simplex, const Vec3d& normal) {
  DistanceBounds gap;
  if (!is_wide) return gap;
  const WidePair exact(a, pose_a, b, pose_b);
  const auto prove_lower = [&](const Wide3& n) {
    const double lower = bound_along(exact, n);
    if (lower > gap.lower) gap.lower = lower;
  };
  prove_lower(wide(normal));
  if (simplex.size == 0 || simplex.size == 4) return gap;

  const CorePoint core_a(a, pose_a.rotation, exact.matrix_a, furthest_a_);
  const CorePoint core_b(b, pose_b.rotation, exact.matrix_b, furthest_b_);
  Wide3 sum = Wide3::Zero();
  Wide weights = 0;
  for (int i = 0; i < simplex.size; ++i) {
    const Wide weight = simplex.weights[i];
    if (!(weight >= 0)) return gap;
    const Wide3 p = core_a(pair.unit() * simplex.points[i].a);
    const Wide3 q = core_b(pair.unit() * (simplex.points[i].b - pair.centre_b()));
    sum += weight * ((q - p) + exact.offset);
    weights += weight;
  }
  // Errors of each weighted term: 8 units for the point, 3 in the product, 3 in the differences, 5
  // in the sum. The quotient by the weights and the norm are accurate to 8 units of the whole.
  const Wide reach =
      (exact.size_a * wide(a.reach) + exact.size_b * wide(b.reach) + exact.offset.cwiseAbs()).sum();
  const Wide length = sum.norm() / weights;
  const Wide near = length + 32 * wide_unit * reach;
  const Wide upper = near - exact.radii + 8 * wide_unit * (near + exact.radii);
  if (upper < std::numeric_limits<Wide>::infinity()) gap.upper = round_up(upper);
  // The connection of bodies far apart is a better normal than one in doubles.
  const double fine = 2 * std::numeric_limits<double>::epsilon() * static_cast<double>(length);
  if (gap.upper - gap.lower > fine && length > Wide{1e-3} * reach) prove_lower(sum);
  return gap;
}

// A ball around the origin that no face of a surface around it reaches into is inside of it.
DistanceBounds DistanceBounder::inside(const BoundedShape& a, const Pose& pose_a,
                                       const BoundedShape& b, const Pose& pose_b,
                                       const SupportPair<double>& pair,
                                       const EpaHull<double>& surface, const Vec3d& normal) {
  DistanceBounds gap;
  if (!is_wide) return gap;
  const WidePair exact(a, pose_a, b, pose_b);
  gap.lower = bound_along(exact, wide(normal));
  const CorePoint core_a(a, pose_a.rotation, exact.matrix_a, furthest_a_);
  const CorePoint core_b(b, pose_b.rotation, exact.matrix_b, furthest_b_);
  const double unit = pair.unit(), deepest = -gap.lower / unit;
  const Wide reach =
      (exact.size_a * wide(a.reach) + exact.size_b * wide(b.reach) + exact.offset.cwiseAbs()).sum();
  // The distance of a face's triangle along its normal is that of its nearest corner.
  Wide least = std::numeric_limits<Wide>::infinity();
  Wide3 best = Wide3::Zero();
  const bool encloses = surface.all_faces([&](int face) {
    const std::array<int, 3> corners = surface.corners(face);
    const std::array<Vec3d, 3> points = surface.points(corners);
    const bool surely_behind = is_surely_behind(points);
    const Vec3d n = surface.normal(face);
    const double height =
        std::min({n.dot(points[0]), n.dot(points[1]), n.dot(points[2])}) - proven_rounding;
    if (surely_behind && height >= deepest) return true;
    std::array<Wide3, 3> exactly;
    for (std::size_t k = 0; k < 3; ++k) {
      const DifferencePoint<double>& corner = surface.vertex(corners[k]);
      const Wide3 difference =
          core_a(unit * corner.a) - (core_b(unit * (corner.b - pair.centre_b())) + exact.offset);
      // Only the corner itself will do: it is off by less than this.
      const Wide3 off = difference / Wide{unit} - wide(points[k]);
      if (!(off.squaredNorm() <= Wide{0.25 * proven_rounding * proven_rounding})) return false;
      exactly[k] = difference;
    }
    if (!surely_behind && !is_surely_behind(exactly, 16 * wide_unit * reach)) return false;
    // The face's own normal, unless it has no area.
    Wide3 along = (exactly[1] - exactly[0]).cross(exactly[2] - exactly[0]);
    if (!(along.norm() > Wide{1e-6} * Wide{unit} * Wide{unit})) along = wide(n);
    const Wide height_of_face =
        std::min({along.dot(exactly[0]), along.dot(exactly[1]), along.dot(exactly[2])}) /
        along.norm();
    // The points are off by 16 units of the reach, the product and the quotient by 8.
    const Wide lowest = height_of_face - 32 * wide_unit * reach;
    if (lowest < least) {
      least = lowest;
      best = along;
    }
    return true;
  });
  // The nearest face is one of those that were looked at.
  if (!encloses || least == std::numeric_limits<Wide>::infinity()) return gap;
  // The support along that face's exact normal is a better bound than along the one in doubles.
  if (!best.isZero(0)) gap.lower = std::max(gap.lower, bound_along(exact, best));
  gap.upper = std::max(round_up(-least), gap.lower);
  return gap;
}

}  // namespace touchstone
