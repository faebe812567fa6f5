// The oriented box and the capsule of least volume that the search finds around a body.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/optimal_fits.h"
#include "harness/proxies/fits.h"

namespace touchstone::proxies {
namespace {

constexpr std::size_t most_faces = 64;

// The frame has the columns u, n x u, n, orthonormal up to rounding.
Mat3d frame_of(const Vec3d& normal, const Vec3d& along) {
  Mat3d frame;
  const Vec3d n = normal.normalized();
  const Vec3d u = (along - n.dot(along) * n).normalized();
  frame << u, n.cross(u).normalized(), n;
  return frame;
}

struct BoxAlong {
  Vec3d low, high;
  Vec3d size() const { return high - low; }
};
BoxAlong box_along(const Mat3d& frame, const std::vector<Vec3d>& points) {
  BoxAlong e{frame.transpose() * points.front(), frame.transpose() * points.front()};
  for (const Vec3d& p : points) {
    const Vec3d at = frame.transpose() * p;
    e.low = e.low.cwiseMin(at);
    e.high = e.high.cwiseMax(at);
  }
  return e;
}

// The cost is the volume, with a small share of area and length so that flat bodies are fitted too.
double cost(const Vec3d& size) {
  return size.prod() + 1e-6 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x()) +
         1e-12 * size.sum();
}

class Search {
 public:
  explicit Search(const std::vector<Vec3d>& points) : points_(points) { consider(best_); }

  void consider(const Mat3d& frame) {
    if (!frame.allFinite()) return;
    const double value = cost(box_along(frame, points_).size());
    if (!(value < least_)) return;
    least_ = value;
    best_ = frame;
  }
  // Tries all boxes with the given normal and a side along an edge of the outline.
  void consider_normal(const Vec3d& normal) {
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Mat3d frame = frame_of(normal, Vec3d::Unit(least));
    if (!frame.allFinite()) return;
    std::vector<Vec3d> flat;
    for (const Vec3d& p : points_) {
      const Vec3d at = frame.transpose() * p;
      flat.emplace_back(at.x(), at.y(), 0);
    }
    flat = make_reduced_hull(flat)->vertices;
    if (flat.size() > 2) {
      // Sorts the corners by angle.
      Vec3d mean = Vec3d::Zero();
      for (const Vec3d& p : flat) mean += p / static_cast<double>(flat.size());
      std::sort(flat.begin(), flat.end(), [&](const Vec3d& a, const Vec3d& b) {
        return std::atan2(a.y() - mean.y(), a.x() - mean.x()) <
               std::atan2(b.y() - mean.y(), b.x() - mean.x());
      });
    }
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const Vec3d edge = flat[(i + 1) % flat.size()] - flat[i];
      consider(frame_of(normal, frame * edge));
    }
  }
  void refine() {
    for (double step = 0.1; step > 1e-4; step /= 2) {
      for (bool better = true; better;) {
        const double before = least_;
        for (int axis = 0; axis < 3; ++axis) {
          for (double turn : {-step, step}) {
            const Mat3d turned = best_ * Eigen::AngleAxisd(turn, Vec3d::Unit(axis)).matrix();
            consider(frame_of(turned.col(2), turned.col(0)));
          }
        }
        better = least_ < before * (1 - 1e-9);
      }
    }
  }
  const Mat3d& best() const { return best_; }

 private:
  const std::vector<Vec3d>& points_;
  Mat3d best_ = Mat3d::Identity();
  double least_ = infinity;
};

Mat3d best_frame(const Hull& hull) {
  Search search(hull.vertices);
  std::vector<geometry::Triangle> triangles = geometry::triangles_of(hull);
  std::sort(triangles.begin(), triangles.end(),
            [](const geometry::Triangle& a, const geometry::Triangle& b) {
              return a.normal().squaredNorm() > b.normal().squaredNorm();
            });
  if (triangles.size() > most_faces) triangles.resize(most_faces);
  for (const geometry::Triangle& t : triangles) {
    if (t.normal().norm() > 0) {
      search.consider_normal(t.normal());
      continue;
    }
    const Vec3d along = t.b - t.a;  // a segment
    int least = 0;
    along.cwiseAbs().minCoeff(&least);
    search.consider(frame_of(along.cross(Vec3d::Unit(least)), along));
  }
  search.refine();
  return search.best();
}

}  // namespace

