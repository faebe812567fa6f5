// Makes polytopes from boxes and hulls, with normals and edges computed in long double.
#include "algorithms/kernels/sat/polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/sat/planar_hull.h"

namespace touchstone {
namespace {

using Wide = long double;
using Vec = Vec3<Wide>;

// Collects faces and edges in long double, relative to `centre`.
struct Builder {
  struct Edge {
    Vec direction, point;
    std::uint32_t left, right;
  };
  std::vector<Vec> vertices;
  std::vector<Vec> normals;
  std::vector<Edge> edges;
  bool complete = true;

  std::uint32_t add_face(const Vec& normal) {
    normals.push_back(normal);
    return static_cast<std::uint32_t>(normals.size() - 1);
  }
  void add_edge(const Vec& tail, const Vec& head, std::uint32_t left, std::uint32_t right) {
    const Vec along = head - tail;
    const Wide length = along.stableNorm();
    if (length > 0) edges.push_back({along / length, tail, left, right});
  }

  // Adds the box around `middle` along the columns of `frame`.
  void add_box(const Vec& middle, const Mat3<Wide>& frame, const Vec& half) {
    for (int axis = 0; axis < 3; ++axis) {
      add_face(-frame.col(axis));
      add_face(frame.col(axis));
    }
    const auto face = [](int axis, int side) {
      return static_cast<std::uint32_t>(2 * axis + (side > 0 ? 1 : 0));
    };
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      for (const int si : {-1, 1}) {
        for (const int sj : {-1, 1}) {
          // Frame column i x column j is column k: the direction of left x right is si * sj * k.
          const Vec corner = middle + frame.col(i) * (si * half[i]) + frame.col(j) * (sj * half[j]);
          const Vec along = frame.col(k) * (si * sj * half[k]);
          add_edge(corner - along, corner + along, face(i, si), face(j, sj));
        }
      }
    }
  }
};

void build_segment(Builder& out) {
  const Vec p = out.vertices[farthest_from(out.vertices, out.vertices[0])];
  const Vec q = out.vertices[farthest_from(out.vertices, p)];
  const Wide length = (q - p).stableNorm();
  Mat3<Wide> frame = Mat3<Wide>::Identity();
  if (length > 0) {
    frame.col(0) = (q - p) / length;
    frame.col(1) = frame.col(0).unitOrthogonal();
    frame.col(2) = frame.col(0).cross(frame.col(1));
  }
  out.add_box((p + q) / 2, frame, Vec(length / 2, 0, 0));
}

void build_flat(Builder& out) {
  const std::vector<Vec>& points = out.vertices;
  const auto [loop, normal] = planar_hull(points);
  if (normal.isZero(0)) {
    out.complete = false;
    return;
  }
  const std::uint32_t top = out.add_face(normal), bottom = out.add_face(-normal);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec &tail = points[loop[k]], &head = points[loop[(k + 1) % loop.size()]];
    const Vec outward = (head - tail).cross(normal);
    if (!(outward.norm() > 0)) continue;
    const std::uint32_t side = out.add_face(outward.normalized());
    out.add_edge(tail, head, top, side);
    out.add_edge(tail, head, side, bottom);
  }
}

// Twice the area vector of the loop (Newell), so that each vertex counts, or the hull's own normal
// if the area is zero.
Vec face_normal(const std::vector<Vec>& vertices, const Hull::Face& face) {
  Vec area = Vec::Zero();
  const Vec& first = vertices[face.loop[0]];
  for (std::size_t k = 1; k + 1 < face.loop.size(); ++k) {
    area += (vertices[face.loop[k]] - first).cross(vertices[face.loop[k + 1]] - first);
  }
  const Vec stated = face.normal.cast<Wide>();
  const Wide length = area.norm();
  if (!(length > 0)) return stated.normalized();
  return area.dot(stated) < 0 ? Vec(-area / length) : Vec(area / length);
}

void build_solid(Builder& out, const Hull& hull) {
  out.complete = !hull.faces.empty();
  for (const Hull::Face& face : hull.faces) out.add_face(face_normal(out.vertices, face));
  for (const Hull::Edge& edge : hull.edges) {
    out.add_edge(out.vertices[edge.tail], out.vertices[edge.head], edge.left, edge.right);
  }
}

// The greatest normal . v over vertices, for many normals. Doubles find the vertices that can hold
// it, and only those are asked in long double.
class Offsets {
 public:
  explicit Offsets(const std::vector<Vec>& vertices)
      : vertices_(vertices),
        blocks_(hull_scan::blocks_of<double>(vertices.size(), [&](std::size_t k) {
          return vertices[k].template cast<double>().eval();
        })) {
    for (const Vec& v : vertices) reach_ = std::max(reach_, static_cast<double>(v.norm()));
  }

