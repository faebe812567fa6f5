// Part of gjk-lanes: the faces of a convex polytope with few vertices, as triangles of vertex
// indices, while vertices are added. The vertices' positions are kept in lane_expand.inl. Includes
// the standard library only.
// Paper:   Barber, Dobkin, Huhdanpaa, "The quickhull algorithm for convex hulls", ACM TOMS 22(4),
//          1996 (horizon, cone).
// Departs: faces do not store their neighbours. For each vertex of the removed faces a word toggles
//          the other ends of their edges, face by face; the two bits that remain are its neighbours
//          on the horizon. The method needs no search and few unpredictable branches.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace touchstone {

class BitsetHull {
 public:
  static constexpr std::size_t most_vertices = 64, most_faces = 128;
  using Faces = std::array<std::uint64_t, 2>;  // a bit a face
  using Corners = std::array<std::uint8_t, 3>;

  // The faces that start() makes.
  static constexpr std::array<Corners, 4> tetrahedron = {
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

  // The result of add(): the horizon with its first vertex repeated at the end; the places of the
  // faces from each of its edges to the new vertex; and, behind those, the places of removed faces.
  struct Cone {
    std::size_t size = 0, gone = 0;
    std::array<std::uint8_t, most_vertices + 1> ring{};
    std::array<std::uint8_t, most_faces> places{};
  };

  std::size_t vertices() const { return vertices_; }
  // Upper bound on the indices of faces; removed faces are included.
  std::size_t faces() const { return faces_; }
  // Vertices, anticlockwise seen from outside.
  const Corners& corners(std::size_t face) const { return corners_[face]; }
  const Cone& cone() const { return cone_; }

  // Starts with the tetrahedron of vertices 0 to 3. From vertex 3 the triangle 0, 1, 2 must be
  // anticlockwise.
  void start() {
    vertices_ = faces_ = tetrahedron.size();
    std::ranges::copy(tetrahedron, corners_.begin());
  }

  // Adds a vertex that sees these faces. Requires vertices() < most_vertices. Returns false if the
  // faces do not form a disc, which rounding may cause; the hull is then invalid until start() is
  // called.
  bool add(const Faces& seen) {
    std::uint64_t touched = 0;
    std::size_t visible = 0;
    for (std::size_t word = 0; word < seen.size(); ++word) {
      for (std::uint64_t left = seen[word]; left != 0; left &= left - 1) {
        const auto face =
            static_cast<std::uint8_t>(64 * word + static_cast<std::size_t>(std::countr_zero(left)));
        cone_.places[visible++] = face;
        const auto [a, b, c] = corners_[face];
        neighbours_[a] ^= bit(b) | bit(c);
        neighbours_[b] ^= bit(c) | bit(a);
        neighbours_[c] ^= bit(a) | bit(b);
        touched |= bit(a) | bit(b) | bit(c);
      }
    }
    if (!trace_horizon(visible, touched)) {
      for (; touched != 0; touched &= touched - 1) neighbours_[std::countr_zero(touched)] = 0;
      return false;
    }
    const auto tip = static_cast<std::uint8_t>(vertices_++);
    for (std::size_t i = visible; i < cone_.size; ++i) {
      cone_.places[i] = static_cast<std::uint8_t>(faces_++);
    }
    cone_.gone = visible > cone_.size ? visible - cone_.size : 0;
    for (std::size_t i = 0; i < cone_.size; ++i) {
      corners_[cone_.places[i]] = {cone_.ring[i], cone_.ring[i + 1], tip};
    }
    return true;
  }

 private:
  static std::uint64_t bit(std::size_t vertex) { return std::uint64_t{1} << vertex; }

  // Follows the horizon from an edge of the first face on it. Returns true if the horizon is one
  // ring that visits no vertex twice, with all visible faces on one side.
  bool trace_horizon(std::size_t visible, std::uint64_t touched) {
    std::size_t tail = 0, at = 0;
    bool found = false;
    for (std::size_t i = 0; i < visible && !found; ++i) {
      const Corners& corners = corners_[cone_.places[i]];
      for (std::size_t k = 0; k < 3 && !found; ++k) {
        tail = corners[k];
        at = corners[k < 2 ? k + 1 : 0];
        found = (neighbours_[tail] & bit(at)) != 0;
      }
    }
    if (!found) return false;
    const std::uint64_t at_tail = neighbours_[tail];
    const std::uint64_t second = bit(at);
    std::size_t before = tail, size = 0;
    cone_.ring[size++] = static_cast<std::uint8_t>(tail);
    while (at != tail) {
      const std::uint64_t next = neighbours_[at] & ~bit(before);
      if (!std::has_single_bit(next)) return false;
      neighbours_[at] = 0;
      cone_.ring[size++] = static_cast<std::uint8_t>(at);
      before = at;
      at = static_cast<std::size_t>(std::countr_zero(next));
    }
    neighbours_[tail] = 0;
    cone_.ring[size] = static_cast<std::uint8_t>(tail);
    cone_.size = size;
    // Euler's formula: a disc of triangles has as many faces as vertices on its rim, minus two,
    // plus two for each vertex inside. A second ring would change these numbers.
    const auto inside = static_cast<std::size_t>(std::popcount(touched)) - size;
    return at_tail == (second | bit(before)) && visible + 2 == size + 2 * inside;
  }

  std::size_t vertices_ = 0, faces_ = 0;
  std::array<Corners, most_faces> corners_{};
  std::array<std::uint64_t, most_vertices> neighbours_{};  // zero between the calls
  Cone cone_;
};

}  // namespace touchstone
