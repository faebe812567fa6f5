// The surface of EPA: horizon, cone and the nearest face.
#include "algorithms/kernels/epa/epa_hull.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {
namespace {

using face_planes::faces_a_word;

// The origin is outside a plane that is nearer to it than this.
template <class Scalar>
constexpr Scalar outside = -2 * SupportPair<Scalar>::rounding;

}  // namespace

template <class Scalar>
EpaHull<Scalar>::EpaHull(std::size_t most_vertices) : planes_(most_vertices) {
  // A closed surface of v vertices has 2 v - 4 triangles.
  const std::size_t blocks = 2 * most_vertices / Block::size + 1;
  const std::size_t faces = blocks * Block::size;
  vertices_.resize(most_vertices);
  Block empty{};
  std::ranges::fill(empty.distance, std::numeric_limits<Scalar>::infinity());
  std::ranges::fill(empty.key, std::numeric_limits<Scalar>::infinity());
  blocks_.assign(blocks, empty);
  edges_.resize(4 * faces);
  unused_.reserve(faces);
  visible_.resize(faces / faces_a_word + 1);
  reached_.resize(visible_.size());
  head_.resize(most_vertices + 1);
  beyond_.resize(most_vertices + 1);
  ring_.resize(most_vertices + 1 + face_planes::overhang);
  places_.resize(faces);
}

template <class Scalar>
bool EpaHull<Scalar>::start(const std::array<DifferencePoint<Scalar>, 4>& corners) {
  for (std::size_t i = 0; i < blocks_in_use().size(); ++i) {
    std::ranges::fill(blocks_[i].distance, std::numeric_limits<Scalar>::infinity());
    std::ranges::fill(blocks_[i].key, std::numeric_limits<Scalar>::infinity());
  }
  unused_.clear();
  std::ranges::copy(corners, vertices_.begin());
  vertex_count_ = first_fresh_ = 4;
  // The cone from corner 2 over the opposite face, which comes last.
  static constexpr Edge edges[4][4] = {{{0, 14}, {1, 6}, {2, 9}},
                                       {{1, 13}, {3, 10}, {2, 1}},
                                       {{3, 12}, {0, 2}, {2, 5}},
                                       {{0, 8}, {3, 4}, {1, 0}}};
  for (int f = 0; f < 4; ++f) std::ranges::copy(edges[f], edges_.begin() + 4 * f);
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  ring_size_ = 1;
  ring_[0] = 0;
  ring_[1] = 3;
  find_planes(vertices_[1].difference, infinity);
  const Vec3<Scalar> base{planes_.x[0], planes_.y[0], planes_.z[0]};
  if (base.dot(vertices_[2].difference) > planes_.distance[0]) {
    std::swap(vertices_[0], vertices_[1]);
    for (auto* column : {&planes_.x, &planes_.y, &planes_.z, &planes_.distance, &planes_.key}) {
      column->front() = -column->front();
    }
  }
  if (!(planes_.distance[0] > outside<Scalar>)) return false;
  write_plane(3, 0);
  ring_size_ = 3;
  std::ranges::copy(std::array{0, 1, 3, 0}, ring_.begin());
  if (!find_planes(vertices_[2].difference, infinity)) return false;
  for (int f = 0; f < 3; ++f) write_plane(f, f);
  return true;
}

template <class Scalar>
typename EpaHull<Scalar>::Nearest EpaHull<Scalar>::nearest_face() {
  for (;;) {
    const int face = face_planes::least_key(blocks_in_use());
    const Scalar distance = key(face);
    if (!(distance < std::numeric_limits<Scalar>::infinity())) return {};
    bool& measured = block(face).measured[lane_of(face)];
    if (measured) return {face, distance};
    measured = true;
    key(face) = std::max(distance, distance_of_triangle(face));
  }
}

template <class Scalar>
Scalar EpaHull<Scalar>::distance_of_triangle(int face) const {
  const std::array<Vec3<Scalar>, 3> corners = points(this->corners(face));
  Simplex<Scalar> triangle;
  triangle.size = 3;
  for (int i = 0; i < 3; ++i) triangle.points[i].difference = corners[i];
  return reduce_to_nearest(triangle).distance;
}

template <class Scalar>
bool EpaHull<Scalar>::add(const DifferencePoint<Scalar>& point, int face, Scalar furthest) {
  constexpr Scalar seen_above = SupportPair<Scalar>::rounding / 4;
  face_planes::seen_from(blocks_in_use(), point.difference, seen_above, visible_.data());
  if (!find_horizon()) {
    keep_connected(face);
    if (!find_horizon()) return false;
  }
  if (!find_planes(point.difference, furthest) && !mend_planes(point.difference)) return false;
  choose_places();
  const int tip = vertex_count_++;
  vertices_[tip] = point;
  const int count = ring_size_;
  int last = places_[count - 1];
  int place = places_[0];
  for (int i = 0; i < count; ++i) {
    const int next = places_[i + 1 < count ? i + 1 : 0];
    const int tail = ring_[i];
    const int twin = beyond_[tail];
    edges_[4 * place] = {tail, twin};
    edges_[4 * place + 1] = {head_[tail], 4 * next + 2};
    edges_[4 * place + 2] = {tip, 4 * last + 1};
    edges_[twin].twin = 4 * place;
    write_plane(place, i);
    last = place;
    place = next;
  }
  return true;
}

