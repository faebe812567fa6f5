#include "algorithms/kernels/polytope_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/real_lanes.h"
#include "algorithms/kernels/simplex.h"

namespace touchstone {
namespace {

template <class Scalar>
using Block = typename PolytopeSurface<Scalar>::Block;
template <class Scalar>
using Columns = typename PolytopeSurface<Scalar>::Columns;
template <class Scalar>
struct Triangles {
  const Columns<Scalar>&a, &b, &c;
};

template <class Scalar>
struct Loops {
  int (*least_key)(const Block<Scalar>*, std::size_t);
  void (*seen_from)(const Block<Scalar>*, std::size_t, const Vec3<Scalar>&, Scalar, std::uint32_t*);
  void (*planes_through)(const Triangles<Scalar>&, std::size_t, Columns<Scalar>&, Scalar*);
};

#define TOUCHSTONE_LANES real_lanes
#define TOUCHSTONE_LOOPS "algorithms/kernels/polytope_surface.inl"
#include "algorithms/kernels/every_level.inl"

constexpr std::size_t widest = 16;  // lanes

template <class Scalar>
const Loops<Scalar>& loops() {
  switch (isa()) {
    case Isa::avx512: return avx512::loops<Scalar>;
    case Isa::avx2: return avx2::loops<Scalar>;
    default: return baseline::loops<Scalar>;
  }
}

template <class Scalar>
void set(Columns<Scalar>& columns, std::size_t i, const Vec3<Scalar>& v) {
  columns.x[i] = v.x();
  columns.y[i] = v.y();
  columns.z[i] = v.z();
}

}  // namespace

template <class Scalar>
PolytopeSurface<Scalar>::PolytopeSurface(std::size_t most_vertices) {
  // A closed surface of v vertices has 2 v - 4 triangles.
  const std::size_t blocks = 2 * most_vertices / block_size + 1;
  const std::size_t faces = blocks * block_size;
  vertices_.reserve(most_vertices);
  Block empty{};
  std::ranges::fill(empty.distance, std::numeric_limits<Scalar>::infinity());
  std::ranges::fill(empty.key, std::numeric_limits<Scalar>::infinity());
  blocks_.assign(blocks, empty);
  edges_.resize(4 * faces);
  unused_.reserve(faces);
  visible_.resize(blocks);
  reached_.resize(blocks);
  beyond_.resize(most_vertices);
  ring_.reserve(3 * faces);
  ring_vertex_.reserve(3 * faces);
  places_.reserve(faces);
  for (Columns* columns : {&tails_, &heads_, &tips_, &normals_}) {
    for (std::vector<Scalar>* column : {&columns->x, &columns->y, &columns->z}) {
      column->resize(most_vertices + widest);
    }
  }
  distances_.resize(most_vertices + widest);
}

template <class Scalar>
bool PolytopeSurface<Scalar>::start(const std::array<DifferencePoint<Scalar>, 4>& corners) {
  for (std::size_t i = 0; i < blocks_in_use(); ++i) {
    std::ranges::fill(blocks_[i].distance, std::numeric_limits<Scalar>::infinity());
    std::ranges::fill(blocks_[i].key, std::numeric_limits<Scalar>::infinity());
  }
  unused_.clear();
  vertices_.assign(corners.begin(), corners.end());
  static constexpr std::array<std::array<Edge, 3>, 4> faces = {{{{{0, 6}, {1, 10}, {2, 14}}},
                                                                {{{0, 13}, {3, 8}, {1, 0}}},
                                                                {{{1, 5}, {3, 12}, {2, 1}}},
                                                                {{{2, 9}, {3, 4}, {0, 2}}}}};
  for (int f = 0; f < 4; ++f) {
    std::copy(faces[f].begin(), faces[f].end(), edges_.begin() + 4 * f);
    set(tails_, f, corners[faces[f][0].tail].difference);
    set(heads_, f, corners[faces[f][1].tail].difference);
    set(tips_, f, corners[faces[f][2].tail].difference);
  }
  loops<Scalar>().planes_through({tails_, heads_, tips_}, 4, normals_, distances_.data());
  constexpr Scalar outside = -2 * SupportPair<Scalar>::rounding;
  first_fresh_ = 4;
  for (int f = 0; f < 4; ++f) {
    if (!(distances_[f] >= outside)) return false;
    write_plane(f, f, std::numeric_limits<Scalar>::infinity());
  }
  return true;
}

template <class Scalar>
typename PolytopeSurface<Scalar>::Nearest PolytopeSurface<Scalar>::nearest_face() {
  for (;;) {
    const int face = loops<Scalar>().least_key(blocks_.data(), blocks_in_use());
    const Scalar distance = key(face);
    if (!(distance < std::numeric_limits<Scalar>::infinity())) return {};
    const Scalar measured = distance_of_triangle(face);
    if (!(measured > distance)) return {face, distance};
    key(face) = measured;
  }
}

template <class Scalar>
Scalar PolytopeSurface<Scalar>::distance_of_triangle(int face) const {
  const std::array<Vec3<Scalar>, 3> p = points(corners(face));
  // Twice the areas of the triangles that the origin's projection makes with the edges.
  const Vec3<Scalar> n = normal(face);
  const bool falls_inside =
      n.dot(p[0].cross(p[1])) > 0 && n.dot(p[1].cross(p[2])) > 0 && n.dot(p[2].cross(p[0])) > 0;
  if (falls_inside) return distance(face);
  Simplex<Scalar> triangle;
  triangle.size = 3;
  for (int i = 0; i < 3; ++i) triangle.points[i].difference = p[i];
  return reduce_to_nearest(triangle).distance;
}

template <class Scalar>
bool PolytopeSurface<Scalar>::add(const DifferencePoint<Scalar>& point, int face, Scalar furthest) {
  constexpr Scalar seen_above = SupportPair<Scalar>::rounding / 4;
  loops<Scalar>().seen_from(blocks_.data(), blocks_in_use(), point.difference, seen_above,
                            visible_.data());
  if (!find_horizon()) {
    keep_connected(face);
    if (!find_horizon()) return false;
  }
  if (!find_planes(point.difference)) return false;
  choose_places();
  const int tip = static_cast<int>(vertices_.size());
  vertices_.push_back(point);
  const int count = static_cast<int>(ring_.size());
  for (int i = 0; i < count; ++i) {
    const int next = i + 1 < count ? i + 1 : 0;
    const int last = i > 0 ? i - 1 : count - 1;
    const int first_edge = 4 * places_[i];
    edges_[first_edge] = {ring_vertex_[i], ring_[i]};
    edges_[first_edge + 1] = {ring_vertex_[next], 4 * places_[next] + 2};
    edges_[first_edge + 2] = {tip, 4 * places_[last] + 1};
    edges_[ring_[i]].twin = first_edge;
    write_plane(places_[i], i, furthest);
  }
  return true;
}

// The edges where the point sees no further, in turn. True where they form one ring, which meets
// no vertex twice and not the point.
template <class Scalar>
bool PolytopeSurface<Scalar>::find_horizon() {
  int count = 0;
  int first = -1;
  for (std::size_t i = 0; i < blocks_in_use(); ++i) {
    for (std::uint32_t left = visible_[i]; left != 0; left &= left - 1) {
      const int face = face_at(i, std::countr_zero(left));
      for (int edge = 4 * face; edge < 4 * face + 3; ++edge) {
        if (is_visible(edges_[edge].twin / 4)) continue;
        first = edges_[edge].tail;
        beyond_[first] = edges_[edge].twin;
        ++count;
      }
    }
  }
  if (count < 3) return false;
  ring_.clear();
  ring_vertex_.clear();
  int at = first;
  do {
    ring_vertex_.push_back(at);
    ring_.push_back(beyond_[at]);
    at = edges_[beyond_[at]].tail;
  } while (at != first && --count > 0);
  return at == first && count == 1;
}

// Leaves in `visible_` what is connected with the face.
template <class Scalar>
void PolytopeSurface<Scalar>::keep_connected(int face) {
  std::ranges::fill(reached_, 0);
  const auto reach = [&](int f) {
    std::uint32_t& bits = reached_[block_of(f)];
    const std::uint32_t bit = 1u << lane_of(f);
    if (!is_visible(f) || (bits & bit) != 0) return;
    bits |= bit;
    places_.push_back(f);
  };
  places_.clear();
  reach(face);
  while (!places_.empty()) {
    const int edge = 4 * places_.back();
    places_.pop_back();
    for (int k = 0; k < 3; ++k) reach(edges_[edge + k].twin / 4);
  }
  visible_.swap(reached_);
}

// The planes of the cone from the point over the horizon. False where one has the origin outside.
template <class Scalar>
bool PolytopeSurface<Scalar>::find_planes(const Vec3<Scalar>& point) {
  const std::size_t count = ring_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<Scalar>& tail = vertices_[ring_vertex_[i]].difference;
    if (tail == point) return false;
    set(tails_, i, tail);
    set(heads_, i > 0 ? i - 1 : count - 1, tail);
    set(tips_, i, point);
  }
  loops<Scalar>().planes_through({tails_, heads_, tips_}, count, normals_, distances_.data());
  constexpr Scalar outside = -2 * SupportPair<Scalar>::rounding;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(distances_[i])) {
      const int behind = ring_[i] / 4;
      set(normals_, i, normal(behind));
      distances_[i] = distance(behind);
    }
    if (!(distances_[i] >= outside)) return false;
  }
  return true;
}

