// Part of certified: the bounds of distance_bounds.h, in long double.
#include "algorithms/narrow_phase/certified/distance_bounds.h"

#include <cmath>

#include "algorithms/core/cofactors.h"

namespace touchstone {
namespace {

// Maps a support point in doubles to the point of the body's core that it stands for, relative to
// the body's translation, in world axes. That point is in the core up to 8 units of the core's
// reach.
class CorePoint {
 public:
  CorePoint(const BoundedShape& body, const WideMatrix& matrix,
            const std::vector<std::uint32_t>& furthest)
      : body_(body), matrix_(matrix), furthest_(furthest) {
    const Shape& shape = *body.shape;
    if (shape.kind == ShapeKind::hull) {
      centre_ = matrix * wide(body.support.centre);
    } else if (shape.kind != ShapeKind::sphere) {
      const WideMatrix cofactors = cofactor_matrix<Wide>(matrix);
      inverse_ = cofactors.transpose() / matrix.row(0).dot(cofactors.row(0));
    }
  }

  // `point` is relative to the core's centre: metres, world axes.
  Wide3 operator()(const Vec3d& point) const {
    const Shape& shape = *body_.shape;
    if (shape.kind == ShapeKind::sphere) return Wide3::Zero();
    if (shape.kind == ShapeKind::hull) return nearest_vertex(wide(point) + centre_);
    return matrix_ * on_surface(shape, inverse_ * wide(point));
  }

 private:
  Wide3 nearest_vertex(const Wide3& point) const {
    Wide3 best = Wide3::Constant(std::numeric_limits<Wide>::quiet_NaN());
    Wide least = std::numeric_limits<Wide>::infinity();
    for (const std::uint32_t i : furthest_) {
      const Wide3 vertex = matrix_ * wide(body_.shape->hull->vertices[i]);
      const Wide square = (vertex - point).squaredNorm();
      if (!(square < least)) continue;
      least = square;
      best = vertex;
    }
    return best;
  }

  static Wide3 on_surface(const Shape& shape, const Wide3& p) {
    const Wide radius = shape.radius, half = shape.half_length;
    switch (shape.kind) {
      case ShapeKind::capsule: return {0, 0, std::copysign(half, p.z())};
      case ShapeKind::box:
        return {std::copysign(Wide{shape.half_extents.x()}, p.x()),
                std::copysign(Wide{shape.half_extents.y()}, p.y()),
                std::copysign(Wide{shape.half_extents.z()}, p.z())};
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
  const WideMatrix& matrix_;
  const std::vector<std::uint32_t>& furthest_;
  WideMatrix inverse_;
  Wide3 centre_;
};

}  // namespace

DistanceBounds DistanceBounder::between(const BoundedShape& a, const Pose& pose_a,
                                        const BoundedShape& b, const Pose& pose_b,
                                        const SupportPair<double>& pair,
                                        const Simplex<double>& simplex, const Vec3d& normal) {
  DistanceBounds gap;
  if (!is_wide) return gap;
  const WideMatrix matrix_a = pose_a.rotation.cast<Wide>(), matrix_b = pose_b.rotation.cast<Wide>();
  const WideMatrix size_a = matrix_a.cwiseAbs(), size_b = matrix_b.cwiseAbs();
  const Wide3 offset = wide(pose_b.translation) - wide(pose_a.translation);
  const Wide radii = Wide{a.support.radius} + Wide{b.support.radius};

  const auto prove_lower = [&](const Wide3& n) {
    const Wide3 n_size = n.cwiseAbs();
    const auto of_a = support<Wide>(a, matrix_a.transpose() * n, size_a.transpose() * n_size,
                                    AllThatMayBe(values_, furthest_a_));
    const auto of_b = support<Wide>(b, matrix_b.transpose() * -n, size_b.transpose() * n_size,
                                    AllThatMayBe(values_, furthest_b_));
    // The offset's product is off by 4 units, the supports by 16; the sums add 2.
    const Wide along = n.dot(offset) - of_a.value - of_b.value;
    const Wide terms = n_size.dot(offset.cwiseAbs()) + of_a.terms + of_b.terms;
    // The norm, the quotient and the radii are each off by at most 8 units.
    const Wide apart = (along - 20 * wide_unit * terms) / std::sqrt(n.dot(n));
    const Wide lower = apart - radii - 8 * wide_unit * (std::abs(apart) + radii);
    if (lower > gap.lower) gap.lower = round_down(lower);
  };
  prove_lower(wide(normal));
  if (simplex.size == 0 || simplex.size == 4) return gap;

  const CorePoint core_a(a, matrix_a, furthest_a_), core_b(b, matrix_b, furthest_b_);
  Wide3 sum = Wide3::Zero();
  Wide weights = 0;
  for (int i = 0; i < simplex.size; ++i) {
    const Wide weight = simplex.weights[i];
    if (!(weight >= 0)) return gap;
    const Wide3 p = core_a(pair.unit() * simplex.points[i].a);
    const Wide3 q = core_b(pair.unit() * (simplex.points[i].b - pair.centre_b()));
    sum += weight * ((q - p) + offset);
    weights += weight;
  }
  // Errors of each weighted term: 8 units for the point, 3 in the product, 3 in the differences, 5
  // in the sum. The quotient by the weights and the norm are accurate to 8 units of the whole.
  const Wide reach = (size_a * wide(a.reach) + size_b * wide(b.reach) + offset.cwiseAbs()).sum();
  const Wide length = sum.norm() / weights;
  const Wide near = length + 32 * wide_unit * reach;
  const Wide upper = near - radii + 8 * wide_unit * (near + radii);
  if (upper < std::numeric_limits<Wide>::infinity()) gap.upper = round_up(upper);
  // The connection of bodies far apart is a better normal than one in doubles.
  const double fine = 2 * std::numeric_limits<double>::epsilon() * static_cast<double>(length);
  if (gap.upper - gap.lower > fine && length > Wide{1e-3} * reach) prove_lower(sum);
  return gap;
}

}  // namespace touchstone
