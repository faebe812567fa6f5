// The error of a proxy: volumes and Hausdorff distance.
#include <algorithm>
#include <cmath>

#include "harness/proxies/fits.h"
#include "harness/proxies/local_body.h"
#include "harness/proxies/placed_solid.h"
#include "harness/proxies/union_volume.h"

namespace touchstone::proxies {
namespace {

constexpr std::size_t surface_points = 2048;
constexpr double way_step = 1e-7;  // relative to about unit size: a step beyond a surface

void set_volumes(double body, double added, double lost, RepresentationError& error) {
  const auto part = [&](double v) { return v > 0 ? (body > 0 ? v / body : infinity) : 0; };
  error.added = part(added);
  error.lost = part(lost);
}

void set_volumes(const Overlap& overlap, RepresentationError& error) {
  set_volumes(overlap.body, overlap.added, overlap.lost, error);
  error.volume_deviation = std::isfinite(error.volume_error()) ? overlap.deviation : infinity;
}

// The error of sampling on a round solid.
double unseen(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::cylinder:
    case ShapeKind::cone: return 2e-5 * shape.radius;
    case ShapeKind::ellipsoid: return 1e-3 * shape.radii.maxCoeff();
    default: return 0;
  }
}

// Compares two convex solids. Their surfaces are as far apart as the solids. The greatest distance
// of a point of one from the other is at an extreme point, since it is a convex function.
void compare_convex(const PlacedSolid& body, const PlacedSolid& part, double tolerance,
                    RepresentationError& error) {
  const double out_of_part =
      body.greatest([&](const Vec3d& x) { return part.signed_distance(x); }) + body.radius();
  const double out_of_body =
      part.greatest([&](const Vec3d& x) { return body.signed_distance(x); }) + part.radius();
  error.hausdorff = std::max({0.0, out_of_part, out_of_body});
  const double body_volume = body.volume(), part_volume = part.volume();
  if (out_of_part <= tolerance || body_volume == 0) {
    set_volumes(body_volume, std::max(0.0, part_volume - body_volume), 0, error);
  } else if (out_of_body <= tolerance || part_volume == 0) {
    set_volumes(body_volume, 0, std::max(0.0, body_volume - part_volume), error);
  } else if (body.is_polytope() && part.is_polytope()) {
    const Vec3d room = 0.01 * (body.high() - body.low());
    geometry::Polyhedron common =
        geometry::intersection(body.low() - room, body.high() + room, body.planes());
    for (const geometry::Plane& plane : part.planes()) common.clip(plane);
    const double both = common.volume();
    set_volumes(body_volume, std::max(0.0, part_volume - both), std::max(0.0, body_volume - both),
                error);
  } else {
    set_volumes(overlap_of({body}, {}, {part}), error);
  }
  if (body_volume == 0 && part_volume > 0) error.volume_deviation = infinity;
}

// Returns true if a step out of one part at a point of its surface leads into another part.
bool is_covered(const std::vector<PlacedSolid>& parts, const PlacedSolid& part,
                const geometry::SurfacePoint& p) {
  const Vec3d out = part.solid() ? Vec3d(p.at + way_step * p.normal) : p.at;
  return std::any_of(parts.begin(), parts.end(), [&](const PlacedSolid& other) {
    return &other != &part && other.solid() && (out.array() >= other.low().array()).all() &&
           (out.array() <= other.high().array()).all() && other.signed_distance(out) < 0;
  });
}

// Sample points of the union's surface: those of each part from which a step outward does not lead
// into another part.
std::vector<Vec3d> points_of_union(const std::vector<PlacedSolid>& parts) {
  double area = 0;
  const auto area_of = [](const PlacedSolid& part) {
    double sum = 0;
    for (const geometry::Triangle& t : part.surface()) sum += t.normal().norm();
    return sum;
  };
  for (const PlacedSolid& part : parts) area += area_of(part);
  std::vector<Vec3d> points;
  for (const PlacedSolid& part : parts) {
    const double share = area > 0 ? area_of(part) / area : 1;
    const auto count = static_cast<std::size_t>(share * surface_points) + 1;
    for (const geometry::SurfacePoint& p : geometry::spread_points(part.surface(), count)) {
      if (!is_covered(parts, part, p)) points.push_back(p.at);
    }
  }
  return points;
}

double distance_to_points(const std::vector<Vec3d>& points, const Vec3d& x) {
  double least = infinity;
  for (const Vec3d& p : points) least = std::min(least, (p - x).squaredNorm());
  return std::sqrt(least);
}

// Distance from the surface of the union. Inside it follows from the straight ways out that lead
// into no other part, and from the sample points.
double distance_to_union(const std::vector<PlacedSolid>& parts, const std::vector<Vec3d>& points,
                         const Vec3d& x) {
  double nearest = infinity, out = infinity;
  for (const PlacedSolid& part : parts) {
    const Vec3d beyond = (part.low() - x).cwiseMax(x - part.high()).cwiseMax(0.0);
    if (beyond.norm() >= nearest) continue;
    const double distance = part.signed_distance(x);
    nearest = std::min(nearest, distance);
    if (distance >= 0) continue;
    if (parts.size() == 1) return -distance;
    if (part.is_polytope() && !is_covered(parts, part, part.way_out(x))) {
      out = std::min(out, -distance);
    }
  }
  return nearest >= 0 ? nearest : std::min(out, distance_to_points(points, x));
}

// The approximate greatest distance of a surface point from its nearest sample point.
double spacing_of(const std::vector<geometry::Triangle>& surface) {
  double area = 0;
  for (const geometry::Triangle& t : surface) area += t.normal().norm() / 2;
  return 1.5 * std::sqrt(area / surface_points);
}

void compare_unions(const WholeBody& body, const std::vector<PlacedSolid>& parts,
                    RepresentationError& error) {
  std::vector<PlacedSolid> solid;
  for (const PlacedSolid& part : parts) {
    if (part.solid()) solid.push_back(part);
  }
  set_volumes(overlap_of(body.convex, body.closed, solid), error);
  const geometry::Surface surface(body.surface);
  const std::vector<Vec3d> points = points_of_union(parts);
  std::vector<geometry::Triangle> of_parts;
  for (const PlacedSolid& part : parts) {
    of_parts.insert(of_parts.end(), part.surface().begin(), part.surface().end());
  }
  for (const Vec3d& p : points) error.hausdorff = std::max(error.hausdorff, surface.distance(p));
  for (const geometry::SurfacePoint& p : geometry::spread_points(body.surface, surface_points)) {
    error.hausdorff = std::max(error.hausdorff, distance_to_union(parts, points, p.at));
  }
  error.hausdorff_deviation = std::max(spacing_of(body.surface), spacing_of(of_parts));
}

}  // namespace

RepresentationError representation_error(const Shape& shape, const geometry::Mesh* mesh,
                                         const std::vector<Part>& parts) {
  const LocalBody body(shape, mesh);
  RepresentationError error;
  // The computation uses the body's local frame, with lines across its shortest dimension.
  const Mat3d turn = fitting_axes(body).transpose();
  std::vector<PlacedSolid> placed;
  for (const Part& given : parts) {
    const Part part = body.localised(given);
    placed.emplace_back(part.shape, part.pose, turn);
  }
  const WholeBody itself(body, turn);
  const double size = 2 * outer_sphere(body).shape.radius;
  if (itself.closed.empty() && itself.convex.size() == 1 && !body.has_mesh && placed.size() == 1) {
    compare_convex(itself.convex.front(), placed.front(), 1e-9 * size, error);
    error.hausdorff_deviation =
        std::max(unseen(body.shape), unseen(body.localised(parts.front()).shape));
  } else {
    compare_unions(itself, placed, error);
  }
  error.hausdorff = body.length_as_given(error.hausdorff);
  error.hausdorff_deviation = body.length_as_given(error.hausdorff_deviation);
  error.size = body.length_as_given(size);
  return error;
}

}  // namespace touchstone::proxies