// For the faces of the cone: first those of the faces that go.
template <class Scalar>
void PolytopeSurface<Scalar>::choose_places() {
  places_.clear();
  for (std::size_t i = 0; i < blocks_in_use(); ++i) {
    for (std::uint32_t left = visible_[i]; left != 0; left &= left - 1) {
      places_.push_back(face_at(i, std::countr_zero(left)));
    }
  }
  while (places_.size() > ring_.size()) {
    const int gone = places_.back();
    places_.pop_back();
    unused_.push_back(gone);
    block(gone).distance[lane_of(gone)] = std::numeric_limits<Scalar>::infinity();
    set_aside(gone);
  }
  while (places_.size() < ring_.size()) {
    if (unused_.empty()) {
      places_.push_back(first_fresh_++);
    } else {
      places_.push_back(unused_.back());
      unused_.pop_back();
    }
  }
}

template <class Scalar>
void PolytopeSurface<Scalar>::write_plane(int face, int i, Scalar furthest) {
  Block& to = block(face);
  const std::size_t k = lane_of(face);
  to.x[k] = normals_.x[i];
  to.y[k] = normals_.y[i];
  to.z[k] = normals_.z[i];
  to.distance[k] = distances_[i];
  const bool needless = distances_[i] > furthest;
  to.key[k] = needless ? std::numeric_limits<Scalar>::infinity() : distances_[i];
}

template class PolytopeSurface<float>;
template class PolytopeSurface<double>;

}  // namespace touchstone
