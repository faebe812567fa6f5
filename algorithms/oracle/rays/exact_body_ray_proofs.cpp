// The exact cast says which part is hit, and about when. Brackets around that are tried, the narrowest first,
// as the check will try them: each step is decided in rationals before it is written.
#include "algorithms/oracle/rays/exact_body_ray_proofs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/oracle/certificates/parts/triangle_tests.h"
#include "algorithms/oracle/concave/group_plane.h"
#include "algorithms/oracle/concave/rounded_part.h"
#include "algorithms/scene_ray_cast.h"

namespace touchstone::entries {
std::vector<SceneRayCastEntry> oracle_exact_scene_ray_cast();
}  // namespace touchstone::entries

namespace touchstone::oracle {
namespace {

using Kind = BodyRayCertificate::Step::Kind;

// Brackets reach so many bits of the time around it.
constexpr std::array bits_of_brackets = {52, 50, 47, 44, 40, 36, 32, 28, 24, 20};

Integer integer(const mpz_class& x) { return Integer(x.get_str()); }

TimeFraction fraction(const mpq_class& t) { return {integer(t.get_num()), integer(t.get_den())}; }

// A multiple of the vector.
IntegerVector multiple(const RationalVector& v) {
  mpz_class common = lcm(lcm(v[0].get_den(), v[1].get_den()), v[2].get_den());
  IntegerVector whole;
  for (std::size_t k = 0; k < 3; ++k) whole[k] = integer(mpq_class(v[k] * common).get_num());
  return whole;
}

Vec3d rounded_vector(const RationalVector& v) { return {v[0].get_d(), v[1].get_d(), v[2].get_d()}; }

// The direction, or, if that does not do for a ray without end, the one next to it that is across the ray.
template <class Parts>
std::optional<IntegerVector> parting(const IntegerVector& direction, const RaySpan& span,
                                     const Parts& is_parted) {
  const RationalVector n = rational_vector(direction);
  if (is_zero(n)) return {};
  if (is_parted(n)) return direction;
  const RationalVector across =
      n - dot(n, span.direction) / dot(span.direction, span.direction) * span.direction;
  if (span.end || is_zero(across) || !is_parted(across)) return {};
  return multiple(across);
}

}  // namespace

struct BodyRayProver::Solver {
  std::vector<SceneBody> bodies;
  std::unique_ptr<SceneRayCast> cast = entries::oracle_exact_scene_ray_cast().front().make();
};

BodyRayProver::BodyRayProver(const ConcaveBody& body, const Pose& pose)
    : body_(body),
      pose_(pose),
      parts_(body, pose),
      order_(spatial_order(parts_.boxes())),
      tree_(order_, parts_.boxes()),
      solver_(std::make_unique<Solver>()) {
  solver_->bodies = {{body, pose}};
  solver_->cast->bind(solver_->bodies);
}

BodyRayProver::~BodyRayProver() = default;

std::optional<BodyRayCertificate> BodyRayProver::prove(const Vec3d& origin, const Vec3d& direction,
                                                       double t_max, bool is_first) {
  const Ray ray = {origin, direction, t_max};
  SceneRayHit hit;
  solver_->cast->cast(is_first ? RayTask::closest : RayTask::any, {&ray, 1}, {&hit, 1});
  if (hit.status == Status::degenerate || parts_.is_rounded()) return {};
  BodyRayCertificate certificate;
  certificate.origin = origin;
  certificate.direction = direction;
  certificate.t_max = t_max;
  certificate.is_first = is_first;
  RaySpan span{rational_vector(origin), rational_vector(direction), {}};
  if (hit.hit) {
    certificate.part = hit.part;
    const bool has_upper = write_upper(span, hit.t, certificate);
    if (!has_upper) certificate.part = 0;
    certificate.answer = has_upper ? CastAnswer::hit : CastAnswer::unknown;
    if (is_first || !has_upper) write_lower(span, hit.t, has_upper, certificate);
    return certificate;
  }
  if (hit.status != Status::ok) return certificate;
  certificate.answer = CastAnswer::miss;
  if (std::isfinite(t_max)) span.end = rational(t_max);
  if (span.end && *span.end < 0) return certificate;
  if (!write_cover(span, certificate)) certificate.answer = CastAnswer::unknown;
  return certificate;
}

// The time at which the ray is first in a triangle or a half-space; of others, the one that was found.
mpq_class BodyRayProver::exact_time(const RaySpan& ray, std::uint32_t part, double t) const {
  if (const auto triangle = triangle_of(parts_, part)) {
    const auto first = first_time(ray.origin, ray.direction, *triangle);
    if (first) return *first;
  }
  const RationalCore core = parts_.core(part);
  if (core.is_halfspace() && !is_zero(core.normal())) {
    const mpq_class height = dot(core.normal(), ray.origin) - *core.support(core.normal());
    const mpq_class fall = -dot(core.normal(), ray.direction);
    if (height <= 0) return 0;
    if (fall > 0) return height / fall;
  }
  return rational(t);
}

bool BodyRayProver::write_upper(const RaySpan& ray, double t, BodyRayCertificate& certificate) {
  const std::uint32_t part = certificate.part;
  std::vector<mpq_class> times = {exact_time(ray, part, t)};
  const mpq_class about = rational(t);
  for (const int bits : bits_of_brackets) {
    times.push_back(about + about / mpq_class(mpz_class(1) << static_cast<mp_bitcnt_t>(bits)));
  }
  Shape shape;  // a point
  const Solid point(shape);
  for (mpq_class& time : times) {
    if (std::isfinite(certificate.t_max)) time = std::min(time, rational(certificate.t_max));
    const RationalVector at = ray.at(time);
    certificate.generators.clear();
    certificate.surface = {};
    const Solid& solid = parts_.solid(part);
    if (solid.core == Solid::Core::polytope && solid.vertices.size() > 3 && !solid.is_box) {
      Certificate found;
      const Body a(point, Pose{Mat3d::Identity(), rounded_vector(at)}),
          b = rounded_part(parts_, body_, pose_, part);
      if (!a.is_finite() || !b.is_finite()) continue;
      oracle_.prove(a, b, found);
      certificate.generators = found.b;
      certificate.surface = found.surface;
    }
    try {
      if (!has_point(parts_, part, at, certificate.generators, certificate.surface)) continue;
      certificate.upper = fraction(time);
      return true;
    } catch (const Fault&) {
      continue;
    }
  }
  certificate.generators.clear();
  certificate.surface = {};
  return false;
}

void BodyRayProver::write_lower(const RaySpan& ray, double t, bool tries_upper,
                                BodyRayCertificate& certificate) {
  const mpq_class about = rational(t);
  std::vector<mpq_class> times;
  if (tries_upper) {
    times.push_back(rational(certificate.upper.numerator) /
                    rational(certificate.upper.denominator));
  }
  for (const int bits : bits_of_brackets) {
    times.push_back(about - about / mpq_class(mpz_class(1) << static_cast<mp_bitcnt_t>(bits)));
  }
  for (const mpq_class& time : times) {
    RaySpan span = ray;
    span.end = time;
    span.is_closed = false;
    if (time > 0 && !write_cover(span, certificate)) continue;
    certificate.lower = fraction(time);
    return;
  }
}

bool BodyRayProver::write_cover(const RaySpan& span, BodyRayCertificate& certificate) {
  certificate.cover.clear();
  certificate.order = order_;
  if (parts_.size() == 0 || walk(span, tree_.root(), certificate.cover)) return true;
  certificate.cover.clear();
  certificate.order.clear();
  return false;
}

bool BodyRayProver::walk(const RaySpan& span, const PartNode& node, Steps& steps) {
  if (const auto& box = tree_.box(node)) {
    const RoundedGroup group(*box, pose_);
    const Vec3d from = rounded_vector(span.origin);
    const RoundedGroup segment(from, from + way_of(span), group);
    if (const auto n = plane_between(segment, group, parts_.greatest_radius().get_d())) {
      const auto parted = parting(*n, span, [&](const RationalVector& along) {
        return span.is_parted(along, parts_.support(mpq_class(-1) * along, *box),
                              parts_.greatest_radius());
      });
      if (parted) {
        steps.push_back({Kind::plane, *parted});
        return true;
      }
    }
  }
  if (node.is_leaf()) return part_is_free(span, tree_.part(node), steps);
  steps.push_back({Kind::halve, {}});
  return walk(span, node.first_half(), steps) && walk(span, node.second_half(), steps);
}

bool BodyRayProver::part_is_free(const RaySpan& span, std::uint32_t part, Steps& steps) {
  if (const auto triangle = triangle_of(parts_, part)) {
    steps.push_back({Kind::triangle, {}});
    return span.passes(*triangle);
  }
  const RationalCore core = parts_.core(part);
  const auto is_parted = [&](const RationalVector& along) {
    const auto reach = core.support(mpq_class(-1) * along);
    return reach && span.is_parted(along, *reach, parts_.radius(part));
  };
  if (core.is_halfspace()) {
    steps.push_back({Kind::own_plane, {}});
    return !is_zero(core.normal()) && is_parted(mpq_class(-1) * core.normal());
  }
  const Vec3d from = rounded_vector(span.origin);
  const Vec3d way = way_of(span);
  Shape shape;
  shape.kind = ShapeKind::hull;
  Hull hull;
  hull.vertices = {from, from + way};
  if (!hull.vertices[1].allFinite()) return false;
  shape.hull = std::make_shared<const Hull>(std::move(hull));
  const Solid segment(shape);
  Certificate found;
  const Body body = rounded_part(parts_, body_, pose_, part);
  if (!body.is_finite()) return false;
  oracle_.prove(Body(segment, Pose{}), body, found);
  const auto parted = parting(found.direction, span, is_parted);
  if (!parted) return false;
  steps.push_back({Kind::plane, *parted});
  return true;
}

// The way from the origin to the end of the span; without one, to where the ray is past all that is bounded.
Vec3d BodyRayProver::way_of(const RaySpan& span) const {
  if (span.end) return rounded_vector(*span.end * span.direction);
  double reach = rounded_vector(span.origin).stableNorm() + pose_.translation.stableNorm() +
                 parts_.greatest_radius().get_d();
  // The matrix lengthens nothing by more than this. Eigen's stableNorm of a matrix reads beyond it.
  const double stretch = 3 * pose_.rotation.cwiseAbs().maxCoeff();
  for (const auto& box : parts_.boxes()) {
    if (!box) continue;
    const Vec3d low = rounded_vector(box->low), high = rounded_vector(box->high);
    const double size = low.cwiseAbs().cwiseMax(high.cwiseAbs()).stableNorm();
    reach = std::max(reach, reach / 2 + stretch * size);
  }
  return 4 * reach * rounded_vector(span.direction).stableNormalized();
}

}  // namespace touchstone::oracle
