// A box or hull prepared for separating-axis tests: vertices, face normals and edges. Used by sat,
// sat-faces, closed-form and clipped-faces.
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

// Point k of the body, in body coordinates (metres), is centre + scale * (x[k], y[k], z[k]). The
// scale is a power of two, so that the stored numbers are about 1 for every size of body. The
// centre is zero unless the body lies far from its own origin.
//
// Normals and edge directions are computed in long double, from the vertices before they are
// rounded to Scalar, so that faces that are slivers, and coordinates rounded to float, do not tilt
// them.
//
// Bodies without volume are solids of zero thickness: a flat hull is a prism (both sides of its
// plane, and its sides), a segment or point a box. Each edge then has two or four arcs of normals
// of 90 degrees, instead of one that cannot be distinguished from its complement.
template <class Scalar>
struct Polytope {
  struct Face {
    Vec3<Scalar> normal;  // outward, unit length
    Scalar offset;        // greatest normal . v over the stored vertices
  };
  // The outward normals at the edge form the arc from left's normal to right's. Its direction is
  // that of left's normal x right's normal.
  struct Edge {
    Vec3<Scalar> direction;  // unit length
    Vec3<Scalar> point;      // one end, in the units of the stored vertices
    std::uint32_t left, right;
  };

  Vec3d centre = Vec3d::Zero();
  double scale = 1;
  Scalar reach = 0;       // upper bound on |v| of the stored vertices
  std::size_t count = 0;  // number of vertices; copies of the first pad the last block
  std::vector<hull_scan::VertexBlock<Scalar>> vertices;
  std::vector<Face> faces;
  std::vector<Edge> edges;
  GaussArcs arcs;  // of the edges, in their order
  // A hull with more vertices gets no faces and edges, since a test along all of them would take
  // seconds.
  static constexpr std::size_t most_vertices = 16384;

  // False if a solid has no faces or is too large: then the axes do not prove an overlap.
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

// The shape must be a box or a hull.
template <class Scalar>
Polytope<Scalar> make_polytope(const Shape& shape);

extern template Polytope<float> make_polytope(const Shape&);
extern template Polytope<double> make_polytope(const Shape&);

}  // namespace touchstone
