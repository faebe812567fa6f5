// The surface of a convex polytope that has the origin inside, while points are added to it.
//
// Its faces are triangles. A point takes the place of the faces that it sees with the cone over
// their horizon.
// Paper:   Barber, Dobkin, Huhdanpaa, "The quickhull algorithm for convex hulls", ACM TOMS 22(4),
// 1996 (horizon, cone). Departs: the visible faces are found among all faces and not by a walk from
// one of them; the horizon is checked to be one closed ring, and all planes of the cone are known,
// before anything is changed. A face without an area lies in its neighbour's plane.
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
  // Memory for that many vertices is taken here, and none later on.
  explicit EpaHull(std::size_t most_vertices);

  // Begins with a tetrahedron that has the origin inside or, up to rounding, on it. False where a
  // face has no plane or the origin is outside of it.
  bool start(const std::array<DifferencePoint<Scalar>, 4>& corners);

  struct Nearest {
    int face = -1;                                              // -1: all were set aside
    Scalar distance = std::numeric_limits<Scalar>::infinity();  // no more than the triangle's
  };
  // The face that is nearest to the origin. Planes are never further than their triangles, so they
  // serve until one comes up.
  Nearest nearest_face();
  void set_aside(int face) { key(face) = std::numeric_limits<Scalar>::infinity(); }

  // Adds a point that the face sees; new faces further from the origin than `furthest` are set
  // aside. False, and nothing changed, where rounding leaves no proper horizon or cone.
  bool add(const DifferencePoint<Scalar>& point, int face, Scalar furthest);

  Vec3<Scalar> normal(int face) const { return block(face).normal(lane_of(face)); }
  // Of the face's plane from the origin.
  Scalar distance(int face) const { return block(face).distance[lane_of(face)]; }
  // Anticlockwise seen from outside.
  std::array<int, 3> corners(int face) const {
    return {edges_[4 * face].tail, edges_[4 * face + 1].tail, edges_[4 * face + 2].tail};
  }
  const DifferencePoint<Scalar>& vertex(int i) const { return vertices_[i]; }
  std::array<Vec3<Scalar>, 3> points(const std::array<int, 3>& corners) const {
    return {vertices_[corners[0]].difference, vertices_[corners[1]].difference,
            vertices_[corners[2]].difference};
  }
  // Calls visit(face) for each face until it returns false; false then.
  template <class Visit>
  bool all_faces(const Visit& visit) const {
    for (int f = 0; f < first_fresh_; ++f) {
      if (distance(f) < std::numeric_limits<Scalar>::infinity() && !visit(f)) return false;
    }
    return true;
  }

 private:
  using Block = face_planes::Block<Scalar>;
  // Edge k of face f, from its corner k to the next, is number 4 f + k.
  struct Edge {
    int tail;  // the corner
    int twin;  // the edge of the neighbour, which goes back
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
  int first_fresh_ = 0;      // this face and those behind it were never used
  std::vector<int> unused_;  // faces before it
  // Of the point that is being added: bits of the faces that it sees, and where the cone's faces
  // go, first in their places; for each vertex on the horizon where the edge leads that begins
  // there, and its twin, of a face that stays; the vertices in turn, the first of them also last;
  // the cone's planes.
  std::vector<std::uint64_t> visible_, reached_;
  std::vector<int> places_, head_, beyond_, ring_;
  int visible_count_ = 0;
  int ring_size_ = 0;
  face_planes::ConePlanes<Scalar> planes_;
};

}  // namespace touchstone
