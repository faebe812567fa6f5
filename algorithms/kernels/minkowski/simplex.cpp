// The nearest feature of a simplex by signed volumes.
#include "algorithms/kernels/minkowski/simplex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace touchstone {
namespace {

// The nearest point of one feature of a simplex.
template <class Scalar>
struct Feature {
  Scalar distance = std::numeric_limits<Scalar>::infinity();
  Vec3<Scalar> direction = Vec3<Scalar>::Zero();
  int size = 0;
  std::array<int, 3> vertices;
  std::array<Scalar, 3> weights;
};

template <class Scalar>
class Search {
 public:
  explicit Search(const Simplex<Scalar>& simplex) : simplex_(simplex) {}

  const Feature<Scalar>& best() const { return best_; }

  void vertex(int i) {
    const Scalar distance = point(i).norm();
    if (!(distance < best_.distance)) return;
    best_ = {distance,
             distance > 0 ? Vec3<Scalar>(point(i) / distance) : Vec3<Scalar>::Zero(),
             1,
             {i, 0, 0},
             {1, 0, 0}};
  }

  void segment(int i, int j) {
    // The computation starts at the nearer end, which loses fewer digits.
    if (point(i).squaredNorm() > point(j).squaredNorm()) std::swap(i, j);
    const Vec3<Scalar> edge = point(j) - point(i);
    const Scalar along = -point(i).dot(edge);
    const Scalar whole = edge.squaredNorm();
    if (!(along > 0)) return vertex(i);
    if (!(along < whole)) return vertex(j);
    const Scalar weight = along / whole;
    const Vec3<Scalar> nearest = point(i) + weight * edge;
    const Scalar length = nearest.norm();
    Vec3<Scalar> direction = Vec3<Scalar>::Zero();
    if (length > 0) {
      // The subtraction makes a direction from nearly coincident points normal to the edge.
      direction = nearest / length;
      direction -= direction.dot(edge) / whole * edge;
      // If the direction is mostly along the edge, the nearest point is only rounding.
      const Scalar across = direction.norm();
      direction = across > Scalar{0.5} ? Vec3<Scalar>(direction / across) : Vec3<Scalar>::Zero();
    }
    const Scalar distance = std::abs(direction.dot(point(i)));
    if (!(distance < best_.distance)) return;
    best_ = {distance, direction, 2, {i, j, 0}, {1 - weight, weight, 0}};
  }

  void triangle(int i, int j, int k) {
    const std::array<int, 3> v = {i, j, k};
    const std::array<Vec3<Scalar>, 3> corners = {point(i), point(j), point(k)};
    const TrianglePlane<Scalar> plane = triangle_plane(corners);
    std::array<Scalar, 3> w = {-1, -1, -1};
    if (!plane.flat) w = project_origin(plane, corners);
    if (w[0] > 0 && w[1] > 0 && w[2] > 0) {
      const Scalar length = plane.normal.norm();
      const Scalar height = plane.normal.dot(corners[plane.base]) / length;
      const Scalar distance = std::abs(height);
      if (!(distance < best_.distance)) return;
      best_ = {distance, plane.normal / (height < 0 ? -length : length), 3, v, w};
      return;
    }
    // The nearest point is on a side that the projection is beyond. This form of the comparison
    // tries every side for NaN.
    for (int side = 0; side < 3; ++side) {
      if (!(w[side] > 0)) segment(v[(side + 1) % 3], v[(side + 2) % 3]);
    }
  }

  // Returns true if the origin is inside; `depth` is then its least distance from a face.
  bool tetrahedron(Scalar& depth) {
    static constexpr std::array<std::array<int, 4>, 4> faces = {
        {{1, 2, 3, 0}, {0, 2, 3, 1}, {0, 1, 3, 2}, {0, 1, 2, 3}}};
    std::array<bool, 4> beyond{};
    std::array<TrianglePlane<Scalar>, 4> planes;
    bool inside = true;
    bool flat = false;
    for (int f = 0; f < 4; ++f) {
      const auto& [i, j, k, opposite] = faces[f];
      planes[f] = triangle_plane<Scalar>({point(i), point(j), point(k)});
      const Vec3<Scalar>& normal = planes[f].normal;
      const Vec3<Scalar>& base = point(faces[f][planes[f].base]);
      const Scalar side_of_origin = -normal.dot(base);
      const Scalar side_of_vertex = normal.dot(point(opposite) - base);
      constexpr Scalar limit = flat_height<Scalar> * flat_height<Scalar>;
      flat = flat || planes[f].flat ||
             !(side_of_vertex * side_of_vertex > limit * normal.squaredNorm());
      beyond[f] = !(side_of_vertex > 0 ? side_of_origin > 0 : side_of_origin < 0);
      inside = inside && !beyond[f];
    }
    if (inside && !flat) {
      depth = std::numeric_limits<Scalar>::infinity();
      for (int f = 0; f < 4; ++f) {
        const auto& [i, j, k, opposite] = faces[f];
        const std::array<Vec3<Scalar>, 3> corners = {point(i), point(j), point(k)};
        const Scalar height =
            std::abs(planes[f].normal.dot(corners[planes[f].base])) / planes[f].normal.norm();
        depth = std::min(depth, height / lever(project_origin(planes[f], corners)));
      }
      return true;
    }
    for (int f = 0; f < 4; ++f) {
      if (flat || beyond[f]) triangle(faces[f][0], faces[f][1], faces[f][2]);
    }
    return false;
  }

