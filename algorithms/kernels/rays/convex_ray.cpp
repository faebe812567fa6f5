// The line's stretch within the shape.
//
// Steps: 1. The origin is moved to the point of the line that is nearest to the shape's origin, so that
//           a ray from far away keeps its digits.
//        2. Slabs, quadrics and planes each leave a stretch of the line: the shape's is what all leave.
//           A capsule's is from the first to the last of its cylinder's and its balls'.
//        3. Hulls without an inside are triangles, for which RayQuery is exact.
#include "algorithms/kernels/rays/convex_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/rays/ray_query.h"

namespace touchstone {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// The line p + t * d for t from `enter` to `leave`, and the normal where it enters.
struct Line {
  Vec3d p, d;
  double enter = -inf, leave = inf;
  Vec3d normal = Vec3d::Constant(Outcome::none);

  bool is_empty() const { return !(enter <= leave); }
  void clear() {
    enter = inf;
    leave = -inf;
  }
  void enter_at(double t, const Vec3d& n) {
    if (!(t > enter)) return;
    enter = t;
    normal = n;
  }
  void leave_at(double t) { leave = std::min(leave, t); }

  // Keeps what has n . x <= offset.
  void keep_below(const Vec3d& n, double offset) {
    const double height = n.dot(p) - offset, slope = n.dot(d);
    if (slope < 0) {
      enter_at(-height / slope, n);
    } else if (slope > 0) {
      leave_at(-height / slope);
    } else if (height > 0) {
      clear();
    }
  }
  void keep_slab(int axis, double half) {
    Vec3d n = Vec3d::Zero();
    n[axis] = 1;
    keep_below(n, half);
    keep_below(-n, half);
  }
  // Keeps what is in the ellipsoid about the origin with these semi-axes; infinite ones leave a cylinder.
  void keep_ellipsoid(const Vec3d& radii) {
    Vec3d q = Vec3d::Zero(), e = Vec3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      if (radii[axis] == 0) {
        keep_slab(axis, 0);
      } else {
        q[axis] = p[axis] / radii[axis];
        e[axis] = d[axis] / radii[axis];
      }
    }
    const double square = e.squaredNorm();
    if (square == 0) {
      if (q.squaredNorm() > 1) clear();
      return;
    }
    const double middle = -q.dot(e) / square;
    const double room = 1 - (q + middle * e).squaredNorm();
    if (!(room >= 0)) return clear();
    const double half = std::sqrt(room / square);
    const Vec3d at = q + (middle - half) * e;
    Vec3d n = Vec3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      if (radii[axis] != 0) n[axis] = at[axis] / radii[axis];
    }
    enter_at(middle - half, n);
    leave_at(middle + half);
  }
  void keep_cylinder(double radius) { keep_ellipsoid({radius, radius, inf}); }

  // Keeps what is in the cone with its tip at z = tip, whose radius grows by `slope` downwards.
  void keep_cone(double tip, double slope) {
    keep_below(Vec3d::UnitZ(), tip);
    if (is_empty()) return;
    // (a t + 2 b) t + c <= 0, where the height below the tip is not negative.
    const double k = slope * slope, h = tip - p[2];
    const double a = d[0] * d[0] + d[1] * d[1] - k * d[2] * d[2];
    const double b = p[0] * d[0] + p[1] * d[1] + k * h * d[2];
    const double c = p[0] * p[0] + p[1] * p[1] - k * h * h;
    const auto normal_at = [&](double t) {
      const Vec3d x = p + t * d;
      return Vec3d(x[0], x[1], k * (tip - x[2]));
    };
    const double discriminant = b * b - a * c;
    if (a > 0 && !(discriminant >= 0)) return clear();
    const double root = std::sqrt(std::max(0.0, discriminant));
    const double sum = b >= 0 ? -(b + root) : root - b;  // the root that loses no digits, times a
    const double one = sum / a, other = sum != 0 ? c / sum : 0;
    if (a > 0) {
      enter_at(std::min(one, other), normal_at(std::min(one, other)));
      return leave_at(std::max(one, other));
    }
    // One root at most is of this half of the double cone, which the line enters or leaves there.
    const double t = a == 0 ? (b != 0 ? -c / (2 * b) : 0)
                            : (d[2] < 0 ? std::max(one, other) : std::min(one, other));
    if (d[2] < 0) return enter_at(t, normal_at(t));
    if (d[2] > 0) return leave_at(t);
    if (c > 0) clear();
  }
};