Part outer_oriented_box(const LocalBody& body) {
  if (body.shape.kind != ShapeKind::hull) return outer_box(body);
  const Mat3d frame = best_frame(*body.shape.hull);
  const BoxAlong e = box_along(frame, body.points);
  Part part;
  part.shape.kind = ShapeKind::box;
  part.pose.rotation = frame;
  part.pose.translation = body.snap(frame * (0.5 * (e.low + e.high)));
  // The box is {R x + t}, with R orthonormal only to a few units in the last place. R' and the
  // inverse of R differ at a point by less than 16 of them, relative to its distance.
  for (const Vec3d& p : body.points) {
    const Vec3d from = p - part.pose.translation;
    const Vec3d at = (frame.transpose() * from).cwiseAbs();
    part.shape.half_extents =
        part.shape.half_extents.cwiseMax(Vec3d(at + Vec3d::Constant(32 * epsilon * from.norm())));
  }
  return part;
}

Mat3d fitting_axes(const LocalBody& body) {
  const Part box = outer_oriented_box(body);
  Vec3d size = box.shape.half_extents;
  Mat3d axes;
  for (int k = 0; k < 3; ++k) {
    int longest = 0;
    size.maxCoeff(&longest);
    axes.col(k) = box.pose.rotation.col(longest);
    size[longest] = -1;
  }
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return axes;
}

