// Inner proxies of closed meshes: candidates from sample points, proven with the exact oracle.
#include "harness/proxies/fits.h"

#include <algorithm>
#include <cmath>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/oracle/oracle.h"
#include "harness/base/error.h"
#include "harness/geometry/optimal_fits.h"
#include "harness/proxies/local_body.h"
#include "harness/proxies/placed_solid.h"

namespace touchstone::proxies {
namespace {

Shape hull_of(const geometry::Triangle& t) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_hull({t.a, t.b, t.c});
  return shape;
}

// Corners relative to the part's middle.
std::vector<Vec3d> corners_of(const Part& part) {
  std::vector<Vec3d> corners = PlacedSolid(part.shape, part.pose).extremes();
  Vec3d middle = Vec3d::Zero();
  for (const Vec3d& c : corners) middle += c / static_cast<double>(corners.size());
  for (Vec3d& c : corners) c -= middle;
  return corners;
}

// The scale at which the copy around zero meets the triangle.
double scale_at(const std::vector<geometry::Plane>& planes, const geometry::Triangle& t) {
  std::vector<Vec3d> rows;
  for (const geometry::Plane& p : planes) {
    const Vec3d n = p.normal / p.offset;
    rows.emplace_back(n.dot(t.b - t.a), n.dot(t.c - t.a), n.dot(t.a));
  }
  return geometry::least_maximum(rows);
}

bool certainly_apart(const Part& part, const std::vector<geometry::Plane>& planes, double scale,
                     const Vec3d& centre, const std::vector<geometry::Triangle>& triangles) {
  oracle::Oracle exact;
  const oracle::Solid solid(part.shape);
  for (const geometry::Triangle& t : triangles) {
    const bool kept_away = std::any_of(planes.begin(), planes.end(), [&](const geometry::Plane& p) {
      const double least = std::min(
          {p.normal.dot(t.a - centre), p.normal.dot(t.b - centre), p.normal.dot(t.c - centre)});
      return least > scale * p.offset * (1 + 1e-9) + 1e-12;
    });
    if (kept_away) continue;
    const oracle::Solid flat(hull_of(t));
    const Answer answer = exact.verdict({solid, part.pose}, {flat, Pose{}});
    if (answer != Answer::separated && answer != Answer::touching) return false;
  }
  return true;
}

}  // namespace

MeshInside::MeshInside(const LocalBody& body) : body_(body) {
  std::vector<geometry::Triangle> all;
  for (geometry::MeshPiece& piece : geometry::pieces_of(body.mesh)) {
    if (!piece.closed) {
      throw base::InputError(
          "the mesh is not closed, so nothing is inside it for certain; expected a "
          "mesh whose every edge is used once each way");
    }
    const std::vector<geometry::Triangle> triangles = geometry::triangles_of(piece.mesh);
    all.insert(all.end(), triangles.begin(), triangles.end());
  }
  surface_ = geometry::Surface(std::move(all));
  const std::optional<Vec3d> found = deepest(body.middle - body.half, body.middle + body.half, 2048,
                                             [&](const Vec3d& x) { return surface_.distance(x); });
  if (!found) throw base::InputError("no ball was found inside the mesh; expected a thicker one");
  centre_ = *found;
}

bool MeshInside::winds_about(const Vec3d& x) const {
  return std::abs(geometry::winding_number(surface_.triangles(), x)) > 0.5;
}

// A plane perpendicular to the direction of the nearest point keeps the whole triangle at the
// distance of its nearest corner.
double MeshInside::clearance(const Vec3d& x) const {
  double least = infinity;
  for (const geometry::Triangle& t : surface_.triangles()) {
    const Vec3d to = geometry::nearest_point(t, x) - x;
    const double length = to.norm();
    if (!(length > 0)) return -1;
    const Vec3d n = to / length;
    least = std::min(least, std::min({n.dot(t.a - x), n.dot(t.b - x), n.dot(t.c - x)}));
  }
  return least * (1 - 8 * epsilon) - 64 * epsilon * body_.size;
}

