#include "algorithms/kernels/proven_gap.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

using Wide = long double;
using Wide3 = Vec3<Wide>;
using WideMatrix = Mat3<Wide>;

// Half a unit in the last place of 1. Products of a dozen doubles neither overflow nor vanish where
// the exponents are those of x87 or wider.
constexpr Wide unit = std::numeric_limits<Wide>::epsilon() / 2;
constexpr bool is_wide = std::numeric_limits<Wide>::max_exponent >= 16384;

Wide3 wide(const Vec3d& x) { return x.cast<Wide>(); }

double round_down(Wide x) {
  const auto rounded = static_cast<double>(x);
  return rounded > x ? std::nextafter(rounded, -std::numeric_limits<double>::infinity()) : rounded;
}
double round_up(Wide x) { return -round_down(-x); }

// A number, and what all its terms come to where nothing cancels: it is off by a few units of that.
struct Sum {
  Wide value = 0, terms = 0;
};

// The vertices that are furthest along g up to the rounding of doubles, and some that are not.
void find_furthest(const std::vector<Vec3d>& vertices, const Vec3d& g, const Vec3d& reach,
                   std::vector<double>& values, std::vector<std::uint32_t>& furthest) {
  values.resize(vertices.size());
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3d& v = vertices[i];
    values[i] = g.x() * v.x() + g.y() * v.y() + g.z() * v.z();
    most = std::max(most, values[i]);
  }
  // Each is off by four half units of epsilon of the terms (g's own rounding, products, sums), two
  // are compared, and half as much is for the bound's own rounding. Then what vanishes.
  const double doubt = 6 * std::numeric_limits<double>::epsilon() * g.cwiseAbs().dot(reach) +
                       std::numeric_limits<double>::min() +
                       std::numeric_limits<double>::denorm_min() * reach.sum();
  furthest.clear();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    // So written that NaN counts.
    if (!(values[i] < most - doubt)) furthest.push_back(static_cast<std::uint32_t>(i));
  }
}

// The support of a core along g, body coordinates; `terms` is for |g| and the core's reach. With g
// off by 3 units of `g_terms` and at most 6 roundings on the way, it is off by 10 units of `terms`.
Sum support(const ProvenShape& body, const Wide3& g, const Wide3& g_terms,
            std::vector<double>& values, std::vector<std::uint32_t>& furthest) {
  const Shape& shape = *body.shape;
  Sum sum;
  sum.terms = g_terms.dot(wide(body.reach));
  const Wide radius = shape.radius, half = shape.half_length;
  switch (shape.kind) {
    case ShapeKind::sphere:
    case ShapeKind::halfspace: break;
    case ShapeKind::capsule: sum.value = half * std::abs(g.z()); break;
    case ShapeKind::box: sum.value = g.cwiseAbs().dot(wide(shape.half_extents)); break;
    case ShapeKind::cylinder:
      sum.value = radius * std::sqrt(g.x() * g.x() + g.y() * g.y()) + half * std::abs(g.z());
      break;
    case ShapeKind::cone:
      sum.value =
          std::max(half * g.z(), radius * std::sqrt(g.x() * g.x() + g.y() * g.y()) - half * g.z());
      break;
    case ShapeKind::ellipsoid: {
      const Wide3 stretched = g.cwiseProduct(wide(shape.radii));
      sum.value = std::sqrt(stretched.dot(stretched));
      break;
    }
    case ShapeKind::hull: {
      const std::vector<Vec3d>& vertices = shape.hull->vertices;
      find_furthest(vertices, g.cast<double>(), body.reach, values, furthest);
      sum.value = -std::numeric_limits<Wide>::infinity();
      for (const std::uint32_t i : furthest) {
        sum.value = std::max(sum.value, g.dot(wide(vertices[i])));
      }
      break;
    }
  }
  return sum;
}

// The point of a body's core, relative to the body's translation and world axes, that a support
// point in doubles stands for. It is in the core up to 8 units of the core's reach.
class CorePoint {
 public:
  CorePoint(const ProvenShape& body, const WideMatrix& matrix, const Vec3d& centre,
            const std::vector<std::uint32_t>& furthest)
      : body_(body), matrix_(matrix), furthest_(furthest) {
    const Shape& shape = *body.shape;
    if (shape.kind == ShapeKind::hull) {
      centre_ = matrix * wide(centre);
    } else if (shape.kind != ShapeKind::sphere) {
      const WideMatrix cofactors = cofactor_matrix(matrix);
      inverse_ = cofactors.transpose() / matrix.row(0).dot(cofactors.row(0));
    }
  }

  static WideMatrix cofactor_matrix(const WideMatrix& m) {
    WideMatrix cofactors;
    cofactors.row(0) = m.row(1).cross(m.row(2));
    cofactors.row(1) = m.row(2).cross(m.row(0));
    cofactors.row(2) = m.row(0).cross(m.row(1));
    return cofactors;
  }

  // `point`: from the core's centre, metres, world axes.
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

  const ProvenShape& body_;
  const WideMatrix& matrix_;
  const std::vector<std::uint32_t>& furthest_;
  WideMatrix inverse_;
  Wide3 centre_;
};

}  // namespace

