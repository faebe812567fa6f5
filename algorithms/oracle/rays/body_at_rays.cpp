// Each step is decided in rationals before it is written, as the check will decide it.
#include "algorithms/oracle/rays/body_at_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "algorithms/oracle/certificates/parts/triangle_tests.h"
#include "algorithms/oracle/concave/rounded_part.h"
#include "algorithms/oracle/rays/ray_planes.h"

namespace touchstone::oracle {
namespace {

using StepKind = SceneRayCertificate::Step::Kind;

// At most so far are points of the body from the world's origin.
double reach_of(const PlacedParts& parts, const Pose& pose) {
  // The matrix lengthens nothing by more than this. Eigen's stableNorm of a matrix reads beyond it.
  const double stretch = 3 * pose.rotation.cwiseAbs().maxCoeff();
  double size = 0;
  for (const auto& box : parts.boxes()) {
    if (box) size = std::max(size, reach_of(*box));
  }
  return pose.translation.stableNorm() + parts.greatest_radius().get_d() + stretch * size;
}

}  // namespace

TimeFraction time_fraction(const mpq_class& t) {
  return {integer(t.get_num()), integer(t.get_den())};
}

BodyAtRays::BodyAtRays(const ConcaveBody& body, const Pose& pose)
    : body_(body),
      pose_(pose),
      parts_(body, pose),
      order_(spatial_order(parts_.boxes())),
      tree_(order_, parts_.boxes()),
      reach_(reach_of(parts_, pose)) {}

// The time at which the ray is first in a triangle or a half-space; of others, the one that was found.
mpq_class BodyAtRays::exact_time(const RaySpan& ray, std::uint32_t part, double t) const {
  if (const auto triangle = triangle_of(parts_, part)) {
    const auto first = first_time(ray.origin, ray.direction, *triangle);
    if (first) return *first;
  }
  const RationalCore core = parts_.core(part);
  if (core.is_halfspace() && !core.is_singular_halfspace()) {
    const mpq_class height = dot(core.normal(), ray.origin) - *core.support(core.normal());
    const mpq_class fall = -dot(core.normal(), ray.direction);
    if (height <= 0) return 0;
    if (fall > 0) return height / fall;
  }
  return rational(t);
}

bool BodyAtRays::write_upper(const RaySpan& ray, double t, SceneRayCertificate& certificate) {
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
      certificate.upper = time_fraction(time);
      return true;
    } catch (const Fault&) {
      continue;
    }
  }
  certificate.generators.clear();
  certificate.surface = {};
  return false;
}

bool BodyAtRays::write_cover(const RaySpan& span, const PartUntil* hit,
                             SceneRayCertificate::Cover& cover) {
  cover = {order_, {}};
  return parts_.size() == 0 || walk(span, hit, tree_.root(), cover.steps);
}

bool BodyAtRays::walk(const RaySpan& span, const PartUntil* hit, const PartNode& node,
                      Steps& steps) {
  if (hit != nullptr && node.is_leaf() && tree_.part(node) == hit->part) {
    return walk(span.until(hit->end), nullptr, node, steps);
  }
  if (const auto& box = tree_.box(node)) {
    const auto parted =
        plane_off(span, way_of(span, reach_), RoundedGroup(*box, pose_),
                  parts_.greatest_radius().get_d(), [&](const RationalVector& n) {
                    return span.is_parted(n, parts_.support(mpq_class(-1) * n, *box),
                                          parts_.greatest_radius());
                  });
    if (parted) {
      steps.push_back({StepKind::plane, *parted});
      return true;
    }
  }
  if (node.is_leaf()) return part_is_free(span, tree_.part(node), steps);
  steps.push_back({StepKind::halve, {}});
  return walk(span, hit, node.first_half(), steps) && walk(span, hit, node.second_half(), steps);
}

bool BodyAtRays::part_is_free(const RaySpan& span, std::uint32_t part, Steps& steps) {
  if (const auto triangle = triangle_of(parts_, part)) {
    steps.push_back({StepKind::triangle, {}});
    return span.passes(*triangle);
  }
  const RationalCore core = parts_.core(part);
  const auto is_parted = [&](const RationalVector& along) {
    const auto reach = core.support(mpq_class(-1) * along);
    return reach && span.is_parted(along, *reach, parts_.radius(part));
  };
  if (core.is_halfspace()) {
    steps.push_back({StepKind::own_plane, {}});
    return !core.is_singular_halfspace() && is_parted(mpq_class(-1) * core.normal());
  }
  const Vec3d from = rounded_vector(span.origin);
  const Vec3d way = way_of(span, reach_);
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
  steps.push_back({StepKind::plane, *parted});
  return true;
}

}  // namespace touchstone::oracle