template <class Measure>
std::optional<Vec3d> MeshInside::deepest(const Vec3d& low, const Vec3d& high, int count,
                                         const Measure& measure) const {
  std::vector<std::pair<double, Vec3d>> points;
  for (int i = 1; i <= count; ++i) {
    // Powers of the root of x^4 = x + 1.
    const Vec3d at(std::fmod(i * 0.8191725133961645, 1), std::fmod(i * 0.6710436067037893, 1),
                   std::fmod(i * 0.5497004779019703, 1));
    const Vec3d x = low + at.cwiseProduct(high - low);
    points.emplace_back(measure(x), x);
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  std::pair<double, Vec3d> best(0, Vec3d::Zero());
  int climbed = 0;
  for (auto [value, x] : points) {
    if (!(value > 0) || climbed == 8) break;
    if (!winds_about(x)) continue;
    ++climbed;
    // Steps are shorter than the distance to the surface, so that none leaves the inside.
    for (double step = 0.5; step > 1e-4; step /= 2) {
      for (int k = 0; k < 3; ++k) {
        for (double by : {-step, step}) {
          const Vec3d tried = body_.snap(x + by * surface_.distance(x) * Vec3d::Unit(k));
          const double there = measure(tried);
          if (there > value) {
            value = there;
            x = tried;
          }
        }
      }
    }
    if (value > best.first) best = {value, x};
  }
  if (!(best.first > 1e-9 * body_.size) || !winds_about(best.second)) return std::nullopt;
  return body_.snap(best.second);
}

Part MeshInside::sphere() const {
  Part part;
  part.shape.kind = ShapeKind::sphere;
  part.shape.radius = clearance(centre_);
  part.pose.translation = centre_;
  if (!(part.shape.radius > 0)) {
    throw base::InputError("no ball is certainly inside the mesh; expected a thicker one");
  }
  return part;
}

std::optional<Part> MeshInside::copy_about(const Part& part, const Vec3d& centre) const {
  std::vector<Vec3d> corners = corners_of(part);
  std::vector<geometry::Plane> planes;
  for (const geometry::Triangle& t : geometry::triangles_of(*make_hull(corners))) {
    const Vec3d n = t.normal();
    if (n.norm() > 0) planes.push_back({n.normalized(), n.normalized().dot(t.a)});
  }
  const bool open = std::any_of(planes.begin(), planes.end(),
                                [](const geometry::Plane& p) { return !(p.offset > 0); });
  if (planes.size() < 4 || open) return std::nullopt;
  double steepest = 0;
  for (const geometry::Plane& p : planes) steepest = std::max(steepest, 1 / p.offset);
  std::vector<geometry::Triangle> triangles = surface_.triangles();
  double scale = 1e9;
  for (geometry::Triangle& t : triangles) {
    for (Vec3d* v : {&t.a, &t.b, &t.c}) *v -= centre;
    // The least value on the triangle is below that at a corner by at most its reach times the
    // steepest slope.
    double at_corner = 0;
    for (const geometry::Plane& p : planes)
      at_corner = std::max(at_corner, p.normal.dot(t.a) / p.offset);
    const double reach = std::max((t.b - t.a).norm(), (t.c - t.a).norm());
    if (at_corner - steepest * reach > scale) continue;
    scale = std::min(scale, scale_at(planes, t));
  }
  for (double less = 1e-9; less < 0.1 && scale > 0; less *= 16) {
    const double used = scale * (1 - less);
    Part made = part;
    if (part.shape.kind == ShapeKind::box) {
      made.shape.half_extents *= used;
      made.pose.translation = centre;
    } else {
      std::vector<Vec3d> placed;
      for (const Vec3d& c : corners) placed.push_back(centre + used * c);
      made.shape.hull = make_hull(placed);
      made.pose = {};
    }
    if (certainly_apart(made, planes, used, centre, surface_.triangles())) return made;
  }
  return std::nullopt;
}

Part MeshInside::copy(const Part& part) const {
  std::optional<Part> made = copy_about(part, centre_);
  if (!made)
    throw base::InputError(
        "nothing of this form is certainly inside the mesh; expected a thicker one");
  return *made;
}

std::vector<Part> MeshInside::copies(const std::vector<Part>& parts) const {
  std::vector<Part> made;
  for (const Part& part : parts) {
    const PlacedSolid solid(part.shape, part.pose);
    if (!solid.solid()) continue;
    const std::optional<Vec3d> centre = deepest(
        solid.low(), solid.high(), 256,
        [&](const Vec3d& x) { return std::min(-solid.signed_distance(x), surface_.distance(x)); });
    if (!centre) continue;
    if (std::optional<Part> copy = copy_about(part, *centre)) made.push_back(std::move(*copy));
  }
  if (made.empty())
    throw base::InputError("no part is certainly inside the mesh; expected a thicker one");
  return made;
}

Part MeshInside::capsule(const Mat3d& axes) const {
  Part best = sphere();
  best.shape.kind = ShapeKind::capsule;
  const double greatest = best.shape.radius;
  const auto volume = [](double half, double r) { return r * r * (2 * half + 4.0 / 3 * r); };
  double most = volume(0, greatest);
  for (int k = 0; k < 3; ++k) {
    const Vec3d axis = axes.col(k);
    for (double share : {0.95, 0.85, 0.7, 0.5, 0.3}) {
      const double radius = share * greatest;
      // The end advances from the middle by the clearance at each step.
      const auto run = [&](double sign) {
        double at = 0;
        for (int step = 0; step < 200; ++step) {
          const double more = clearance(centre_ + sign * at * axis) - radius;
          if (!(more > 1e-4 * radius)) break;
          at += more;
        }
        return at;
      };
      const double up = run(1), down = run(-1);
      const double half = 0.5 * (up + down);
      // The centre is snapped and the ends are rounded, by less than this.
      const Vec3d centre = body_.snap(centre_ + 0.5 * (up - down) * axis);
      const double moved = (centre - centre_ - 0.5 * (up - down) * axis).norm();
      const double certain = radius - 2 * moved - 32 * epsilon * body_.size;
      if (!(certain > 0) || !(volume(half, certain) > most)) continue;
      most = volume(half, certain);
      best.shape.half_length = half;
      best.shape.radius = certain;
      best.pose.translation = centre;
      best.pose.rotation << axes.col((k + 1) % 3), axis.cross(axes.col((k + 1) % 3)), axis;
    }
  }
  return best;
}

}  // namespace touchstone::proxies
