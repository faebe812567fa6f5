// The oriented box of least volume that the search finds.
#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/proxies/outer_fits.h"

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

}  // namespace touchstone::proxies