namespace {

// An axis along `direction` (unit) through `beside`, from low to high.
struct Fit {
  Vec3d direction = Vec3d::UnitZ(), beside = Vec3d::Zero();
  double low = 0, high = 0, radius = 0;
  double volume = infinity;
};

double volume_of(double length, double radius) {
  return std::numbers::pi * radius * radius * (length + 4.0 / 3 * radius);
}

// The least capsule around a line; each point is given by its coordinate along the line and its
// distance from it.
Fit fit_on_line(const std::vector<std::pair<double, double>>& along_and_beside, Fit fit) {
  double least = 0, low = along_and_beside.front().first, high = low;
  for (const auto& [along, beside] : along_and_beside) {
    least = std::max(least, beside);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const auto with_radius = [&](double radius) {
    Fit tried = fit;
    tried.radius = radius;
    tried.low = infinity;
    tried.high = -tried.low;
    for (const auto& [along, beside] : along_and_beside) {
      const double ball = std::sqrt(std::max(0.0, radius * radius - beside * beside));
      tried.low = std::min(tried.low, along + ball);
      tried.high = std::max(tried.high, along - ball);
    }
    if (tried.low > tried.high) tried.low = tried.high = 0.5 * (low + high);
    tried.volume = volume_of(tried.high - tried.low, radius);
    return tried;
  };
  double a = least, b = std::hypot(least, 0.5 * (high - low));
  Fit best = with_radius(a);
  for (int step = 0; step < 40; ++step) {
    const Fit first = with_radius(a + 0.382 * (b - a)), second = with_radius(a + 0.618 * (b - a));
    const Fit& better = first.volume < second.volume ? first : second;
    if (better.volume < best.volume) best = better;
    (first.volume < second.volume ? b : a) =
        first.volume < second.volume ? a + 0.618 * (b - a) : a + 0.382 * (b - a);
  }
  return best;
}

Fit fit_along(const Vec3d& direction, const std::vector<Vec3d>& points) {
  std::vector<Vec3d> flat;
  for (const Vec3d& p : points) flat.push_back(p - direction.dot(p) * direction);
  const geometry::Ball disc = geometry::least_ball(flat);
  Fit fit;
  fit.direction = direction;
  fit.beside = disc.centre;
  std::vector<std::pair<double, double>> placed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    placed.emplace_back(direction.dot(points[i]), (flat[i] - disc.centre).norm());
  }
  return fit_on_line(placed, fit);
}

Fit fit_points(const std::vector<Vec3d>& points, const Mat3d& axes) {
  Fit best;
  const auto consider = [&](const Vec3d& direction) {
    const Fit fit = fit_along(direction.normalized(), points);
    if (fit.volume < best.volume) best = fit;
  };
  for (int k = 0; k < 3; ++k) consider(axes.col(k));
  for (double step = 0.2; step > 0.01; step /= 2) {
    for (bool better = true; better;) {
      const double before = best.volume;
      for (int k = 0; k < 3; ++k) {
        for (double turn : {-step, step}) consider(best.direction + turn * axes.col(k));
      }
      better = best.volume < before * (1 - 1e-6);
    }
  }
  return best;
}

Mat3d frame_with_z(const Vec3d& z) {
  int least = 0;
  z.cwiseAbs().minCoeff(&least);
  if (z == Vec3d::UnitZ()) return Mat3d::Identity();
  Mat3d frame;
  const Vec3d x = Vec3d::Unit(least).cross(z).normalized();
  frame << x, z.cross(x).normalized(), z;
  return frame;
}

// Points with the greatest distance from an axis of symmetry along z, one for each rim.
std::vector<Vec3d> outline(const LocalBody& body) {
  const Shape& s = body.shape;
  if (s.kind == ShapeKind::hull) return body.points;
  std::vector<Vec3d> points;
  if (s.kind == ShapeKind::box) {
    for (int i = 0; i < 8; ++i) {
      points.push_back(
          s.half_extents.cwiseProduct(Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    }
    return points;
  }
  points.emplace_back(s.radius, 0, -s.half_length);
  points.emplace_back(s.kind == ShapeKind::cone ? 0 : s.radius, 0, s.half_length);
  return points;
}

// The capsule around an ellipsoid a >= b >= c with its axis along a: the farthest distance from the
// segment to +-s is b or a - s.
Part around_ellipsoid(const Shape& s) {
  int longest = 0, shortest = 0;
  s.radii.maxCoeff(&longest);
  s.radii.minCoeff(&shortest);
  const int between = longest == shortest ? longest : 3 - longest - shortest;
  Part part;
  part.shape.kind = ShapeKind::capsule;
  part.shape.radius = s.radii[between] * (1 + 4 * epsilon);
  part.shape.half_length = std::max(0.0, (s.radii[longest] - s.radii[between]) * (1 + 4 * epsilon));
  part.pose.rotation = frame_with_z(Vec3d::Unit(longest));
  return part;
}

}  // namespace

Part outer_capsule(const LocalBody& body) {
  const Shape& s = body.shape;
  Part part;
  part.shape.kind = ShapeKind::capsule;
  if (s.kind == ShapeKind::sphere || s.kind == ShapeKind::capsule) {
    part.shape.radius = s.radius;
    if (s.kind == ShapeKind::capsule) part.shape.half_length = s.half_length;
    return part;
  }
  if (s.kind == ShapeKind::ellipsoid) return around_ellipsoid(s);
  const std::vector<Vec3d> points = outline(body);
  const bool about_z = s.kind == ShapeKind::cylinder || s.kind == ShapeKind::cone;
  Fit fit;
  if (about_z) {
    fit = fit_on_line({{-s.half_length, s.radius}, {s.half_length, points.back().x()}}, fit);
  } else {
    const bool many = s.kind == ShapeKind::hull;
    fit = fit_points(many ? s.hull->vertices : points, fitting_axes(body));
  }
  const Mat3d frame = frame_with_z(fit.direction);
  const Vec3d axis = frame.col(2);
  const Vec3d centre = body.snap(fit.beside + 0.5 * (fit.low + fit.high) * axis);
  double half = 0.5 * (fit.high - fit.low);
  if (half < 1e-9 * body.size) half = 0;  // a ball
  part.pose = {frame, centre};
  part.shape.half_length = half;
  // The distance to any point of the placed segment; the nearest is not farther.
  for (const Vec3d& p : points) {
    const Vec3d from = p - centre;
    const double at = std::clamp(axis.dot(from), -half, half);
    const double far = (from - at * axis).norm() + 16 * epsilon * (from.norm() + half);
    part.shape.radius = std::max(part.shape.radius, far);
  }
  return part;
}

}  // namespace touchstone::proxies
