// A box or hull made ready for separating-axis tests: vertices, face normals and edges in one form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/shape.h"
#include "algorithms/core/vec.h"
#include "algorithms/kernels/minkowski/hull_scan.h"
#include "algorithms/kernels/sat/gauss_arcs.h"

namespace touchstone {

// Point k of the body, in body coordinates (metres), is centre + scale * (x[k], y[k], z[k]), where
// scale is a power of two, so that the stored numbers are about 1 for every size of body, and
// centre is zero unless the body lies far from its own origin.
//
// The normals and edge directions were computed in long double, from the vertices before they were
// rounded to Scalar: faces that are slivers, and coordinates rounded to float, do not tilt them.
//
// Bodies without volume are solids of zero thickness, which gives each edge two or four arcs of
// normals of 90 degrees instead of one that cannot be told from its complement:
// a flat hull is a prism (both sides of its plane, and its sides), a segment or point a box.
template <class Scalar>
struct Polytope {
  struct Face {
    Vec3<Scalar> normal;  // outward, unit length
    Scalar offset;        // greatest normal . v over the stored vertices
  };
  // The outward normals at the edge are the arc from left's normal to right's, and the direction is
  // that of left's normal x right's normal.
  struct Edge {
    Vec3<Scalar> direction;  // unit length
    Vec3<Scalar> point;      // one end, in the units of the stored vertices
    std::uint32_t left, right;
  };

  Vec3d centre = Vec3d::Zero();
  double scale = 1;
  Scalar reach = 0;       // >= |v| of each stored vertex v
  std::size_t count = 0;  // vertices; behind them the first is repeated up to a whole block
  std::vector<hull_scan::VertexBlock<Scalar>> vertices;
  std::vector<Face> faces;
  std::vector<Edge> edges;
  GaussArcs arcs;  // of the edges, in their order
  // Faces and edges are left out where a hull has more: a test along all of them would take
  // seconds.
  static constexpr std::size_t most_vertices = 16384;

  // False where a solid came without faces, or is too large: then the axes do not prove that bodies
  // overlap.
  bool complete = true;
  bool too_large = false;

  Vec3<Scalar> vertex(std::size_t k) const {
    constexpr std::size_t block = hull_scan::VertexBlock<Scalar>::size;
    return vertices[k / block].vertex(k % block);
  }
  // The greatest direction . v over the stored vertices.
  Scalar support(const Vec3<Scalar>& direction) const {
    return hull_scan::greatest(std::span<const hull_scan::VertexBlock<Scalar>>(vertices),
                               direction);
  }
};

// Of a box or a hull.
template <class Scalar>
Polytope<Scalar> make_polytope(const Shape& shape);

extern template Polytope<float> make_polytope(const Shape&);
extern template Polytope<double> make_polytope(const Shape&);

}  // namespace touchstone