// The stretch of a capsule: its parts' stretches join.
void keep_capsule(Line& line, double radius, double half_length) {
  Line whole = line;
  whole.clear();
  const auto add = [&](const Line& part) {
    if (part.is_empty()) return;
    if (whole.is_empty() || part.enter < whole.enter) {
      whole.enter = part.enter;
      whole.normal = part.normal;
    }
    whole.leave = std::max(whole.leave, part.leave);
  };
  Line middle = line;
  middle.keep_cylinder(radius);
  middle.keep_slab(2, half_length);
  add(middle);
  for (const double end : {-half_length, half_length}) {
    Line ball = line;
    ball.p[2] -= end;
    ball.keep_ellipsoid(Vec3d::Constant(radius));
    add(ball);
  }
  line = whole;
}

std::optional<ConvexRayHit> first_hit_of_flat(const Hull& hull, const Ray& ray) {
  RayQuery query(ray);
  const auto& v = hull.vertices;
  const auto count = static_cast<std::uint32_t>(v.size());
  Vec3d normal = Vec3d::Zero();
  // Each point of a flat hull is in a triangle of the first vertex with two others.
  for (std::uint32_t j = count > 1 ? 1 : 0; j < count; ++j) {
    for (std::uint32_t k = std::min(j + 1, count - 1); k < count; ++k) {
      if (!query.offer(0, v[0], v[j], v[k])) continue;
      const Vec3d n = (v[j] - v[0]).cross(v[k] - v[0]);
      if (n.squaredNorm() > normal.squaredNorm()) normal = n;
    }
  }
  const RayHit hit = query.hit();
  if (!hit.hit) return {};
  if (normal.dot(ray.direction) > 0) normal = -normal;
  return ConvexRayHit{hit.t, normal.isZero(0) ? Vec3d::Constant(Outcome::none) : normal};
}

void keep_shape(Line& line, const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere: return line.keep_ellipsoid(Vec3d::Constant(shape.radius));
    case ShapeKind::ellipsoid: return line.keep_ellipsoid(shape.radii);
    case ShapeKind::capsule: return keep_capsule(line, shape.radius, shape.half_length);
    case ShapeKind::box:
      for (int axis = 0; axis < 3; ++axis) line.keep_slab(axis, shape.half_extents[axis]);
      return;
    case ShapeKind::cylinder:
      line.keep_slab(2, shape.half_length);
      return line.keep_cylinder(shape.radius);
    case ShapeKind::cone:
      line.keep_slab(2, shape.half_length);
      if (shape.half_length == 0) return line.keep_cylinder(shape.radius);
      if (shape.radius == 0) return line.keep_cylinder(0);
      return line.keep_cone(shape.half_length, shape.radius / (2 * shape.half_length));
    case ShapeKind::halfspace: return line.keep_below(shape.normal, shape.offset);
    case ShapeKind::hull:
      for (const Hull::Face& face : shape.hull->faces) {
        line.keep_below(face.normal, face.normal.dot(shape.hull->vertices[face.loop.front()]));
      }
  }
}

}  // namespace

std::optional<ConvexRayHit> first_hit(const Shape& shape, const Ray& ray) {
  if (!(ray.t_max >= 0)) return {};
  if (shape.kind == ShapeKind::hull && shape.hull->dimension < 3) {
    return first_hit_of_flat(*shape.hull, ray);
  }
  const double square = ray.direction.squaredNorm();
  double moved = square > 0 ? -ray.origin.dot(ray.direction) / square : 0;
  if (!std::isfinite(moved)) moved = 0;
  Line line{ray.origin + moved * ray.direction, ray.direction};
  keep_shape(line, shape);
  if (line.is_empty()) return {};
  const double enter = line.enter + moved, leave = line.leave + moved;
  if (!(leave >= 0) || enter > ray.t_max) return {};
  if (!(enter > 0)) return ConvexRayHit{};  // it begins in the shape
  return ConvexRayHit{enter, line.normal};
}

}  // namespace touchstone
