// Clips two outlines against each other in long double.
#include "harness/grade/manifold/touching_area.h"

#include <algorithm>
#include <cmath>

#include "algorithms/encoding.h"

namespace touchstone::grade {
namespace {

using Vec = Vec3<Real>;

constexpr Real least_cosine = 0.93969262L;  // cosine of 20 degrees

Vec wide(const Vec3d& v) { return v.cast<Real>(); }

// A face in the frame: its corners (none for a half-space) and the plane's outward normal.
struct Face {
  std::vector<Vec> corners;
  Vec normal, point;
};

std::vector<Face> faces_of(const Shape& shape, const Pose& pose, const Vec& origin) {
  const Mat3<Real> turn = pose.rotation.cast<Real>();
  const Vec shift = wide(pose.translation) - origin;
  std::vector<std::vector<Vec>> loops;
  if (shape.kind == ShapeKind::box) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        std::vector<Vec> loop;
        for (const auto& [i, j] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}}) {
          Vec corner;
          corner[axis] = side;
          corner[(axis + 1) % 3] = i;
          corner[(axis + 2) % 3] = j * side;
          loop.push_back(corner.cwiseProduct(wide(shape.half_extents)));
        }
        loops.push_back(loop);
      }
    }
  } else if (shape.kind == ShapeKind::hull) {
    for (const Hull::Face& face : shape.hull->faces) {
      std::vector<Vec>& loop = loops.emplace_back();
      for (const std::uint32_t k : face.loop) loop.push_back(wide(shape.hull->vertices[k]));
    }
  } else if (shape.kind == ShapeKind::halfspace) {
    const Vec normal = (turn.inverse().transpose() * wide(shape.normal)).normalized();
    const Vec inner = wide(shape.normal) * (shape.offset / wide(shape.normal).squaredNorm());
    return {{{}, normal, turn * inner + shift}};
  }
  std::vector<Face> faces;
  for (const std::vector<Vec>& loop : loops) {
    Face face;
    for (const Vec& v : loop) face.corners.push_back(turn * v + shift);
    face.normal.setZero();
    const Vec& first = face.corners[0];
    for (std::size_t k = 2; k < loop.size(); ++k) {
      face.normal += (face.corners[k - 1] - first).cross(face.corners[k] - first);
    }
    if (turn.determinant() < 0) face.normal = -face.normal;
    if (!(face.normal.norm() > 0)) continue;
    face.normal.normalize();
    face.point = first;
    faces.push_back(std::move(face));
  }
  return faces;
}

// Returns, among the faces with a corner furthest in the direction, the one most nearly across it.
const Face& supporting_face(const std::vector<Face>& faces, const Vec& direction) {
  if (faces.size() == 1) return faces[0];  // a half-space
  const auto height = [&](const Face& face) {
    Real greatest = direction.dot(face.point);
    for (const Vec& v : face.corners) greatest = std::max(greatest, direction.dot(v));
    return greatest;
  };
  Real greatest = height(faces[0]), size = 0;
  for (const Face& face : faces) {
    greatest = std::max(greatest, height(face));
    size = std::max(size, (face.point - faces[0].point).norm());
  }
  const Face* best = nullptr;
  for (const Face& face : faces) {
    if (height(face) < greatest - 1e-14L * size) continue;
    if (best == nullptr || face.normal.dot(direction) > best->normal.dot(direction)) best = &face;
  }
  return *best;
}

// The half-plane a x + b y + c >= 0; the value is a length.
struct Line {
  Real a, b, c;
  Real at(const AreaPoint& p) const { return a * p.x + b * p.y + c; }
};

// Returns the plane's height along the normal over (x, y), as the value of a line.
Line height_of(const Face& face, const AreaFrame& frame) {
  const Real along = face.normal.dot(frame.normal);
  const Real a = -face.normal.dot(frame.u) / along, b = -face.normal.dot(frame.v) / along;
  return {a, b,
          frame.normal.dot(face.point) - a * frame.u.dot(face.point) - b * frame.v.dot(face.point)};
}

void add_outline(const Face& face, const AreaFrame& frame, std::vector<Line>& lines) {
  std::vector<AreaPoint> seen;
  for (const Vec& v : face.corners) seen.push_back({frame.u.dot(v), frame.v.dot(v), 0});
  AreaPoint middle;
  for (const AreaPoint& p : seen) {
    middle.x += p.x / static_cast<Real>(seen.size());
    middle.y += p.y / static_cast<Real>(seen.size());
  }
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const AreaPoint &p = seen[k], &q = seen[(k + 1) % seen.size()];
    const Real length = std::hypot(q.x - p.x, q.y - p.y);
    if (!(length > 0)) continue;
    Line line{-(q.y - p.y) / length, (q.x - p.x) / length, 0};
    line.c = -(line.a * p.x + line.b * p.y);
    if (line.at(middle) < 0) line = {-line.a, -line.b, -line.c};
    lines.push_back(line);
  }
}

