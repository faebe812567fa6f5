// The hull of EPA: a convex polytope of triangles around the origin, to which points are added.
// Used by expanding_polytope.h and by `smooth`.
// Paper:   Barber, Dobkin, Huhdanpaa, "The quickhull algorithm for convex hulls", ACM TOMS 22(4),
//          1996 (horizon, cone).
// Steps:   1. Start with a tetrahedron (`start`).
//          2. To add a point, find the faces that it sees: those whose plane is below it
//             (face_planes).
//          3. Collect the edges between visible and other faces, the horizon, and check that they
//             form one closed ring (`find_horizon`). If not, keep only the visible faces connected
//             with the given face and try again.
//          4. Compute the planes of all triangles from the point to the ring, the cone
//             (`find_planes`). A triangle without area takes the plane of its neighbour
//             (`mend_planes`).
//          5. If the horizon and all planes are valid, write the cone into the places of the
//             visible faces.
//          6. For the nearest face, take the least plane distance; replace it by the triangle's own
//             distance and search again until the least is a triangle's (`nearest_face`).
// Departs: visible faces are found among all faces instead of by a walk from one of them. Nothing
//          changes before the horizon and all planes of the cone are known to be valid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/kernels/epa/face_planes.h"

namespace touchstone {

template <class Scalar>
class EpaHull {
 public:
  // Allocates memory for `most_vertices` vertices; nothing is allocated later.
  explicit EpaHull(std::size_t most_vertices);

  // Starts with a tetrahedron that contains the origin, possibly on its surface up to rounding.
  // Returns false if a face has no plane or the origin is outside it.
  bool start(const std::array<DifferencePoint<Scalar>, 4>& corners);

  struct Nearest {
    int face = -1;                                              // -1: all faces are set aside
    Scalar distance = std::numeric_limits<Scalar>::infinity();  // at most the triangle's
  };
  // Returns the face nearest to the origin. A plane is never farther than its triangle, so the
  // triangle's distance is computed only for faces that reach the front.
  Nearest nearest_face();
  void set_aside(int face) { key(face) = std::numeric_limits<Scalar>::infinity(); }

  // Adds a point that the face sees. New faces farther from the origin than `furthest` are set
  // aside. Returns false and changes nothing if rounding leaves no proper horizon or cone.
  bool add(const DifferencePoint<Scalar>& point, int face, Scalar furthest);

  Vec3<Scalar> normal(int face) const { return block(face).normal(lane_of(face)); }
  // Distance of the face's plane from the origin.
  Scalar distance(int face) const { return block(face).distance[lane_of(face)]; }
  // Vertices, anticlockwise seen from outside.
  std::array<int, 3> corners(int face) const {
    return {edges_[4 * face].tail, edges_[4 * face + 1].tail, edges_[4 * face + 2].tail};
  }
  // The face beyond edge k of the face, from its corner k to the next.
  int neighbour(int face, int k) const { return face_of(edges_[4 * face + k].twin); }
  // The faces that the last point brought.
  std::span<const int> newest_faces() const {
    return {places_.data(), static_cast<std::size_t>(ring_size_)};
  }
  // All faces are below this.
  std::size_t face_capacity() const { return places_.size(); }
  const DifferencePoint<Scalar>& vertex(int i) const { return vertices_[i]; }
  std::array<Vec3<Scalar>, 3> points(const std::array<int, 3>& corners) const {
    return {vertices_[corners[0]].difference, vertices_[corners[1]].difference,
            vertices_[corners[2]].difference};
  }
  // Calls visit(face) for each face until it returns false, and then returns false.
  template <class Visit>
  bool all_faces(const Visit& visit) const {
    for (int f = 0; f < first_fresh_; ++f) {
      if (distance(f) < std::numeric_limits<Scalar>::infinity() && !visit(f)) return false;
    }
    return true;
  }

 private:
  using Block = face_planes::Block<Scalar>;
  // Edge k of face f leads from its corner k to the next corner and has the index 4 f + k.
  struct Edge {
    int tail;  // the corner
    int twin;  // the reverse edge, of the neighbour
  };

  static std::size_t block_of(int face) { return static_cast<unsigned>(face) / Block::size; }
  static std::size_t lane_of(int face) { return static_cast<unsigned>(face) % Block::size; }
  Block& block(int face) { return blocks_[block_of(face)]; }
  const Block& block(int face) const { return blocks_[block_of(face)]; }
  Scalar& key(int face) { return block(face).key[lane_of(face)]; }
  static int face_of(int edge) { return edge >> 2; }
  bool is_visible(int face) const {
    const auto f = static_cast<std::size_t>(face);
    return (visible_[f / face_planes::faces_a_word] >> f % face_planes::faces_a_word & 1) != 0;
  }
  std::span<const Block> blocks_in_use() const {
    const auto faces = static_cast<std::size_t>(first_fresh_);
    return {blocks_.data(), (faces + Block::size - 1) / Block::size};
  }
  Scalar distance_of_triangle(int face) const;
  bool find_horizon();
  void keep_connected(int face);
  bool find_planes(const Vec3<Scalar>& tip, Scalar furthest);
  bool mend_planes(const Vec3<Scalar>& tip);
  void choose_places();
  void write_plane(int face, int i);

  std::vector<DifferencePoint<Scalar>> vertices_;
  int vertex_count_ = 0;
  std::vector<Block> blocks_;
  std::vector<Edge> edges_;
  int first_fresh_ = 0;      // this face and all later ones were never used
  std::vector<int> unused_;  // free faces before first_fresh_
  // Scratch memory for the point that is being added. visible_: bits of the faces that it sees.
  // places_: where the faces of the cone are stored. head_, beyond_: for each vertex on the
  // horizon, the end of the edge that begins there, and its twin in a face that stays. ring_: the
  // horizon's vertices in order, with the first repeated at the end.
  std::vector<std::uint64_t> visible_, reached_;
  std::vector<int> places_, head_, beyond_, ring_;
  int visible_count_ = 0;
  int ring_size_ = 0;
  face_planes::ConePlanes<Scalar> planes_;
};

}  // namespace touchstone
