// The portal of rough_portal.h.
#include "algorithms/narrow_phase/certified/rough_portal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace touchstone {
namespace {

using Vec2d = Eigen::Vector2d;
double cross(const Vec2d& p, const Vec2d& q) { return p.x() * q.y() - p.y() * q.x(); }

// The vertex that the shape's last support point in the direction was.
std::uint32_t vertex_of(const PosedShape<double>& shape, const oracle::Solid& solid,
                        const Vec3d& direction) {
  using Core = SupportShape<double>::Core;
  const Core core = shape.shape().core;
  if (core == Core::hull) return shape.last_corner();
  if (core == Core::point) return 0;
  const Vec3d d = shape.matrix().transpose() * direction;
  if (core == Core::box) {
    const auto bit = [&](int axis) { return std::signbit(d[axis]) ? 0u : 1u << axis; };
    return bit(0) | bit(1) | bit(2);
  }
  // A segment, or a curved core that is one.
  return d.dot(solid.vertices[1] - solid.vertices[0]) > 0 ? 1 : 0;
}

}  // namespace

RoughCorner RoughPortal::support(const Vec3d& direction) {
  RoughCorner corner;
  corner.point = pair_.support(direction);
  corner.a = vertex_of(pair_.a(), a_, direction);
  corner.b = vertex_of(pair_.b(), b_, -direction);
  return corner;
}

RoughPortal::Start RoughPortal::start_behind(const Vec3d& normal) {
  const Vec3d beside = normal + Vec3d(0.31, -0.17, 0.23);
  return {{support(-normal), support(beside), {}, {}}, {13, 2, 0, 0}};
}

RoughPortal::Start RoughPortal::start_amid(const Vec3d& normal,
                                           const std::array<std::uint32_t, 4>& weights) {
  // The support point along the direction or against it for which `size` is greater.
  const auto greater = [&](const Vec3d& direction, const auto& size) {
    const RoughCorner along = support(direction), against = support(-direction);
    return size(along.point.difference) > size(against.point.difference) ? along : against;
  };
  const RoughCorner p = support(-normal), q = support(normal);
  const Vec3d edge = q.point.difference - p.point.difference;
  const RoughCorner r = greater(normal.unitOrthogonal(), [&](const Vec3d& x) {
    return edge.cross(x - p.point.difference).squaredNorm();
  });
  const Vec3d across = edge.cross(r.point.difference - p.point.difference).stableNormalized();
  const RoughCorner s =
      greater(across, [&](const Vec3d& x) { return std::abs(across.dot(x - p.point.difference)); });
  return {{p, q, r, s}, weights};
}

bool RoughPortal::find(const Start& start, bool from_simplex) {
  ray_ = Vec3d::Zero();
  // A point without weight is not set.
  for (std::size_t k = 0; k < 4; ++k) {
    if (start.weights[k] != 0) ray_ -= start.weights[k] * start.points[k].point.difference;
  }
  if (!(from_simplex && take_face_of_simplex()) && !enclose_ray()) return false;
  approach_surface();
  return true;
}