Real cross(const AreaPoint& o, const AreaPoint& p, const AreaPoint& q) {
  return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
}

// Jarvis' march, anticlockwise: each step goes to the corner that has all others to its left.
std::vector<AreaPoint> convex_loop(const std::vector<AreaPoint>& points, Real least) {
  if (points.size() < 3) return points;
  const auto lower = [](const auto& p, const auto& q) {
    return p.y != q.y ? p.y < q.y : p.x < q.x;
  };
  const AreaPoint start = *std::min_element(points.begin(), points.end(), lower);
  std::vector<AreaPoint> loop = {start};
  while (loop.size() <= points.size()) {
    const AreaPoint& from = loop.back();
    const AreaPoint* next = nullptr;
    for (const AreaPoint& p : points) {
      if (std::hypot(p.x - from.x, p.y - from.y) <= least) continue;
      if (next == nullptr) {
        next = &p;
        continue;
      }
      const Real turn = cross(from, *next, p);
      const bool further =
          std::hypot(p.x - from.x, p.y - from.y) > std::hypot(next->x - from.x, next->y - from.y);
      if (turn < 0 || (turn == 0 && further)) next = &p;
    }
    if (next == nullptr || std::hypot(next->x - start.x, next->y - start.y) <= least) break;
    loop.push_back(*next);
  }
  return loop;
}

}  // namespace

AreaPoint AreaFrame::see(const Vec& world) const {
  const Vec p = world - origin;
  return {u.dot(p), v.dot(p), 0};
}

AreaFrame area_frame(const files::Case& c, const Vec3d& normal) {
  AreaFrame frame;
  frame.normal = wide(normal).normalized();
  frame.u = frame.normal.unitOrthogonal();
  frame.v = frame.normal.cross(frame.u);
  frame.origin = wide(c.pose_a.translation);
  return frame;
}

std::optional<std::vector<AreaPoint>> touching_area(const files::Case& c, const AreaFrame& frame) {
  const std::vector<Face> of_a = faces_of(c.shape_a, c.pose_a, frame.origin);
  const std::vector<Face> of_b = faces_of(c.shape_b, c.pose_b, frame.origin);
  if (of_a.empty() || of_b.empty()) return std::nullopt;
  const Face &a = supporting_face(of_a, frame.normal), &b = supporting_face(of_b, -frame.normal);
  if (!(a.normal.dot(frame.normal) > least_cosine) ||
      !(b.normal.dot(frame.normal) < -least_cosine)) {
    return std::vector<AreaPoint>();
  }
  const Line height_a = height_of(a, frame), height_b = height_of(b, frame);
  const Line depth{height_a.a - height_b.a, height_a.b - height_b.b, height_a.c - height_b.c};
  std::vector<Line> lines = {depth};
  add_outline(a, frame, lines);
  add_outline(b, frame, lines);
  Real size = 0;
  for (const Face& face : {a, b}) {
    for (const Vec& v : face.corners) size = std::max(size, (v - a.point).norm());
  }
  const Real least = 1e-17L * size;
  std::vector<AreaPoint> corners;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Line &p = lines[i], &q = lines[j];
      const Real across = p.a * q.b - p.b * q.a;
      if (across == 0) continue;
      AreaPoint corner{(p.b * q.c - q.b * p.c) / across, (q.a * p.c - p.a * q.c) / across, 0};
      if (!(std::abs(corner.x) < 1e3L * size && std::abs(corner.y) < 1e3L * size)) continue;
      corner.depth = depth.at(corner);
      const auto cuts = [&](const Line& line) { return line.at(corner) < -16 * least; };
      if (std::ranges::none_of(lines, cuts)) corners.push_back(corner);
    }
  }
  return convex_loop(corners, 64 * least);
}

Real hull_area(std::vector<AreaPoint> points) {
  points = convex_loop(points, 0);
  Real doubled = 0;
  for (std::size_t k = 2; k < points.size(); ++k)
    doubled += cross(points[0], points[k - 1], points[k]);
  return std::abs(doubled) / 2;
}

Real greatest_area_of_four(const std::vector<AreaPoint>& points, Real slack) {
  const std::size_t n = points.size();
  if (n <= 4) return hull_area(points);
  Real deepest = points[0].depth;
  for (const AreaPoint& p : points) deepest = std::max(deepest, p.depth);
  const auto is_deep = [&](std::size_t k) { return points[k].depth >= deepest - slack; };
  Real best = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        const Real half = cross(points[i], points[j], points[k]);
        const bool deep = is_deep(i) || is_deep(j) || is_deep(k);
        for (std::size_t l = k + 1; l < n; ++l) {
          if (!deep && !is_deep(l)) continue;
          best = std::max(best, half + cross(points[i], points[k], points[l]));
        }
      }
    }
  }
  return best / 2;
}

}  // namespace touchstone::grade