// Collects the horizon's edges in order. Returns true if they form one ring that visits no vertex
// twice.
template <class Scalar>
bool EpaHull<Scalar>::find_horizon() {
  int faces = 0;
  int size = 0;
  int first = 0;
  const int elsewhere = vertex_count_;
  const std::size_t slots = static_cast<std::size_t>(first_fresh_);
  for (std::size_t i = 0; i * faces_a_word < slots; ++i) {
    for (std::uint64_t left = visible_[i]; left != 0; left &= left - 1) {
      const int face = static_cast<int>(i * faces_a_word) + std::countr_zero(left);
      places_[faces++] = face;
      for (int edge = 4 * face; edge < 4 * face + 3; ++edge) {
        // The loop has no branch, since the outcome is unpredictable.
        const auto [tail, twin] = edges_[edge];
        const bool on_horizon = !is_visible(face_of(twin));
        const int to = on_horizon ? tail : elsewhere;
        head_[to] = edges_[twin].tail;
        beyond_[to] = twin;
        first = on_horizon ? tail : first;
        size += on_horizon ? 1 : 0;
      }
    }
  }
  visible_count_ = faces;
  ring_size_ = size;
  if (size < 3 || size > elsewhere) return false;
  int at = first;
  bool early = false;
  for (int i = 0; i < size; ++i) {
    early |= i > 0 && at == first;
    ring_[i] = at;
    at = head_[at];
  }
  ring_[size] = first;
  return at == first && !early;
}

// Keeps in `visible_` only the faces connected with `face`.
template <class Scalar>
void EpaHull<Scalar>::keep_connected(int face) {
  std::ranges::fill(reached_, 0);
  int waiting = 0;
  const auto reach = [&](int f) {
    std::uint64_t& bits = reached_[static_cast<std::size_t>(f) / faces_a_word];
    const std::uint64_t bit = std::uint64_t{1} << static_cast<std::size_t>(f) % faces_a_word;
    if (!is_visible(f) || (bits & bit) != 0) return;
    bits |= bit;
    places_[waiting++] = f;
  };
  reach(face);
  while (waiting > 0) {
    const int edge = 4 * places_[--waiting];
    for (int k = 0; k < 3; ++k) reach(face_of(edges_[edge + k].twin));
  }
  visible_.swap(reached_);
}

// Computes the planes of the cone over the horizon. Returns false if one does not exist or has the
// origin outside.
template <class Scalar>
bool EpaHull<Scalar>::find_planes(const Vec3<Scalar>& tip, Scalar furthest) {
  const auto size = static_cast<std::size_t>(ring_size_);
  const face_planes::Cone<Scalar> cone{vertices_.data(), ring_.data(), size, tip};
  return face_planes::planes_through(cone, outside<Scalar>, furthest, planes_);
}

// Gives a face without area the plane of the face behind it. Returns false if a plane has the
// origin outside, or if the tip is on the horizon.
template <class Scalar>
bool EpaHull<Scalar>::mend_planes(const Vec3<Scalar>& tip) {
  for (int i = 0; i < ring_size_; ++i) {
    if (std::isnan(planes_.distance[i])) {
      if (vertices_[ring_[i]].difference == tip) return false;
      const int behind = face_of(beyond_[ring_[i]]);
      const Vec3<Scalar> n = normal(behind);
      planes_.x[i] = n.x();
      planes_.y[i] = n.y();
      planes_.z[i] = n.z();
      planes_.distance[i] = planes_.key[i] = distance(behind);
      planes_.margin[i] = 0;
    }
    if (!(planes_.distance[i] > outside<Scalar>)) return false;
  }
  return true;
}

// Assigns places to the faces of the cone: first those of the removed faces.
template <class Scalar>
void EpaHull<Scalar>::choose_places() {
  for (int i = ring_size_; i < visible_count_; ++i) {
    const int gone = places_[i];
    unused_.push_back(gone);
    block(gone).distance[lane_of(gone)] = std::numeric_limits<Scalar>::infinity();
    set_aside(gone);
  }
  for (int i = visible_count_; i < ring_size_; ++i) {
    if (unused_.empty()) {
      places_[i] = first_fresh_++;
    } else {
      places_[i] = unused_.back();
      unused_.pop_back();
    }
  }
}

template <class Scalar>
void EpaHull<Scalar>::write_plane(int face, int i) {
  Block& to = block(face);
  const std::size_t k = lane_of(face);
  to.x[k] = planes_.x[i];
  to.y[k] = planes_.y[i];
  to.z[k] = planes_.z[i];
  to.distance[k] = planes_.distance[i];
  to.key[k] = planes_.key[i];
  to.measured[k] = planes_.margin[i] > 0;
}

template class EpaHull<float>;
template class EpaHull<double>;

}  // namespace touchstone