ProvenShape::ProvenShape(const Shape& s) : shape(&s), reach(Vec3d::Zero()) {
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

namespace {

// The radius of the ball around a core.
Wide ball_of(const Shape& shape) {
  const bool has_one = shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::capsule;
  return has_one ? shape.radius : 0;
}

}  // namespace

ProvenGap GapProver::between(const ProvenShape& a, const Pose& pose_a, const ProvenShape& b,
                             const Pose& pose_b, const Vec3d& direction,
                             const SupportPair<double>& pair, const Simplex<double>& simplex,
                             const Vec3d& centre_a, const Vec3d& centre_b) {
  ProvenGap gap;
  if (!is_wide) return gap;
  const Wide3 n = wide(direction), n_size = n.cwiseAbs();
  const WideMatrix matrix_a = pose_a.rotation.cast<Wide>(), matrix_b = pose_b.rotation.cast<Wide>();
  const WideMatrix size_a = matrix_a.cwiseAbs(), size_b = matrix_b.cwiseAbs();
  const Wide3 offset = wide(pose_b.translation) - wide(pose_a.translation);
  const Wide radii = ball_of(*a.shape) + ball_of(*b.shape);

  // The gap along n: its offset (1 rounding, 3 in the product), less both supports (10), summed
  // (2).
  const Sum of_a =
      support(a, matrix_a.transpose() * n, size_a.transpose() * n_size, values_, furthest_a_);
  const Sum of_b =
      support(b, matrix_b.transpose() * -n, size_b.transpose() * n_size, values_, furthest_b_);
  const Wide along = n.dot(offset) - of_a.value - of_b.value;
  const Wide terms = n_size.dot(offset.cwiseAbs()) + of_a.terms + of_b.terms;
  // The norm, the quotient and the radii: 8 units of each.
  const Wide apart = (along - 16 * unit * terms) / std::sqrt(n.dot(n));
  const Wide lower = apart - radii - 8 * unit * (std::abs(apart) + radii);
  if (lower > -std::numeric_limits<Wide>::infinity()) gap.lower = round_down(lower);
  if (simplex.size == 0 || !(simplex.size < 4)) return gap;

  const CorePoint core_a(a, matrix_a, centre_a, furthest_a_);
  const CorePoint core_b(b, matrix_b, centre_b, furthest_b_);
  Wide3 sum = Wide3::Zero();
  Wide weights = 0;
  for (int i = 0; i < simplex.size; ++i) {
    const Wide weight = simplex.weights[i];
    if (!(weight >= 0)) return gap;
    const Wide3 p = core_a(pair.unit() * simplex.points[i].a);
    const Wide3 q = core_b(pair.unit() * (simplex.points[i].b - pair.centre_b()));
    sum += weight * ((p - q) - offset);
    weights += weight;
  }
  // Of each weighted term: 8 units for the point, 3 in the product, 3 in the differences, 5 in the
  // sum; the quotient by the weights and the norm are good to 8 of the whole, which is less.
  const Wide reach = (size_a * wide(a.reach) + size_b * wide(b.reach) + offset.cwiseAbs()).sum();
  const Wide near = sum.norm() / weights + 32 * unit * reach;
  const Wide upper = near - radii + 8 * unit * (near + radii);
  if (upper < std::numeric_limits<Wide>::infinity()) gap.upper = round_up(upper);
  return gap;
}

ProvenGap GapProver::above_plane(const ProvenShape& a, const Pose& pose_a, const ProvenShape& b,
                                 const Pose& pose_b, Vec3d& normal) {
  ProvenGap gap;
  if (!is_wide) return gap;
  // The moved half-space is m . (x - t) <= offset |det M| with m = +-cof(M) n: what maps planes to
  // planes is the inverse transpose.
  const WideMatrix matrix = pose_b.rotation.cast<Wide>(), size = matrix.cwiseAbs();
  const WideMatrix cofactors = CorePoint::cofactor_matrix(matrix);
  WideMatrix cofactor_terms;
  for (int i = 0; i < 3; ++i) {
    const auto &p = size.row((i + 1) % 3), &q = size.row((i + 2) % 3);
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      cofactor_terms(i, k) = p[l] * q[m] + p[m] * q[l];
    }
  }
  // Cofactors are off by 2 units of their terms, the determinant and m by 5 of theirs.
  const Wide determinant = matrix.row(0).dot(cofactors.row(0));
  const Wide determinant_terms = size.row(0).dot(cofactor_terms.row(0));
  if (!(std::abs(determinant) > 8 * unit * determinant_terms)) return gap;
  const Wide3 n = wide(b.shape->normal);
  Wide3 m = cofactors * n;
  if (determinant < 0) m = -m;
  const Wide3 m_terms = cofactor_terms * n.cwiseAbs();

  const WideMatrix matrix_a = pose_a.rotation.cast<Wide>();
  const Wide3 offset = wide(pose_a.translation) - wide(pose_b.translation);
  const Sum lowest = support(a, matrix_a.transpose() * -m,
                             matrix_a.cwiseAbs().transpose() * m_terms, values_, furthest_a_);
  const Wide height = b.shape->offset;
  const Wide value = m.dot(offset) - lowest.value - height * std::abs(determinant);
  const Wide terms =
      m_terms.dot(offset.cwiseAbs()) + lowest.terms + std::abs(height) * determinant_terms;
  // m is off by 5 units, which its products with the offset (4), the core (10) and the rest (2 for
  // the sum, 6 for the offset's determinant) add to.
  const Wide length = std::sqrt(m.dot(m));
  const Wide of_length = 8 * unit * m_terms.sum() / length;
  if (!(of_length < Wide{0x1p-32})) return gap;
  const Wide radius = ball_of(*a.shape);
  const Wide core = value / length;
  const Wide doubt = 32 * unit * terms / length * (1 + 2 * of_length) +
                     std::abs(core) * (2 * of_length + 8 * unit) + 8 * unit * radius;
  normal = (m / length).cast<double>();
  const Wide distance = core - radius;
  if (!(doubt < std::numeric_limits<Wide>::infinity())) return gap;
  gap.lower = round_down(distance - doubt - 2 * unit * std::abs(distance));
  gap.upper = round_up(distance + doubt + 2 * unit * std::abs(distance));
  return gap;
}

}  // namespace touchstone