 private:
  const Vec3<Scalar>& point(int i) const { return simplex_.points[i].difference; }

  const Simplex<Scalar>& simplex_;
  Feature<Scalar> best_;
};

}  // namespace

template <class Scalar>
TrianglePlane<Scalar> triangle_plane(const std::array<Vec3<Scalar>, 3>& corners) {
  std::array<Scalar, 3> opposite;  // squared length of the edge opposite a corner
  for (int i = 0; i < 3; ++i) {
    opposite[i] = (corners[(i + 2) % 3] - corners[(i + 1) % 3]).squaredNorm();
  }
  TrianglePlane<Scalar> plane;
  plane.base = opposite[0] >= opposite[1] ? (opposite[0] >= opposite[2] ? 0 : 2)
                                          : (opposite[1] >= opposite[2] ? 1 : 2);
  plane.edge_1 = corners[(plane.base + 1) % 3] - corners[plane.base];
  plane.edge_2 = corners[(plane.base + 2) % 3] - corners[plane.base];
  plane.longest = corners[(plane.base + 2) % 3] - corners[(plane.base + 1) % 3];
  plane.normal = plane.edge_1.cross(plane.edge_2);
  // The product's rounding may point along a needle, where it would tilt the plane most.
  const Scalar length = opposite[plane.base];
  if (length > 0) plane.normal -= plane.normal.dot(plane.longest) / length * plane.longest;
  // The least height is the one over the longest edge.
  constexpr Scalar limit = flat_height<Scalar> * flat_height<Scalar>;
  plane.flat = !(plane.normal.squaredNorm() > limit * length);
  return plane;
}

template <class Scalar>
std::array<Scalar, 3> project_origin(const TrianglePlane<Scalar>& plane,
                                     const std::array<Vec3<Scalar>, 3>& corners) {
  const Vec3<Scalar>& base = corners[plane.base];
  const Scalar area = plane.normal.squaredNorm();
  const Scalar next = plane.normal.dot(plane.edge_2.cross(base)) / area;
  const Scalar last = plane.normal.dot(base.cross(plane.edge_1)) / area;
  std::array<Scalar, 3> weights;
  weights[plane.base] = 1 - next - last;
  // The ends of the longest edge take up the component that these weights leave along it.
  const Vec3<Scalar> left = base + next * plane.edge_1 + last * plane.edge_2;
  const Scalar shift = left.dot(plane.longest) / plane.longest.squaredNorm();
  weights[(plane.base + 1) % 3] = next + shift;
  weights[(plane.base + 2) % 3] = last - shift;
  return weights;
}

template <class Scalar>
Scalar lever(const std::array<Scalar, 3>& weights) {
  return std::abs(weights[0]) + std::abs(weights[1]) + std::abs(weights[2]);
}

template <class Scalar>
NearestPoint<Scalar> reduce_to_nearest(Simplex<Scalar>& simplex) {
  NearestPoint<Scalar> result;
  Search<Scalar> search(simplex);
  switch (simplex.size) {
    case 1: search.vertex(0); break;
    case 2: search.segment(0, 1); break;
    case 3: search.triangle(0, 1, 2); break;
    default:
      result.inside = search.tetrahedron(result.distance);
      if (result.inside) return result;
  }
  const Feature<Scalar> best = search.best();
  bool in_place = true;
  for (int i = 0; i < best.size; ++i) {
    simplex.weights[i] = best.weights[i];
    in_place = in_place && best.vertices[i] == i;
  }
  if (!in_place) {
    const std::array<DifferencePoint<Scalar>, 4> points = simplex.points;
    const std::array<CornerPair, 4> corners = simplex.corners;
    for (int i = 0; i < best.size; ++i) {
      simplex.points[i] = points[best.vertices[i]];
      simplex.corners[i] = corners[best.vertices[i]];
    }
  }
  simplex.size = best.size;
  result.distance = best.distance;
  result.direction = best.direction;
  return result;
}

template NearestPoint<float> reduce_to_nearest(Simplex<float>&);
template NearestPoint<double> reduce_to_nearest(Simplex<double>&);
template TrianglePlane<float> triangle_plane(const std::array<Vec3<float>, 3>&);
template TrianglePlane<double> triangle_plane(const std::array<Vec3<double>, 3>&);
template float lever(const std::array<float, 3>&);
template double lever(const std::array<double, 3>&);
template std::array<float, 3> project_origin(const TrianglePlane<float>&,
                                             const std::array<Vec3<float>, 3>&);
template std::array<double, 3> project_origin(const TrianglePlane<double>&,
                                              const std::array<Vec3<double>, 3>&);

}  // namespace touchstone