// Takes the last face that the ray passes, anticlockwise around it.
bool RoughPortal::take_face_of_simplex() {
  static constexpr std::array<std::array<std::size_t, 3>, 4> faces = {
      {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  const double noise = 0x1p-44 * ray_.norm();
  double furthest = -std::numeric_limits<double>::infinity();
  const std::size_t count = simplex_.size == 4 ? 4 : simplex_.size == 3 ? 1 : 0;
  for (const auto& [i, j, k] : std::span(faces).first(count)) {
    const Vec3d &p = simplex_.points[i].difference, &q = simplex_.points[j].difference,
                &r = simplex_.points[k].difference;
    const double pq = ray_.dot(p.cross(q)), qr = ray_.dot(q.cross(r)), rp = ray_.dot(r.cross(p));
    const double steep = pq + qr + rp;  // twice the triangle's area across the ray
    const double side = std::copysign(1.0, steep);
    if (!(std::min({side * pq, side * qr, side * rp}) > -noise)) continue;
    const double height = (q - p).cross(r - p).dot(p) / steep;
    if (!(std::abs(steep) > 4 * noise && height > furthest)) continue;
    furthest = height;
    portal_ = {RoughCorner{.point = simplex_.points[i]}, RoughCorner{.point = simplex_.points[j]},
               RoughCorner{.point = simplex_.points[k]}};
    if (side < 0) std::swap(portal_[1], portal_[2]);
  }
  return furthest > -std::numeric_limits<double>::infinity();
}

bool RoughPortal::enclose_ray() {
  const Vec3d along = ray_.stableNormalized();
  const Vec3d u = along.unitOrthogonal(), v = along.cross(u);
  const auto flat = [&](const RoughCorner& x) {
    const Vec3d& w = x.point.difference;
    return Vec2d(u.dot(w), v.dot(w));
  };
  const auto support_along = [&](const Vec2d& d) { return support(d.x() * u + d.y() * v); };
  const double tiny = 0x1p-40;  // lengths below this may be of either sign
  auto& [p, q, r] = portal_;
  p = support_along({1, 0});
  Vec2d at_p = flat(p);
  q = support_along(at_p.norm() > tiny ? Vec2d(-at_p) : Vec2d(-1, 0));
  Vec2d at_q = flat(q);
  for (int turn = 0; turn < most_turns; ++turn) {
    const Vec2d edge = at_q - at_p;
    const double length = edge.norm();
    if (!(length > tiny)) return false;
    Vec2d across(-edge.y() / length, edge.x() / length);
    const double offset = across.dot(at_p);
    if (offset > tiny) across = -across;
    r = support_along(across);
    Vec2d at_r = flat(r);
    if (std::abs(offset) <= tiny && !(across.dot(at_r) - offset > tiny)) {
      // Zero is on an edge of what C is across the ray; the other side has the third point.
      across = -across;
      r = support_along(across);
      at_r = flat(r);
    }
    const double reach = across.dot(at_r);
    if (reach < -tiny || !(reach - across.dot(at_p) > tiny)) return false;
    if (cross(Vec2d(at_q - at_p), Vec2d(at_r - at_p)) < 0) {
      std::swap(p, q);
      std::swap(at_p, at_q);
    }
    if (cross(at_q, at_r) < -tiny * (at_r - at_q).norm()) {
      p = r;
      at_p = at_r;
    } else if (cross(at_r, at_p) < -tiny * (at_p - at_r).norm()) {
      q = r;
      at_q = at_r;
    } else {
      return true;
    }
  }
  return false;
}

void RoughPortal::approach_surface() {
  auto& [p, q, r] = portal_;
  for (int turn = 0; turn < most_turns; ++turn) {
    const Vec3d normal = across();
    const double length = normal.norm();
    if (!(length > 0)) return;
    const RoughCorner next = support(normal);
    if (!(normal.dot(next.point.difference - p.point.difference) > 0x1p-40 * length)) return;
    // The new point makes three portals with the old corners. The one is kept that the ray passes
    // most clearly, or the widest if it passes a corner or an edge of several.
    const auto side = [&](const RoughCorner& x, const RoughCorner& y) {
      return ray_.dot(x.point.difference.cross(y.point.difference));
    };
    const std::array<double, 3> of = {side(next, p), side(next, q), side(next, r)};
    const double noise = 0x1p-44 * ray_.norm();
    std::size_t best = 0;
    double most = -std::numeric_limits<double>::infinity(), widest = most;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double clear = std::min({of[i] + noise, -of[j] + noise, 0.0});
      const double width = of[i] - of[j] + side(portal_[i], portal_[j]);
      if (clear < most || (clear == most && !(width > widest))) continue;
      best = (i + 2) % 3;
      most = clear;
      widest = width;
    }
    portal_[best] = next;
  }
}

}  // namespace touchstone