  // `normal` must be a unit vector.
  Wide along(const Vec& normal) const {
    const Vec3<double> n = normal.cast<double>();
    const std::span<const Block> all(blocks_);
    // Each value is off by less than four roundings of the product of a unit vector and the reach.
    const double slack = 8 * std::numeric_limits<double>::epsilon() * reach_;
    const double least = hull_scan::greatest(all, n) - slack;
    Wide offset = normal.dot(vertices_[0]);
    for (std::size_t first = 0; first < all.size(); first += together) {
      const std::size_t count = std::min(together, all.size() - first);
      if (hull_scan::greatest(all.subspan(first, count), n) < least) continue;
      const std::size_t end = std::min((first + count) * Block::size, vertices_.size());
      for (std::size_t k = first * Block::size; k < end; ++k) {
        const Vec3<double> v = blocks_[k / Block::size].vertex(k % Block::size);
        if (n.dot(v) >= least) offset = std::max(offset, normal.dot(vertices_[k]));
      }
    }
    return offset;
  }

 private:
  using Block = hull_scan::VertexBlock<double>;
  static constexpr std::size_t together = 4;

  const std::vector<Vec>& vertices_;
  std::vector<Block> blocks_;
  double reach_ = 0;
};

template <class Scalar>
Polytope<Scalar> finish(const Builder& from) {
  Polytope<Scalar> to;
  to.complete = from.complete;
  to.count = from.vertices.size();
  for (const Vec& v : from.vertices) to.reach = std::max(to.reach, static_cast<Scalar>(v.norm()));
  to.vertices = hull_scan::blocks_of<Scalar>(from.vertices.size(), [&](std::size_t k) {
    return from.vertices[k].template cast<Scalar>().eval();
  });
  const Offsets offsets(from.vertices);
  for (const Vec& normal : from.normals) {
    const auto offset = static_cast<Scalar>(offsets.along(normal));
    to.faces.push_back({normal.template cast<Scalar>(), offset});
  }
  for (const Builder::Edge& edge : from.edges) {
    to.edges.push_back({edge.direction.template cast<Scalar>(), edge.point.template cast<Scalar>(),
                        edge.left, edge.right});
    to.arcs.add({edge.direction.cast<float>(), from.normals[edge.left].cast<float>(),
                 from.normals[edge.right].cast<float>()});
  }
  return to;
}

}  // namespace

template <class Scalar>
Polytope<Scalar> make_polytope(const Shape& shape) {
  Builder builder;
  Vec3d centre = Vec3d::Zero();
  double scale = 1;
  bool too_large = false;
  if (shape.kind == ShapeKind::box) {
    scale = power_of_two_above(shape.half_extents.stableNorm());
    const Vec half = shape.half_extents.cast<Wide>() / scale;
    for (int k = 0; k < 8; ++k) {
      builder.vertices.emplace_back((k & 1) != 0 ? half.x() : -half.x(),
                                    (k & 2) != 0 ? half.y() : -half.y(),
                                    (k & 4) != 0 ? half.z() : -half.z());
    }
    builder.add_box(Vec::Zero(), Mat3<Wide>::Identity(), half);
  } else {
    const Hull& hull = *shape.hull;
    Vec3d low = hull.vertices[0], high = hull.vertices[0];
    for (const Vec3d& v : hull.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    const Vec3d middle = low + (high - low) / 2;
    // A body near its origin gains nothing from another centre, and each query would pay for it.
    if (middle.stableNorm() > (high - low).stableNorm()) centre = middle;
    double reach = 0;
    for (const Vec3d& v : hull.vertices) reach = std::max(reach, (v - centre).stableNorm());
    scale = power_of_two_above(reach);
    for (const Vec3d& v : hull.vertices) {
      builder.vertices.push_back((v.cast<Wide>() - centre.cast<Wide>()) / scale);
    }
    switch (hull.dimension) {
      case 0:
      case 1: build_segment(builder); break;
      case 2: build_flat(builder); break;
      default:
        too_large = hull.vertices.size() > Polytope<Scalar>::most_vertices;
        if (too_large) {
          builder.complete = false;
        } else {
          build_solid(builder, hull);
        }
        break;
    }
  }
  Polytope<Scalar> polytope = finish<Scalar>(builder);
  polytope.too_large = too_large;
  polytope.centre = centre;
  polytope.scale = scale;
  return polytope;
}

template Polytope<float> make_polytope(const Shape&);
template Polytope<double> make_polytope(const Shape&);

}  // namespace touchstone
