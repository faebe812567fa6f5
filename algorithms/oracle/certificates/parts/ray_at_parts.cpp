// Gaps that are linear in time, and points in parts.
#include "algorithms/oracle/certificates/parts/ray_at_parts.h"

#include "algorithms/oracle/certificates/difference.h"
#include "algorithms/oracle/certificates/parts/triangle_tests.h"

namespace touchstone::oracle {
namespace {

// The corners of the hull of one to three vertices.
RationalTriangle corners_of(const std::vector<RationalVector>& vertices) {
  const std::size_t last = vertices.size() - 1;
  return {vertices[0], vertices[std::min<std::size_t>(1, last)], vertices[last]};
}

}  // namespace

bool RaySpan::is_parted(const RationalVector& n, const mpq_class& reach,
                        const mpq_class& radius) const {
  require(!is_zero(n), "a plane has no direction");
  // The sign of gap / |n| less the radius.
  const auto exceeds = [&](const mpq_class& gap) {
    if (gap < 0) return -1;
    return cmp(mpq_class(gap * gap), mpq_class(radius * radius * dot(n, n)));
  };
  const mpq_class start = -reach - dot(n, origin), closing = dot(n, direction);
  if (exceeds(start) <= 0) return false;
  if (!end) return closing <= 0;
  const int left = exceeds(start - *end * closing);
  return is_closed ? left > 0 : left >= 0;
}

bool RaySpan::passes(const RationalTriangle& triangle) const {
  const auto first = first_time(origin, direction, triangle);
  return !first || (end && (is_closed ? *first > *end : *first >= *end));
}

std::optional<RationalTriangle> triangle_of(const PlacedParts& parts, std::uint32_t part) {
  const Solid& solid = parts.solid(part);
  const bool is_triangle =
      solid.core == Solid::Core::polytope && solid.vertices.size() <= 3 && solid.radius == 0;
  if (!is_triangle) return {};
  return corners_of(parts.core(part).vertices());
}

bool has_point(const PlacedParts& parts, std::uint32_t part, const RationalVector& point,
               const std::vector<Generator>& generators, const Certificate::Surface& surface) {
  const RationalCore core = parts.core(part);
  const bool is_hull = core.is_polytope() && parts.solid(part).vertices.size() > 3;
  if (is_hull && !parts.solid(part).is_box) {
    require(!surface.triangles.empty(), "there is no surface around the point");
    return surface_depth(surface, Difference({point}, core.points(generators))) < SignedSquare{};
  }
  require(surface.triangles.empty() && surface.points.empty() && generators.empty(),
          "a surface is there without need");
  if (core.is_halfspace()) return dot(core.normal(), point) <= *core.support(core.normal());
  if (is_hull || !core.is_polytope()) return core.holds_in_world(point);
  const mpq_class radius = parts.radius(part);
  return squared_distance(point, corners_of(core.vertices())) <= radius * radius;
}

}  // namespace touchstone::oracle
