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
using Planes = typename PolytopeSurface<Scalar>::Planes;
template <class Scalar>
struct Triangles {
  const Columns<Scalar>&a, &b, &c;
};

template <class Scalar>
struct Loops {
  int (*least_key)(const Block<Scalar>*, std::size_t);
  void (*seen_from)(const Block<Scalar>*, std::size_t, const Vec3<Scalar>&, Scalar, std::uint64_t*);
  bool (*planes_through)(const Triangles<Scalar>&, std::size_t, Scalar, Scalar, Planes<Scalar>&);
};

// A plane through corners that rounding r moves tilts by r / h where h is the triangle's least
// height. So it moves the nearest point, and that point's distance is off by r^2 / h^2: no more
// than rounding where h^2 exceeds this.
template <class Scalar>
constexpr Scalar uncertain = 16 * SupportPair<Scalar>::rounding;

// A word has a bit for each face of so many.
constexpr std::size_t blocks_a_word = 4;

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

// The origin is beyond a plane with such a distance.
template <class Scalar>
constexpr Scalar outside = -2 * SupportPair<Scalar>::rounding;

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
  visible_.resize(blocks / blocks_a_word + 1);
  reached_.resize(visible_.size());
  head_.resize(most_vertices + 1);
  beyond_.resize(most_vertices + 1);
  ring_.resize(most_vertices);
  places_.resize(faces);
  for (Columns* columns : {&tails_, &heads_, &tips_, &planes_.normals}) {
    for (std::vector<Scalar>* column : {&columns->x, &columns->y, &columns->z}) {
      column->resize(most_vertices + widest);
    }
  }
  planes_.distances.resize(most_vertices + widest);
  planes_.keys.resize(most_vertices + widest);
  planes_.margins.resize(most_vertices + widest);
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
  first_fresh_ = 4;
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  if (!loops<Scalar>().planes_through({tails_, heads_, tips_}, 4, outside<Scalar>, infinity,
                                      planes_)) {
    return false;
  }
  for (int f = 0; f < 4; ++f) write_plane(f, f);
  return true;
}

template <class Scalar>
typename PolytopeSurface<Scalar>::Nearest PolytopeSurface<Scalar>::nearest_face() {
  for (;;) {
    const int face = loops<Scalar>().least_key(blocks_.data(), blocks_in_use());
    const Scalar distance = key(face);
    if (!(distance < std::numeric_limits<Scalar>::infinity())) return {};
    bool& measured = block(face).measured[lane_of(face)];
    if (measured) return {face, distance};
    measured = true;
    key(face) = std::max(distance, distance_of_triangle(face));
  }
}

template <class Scalar>
Scalar PolytopeSurface<Scalar>::distance_of_triangle(int face) const {
  const std::array<Vec3<Scalar>, 3> corners = points(this->corners(face));
  Simplex<Scalar> triangle;
  triangle.size = 3;
  for (int i = 0; i < 3; ++i) triangle.points[i].difference = corners[i];
  return reduce_to_nearest(triangle).distance;
}

template <class Scalar>
bool PolytopeSurface<Scalar>::add(const DifferencePoint<Scalar>& point, int face, Scalar furthest) {
  constexpr Scalar seen_above = SupportPair<Scalar>::rounding / 4;
  loops<Scalar>().seen_from(blocks_.data(), blocks_in_use(), point.difference, seen_above,
                            visible_.data());
  if (!find_horizon(point.difference)) {
    keep_connected(face);
    if (!find_horizon(point.difference)) return false;
  }
  if (!find_planes(furthest)) return false;
  choose_places();
  const int tip = static_cast<int>(vertices_.size());
  vertices_.push_back(point);
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

// The edges where the point sees no further, in turn, and the triangles over them. True where they
// form one ring, which meets no vertex twice.
template <class Scalar>
bool PolytopeSurface<Scalar>::find_horizon(const Vec3<Scalar>& point) {
  int faces = 0;
  int size = 0;
  int first = 0;
  const int elsewhere = static_cast<int>(vertices_.size());
  const std::size_t words = (blocks_in_use() + blocks_a_word - 1) / blocks_a_word;
  for (std::size_t i = 0; i < words; ++i) {
    for (std::uint64_t left = visible_[i]; left != 0; left &= left - 1) {
      const int face = static_cast<int>(64 * i) + std::countr_zero(left);
      places_[faces++] = face;
      for (int edge = 4 * face; edge < 4 * face + 3; ++edge) {
        // Without a branch, as there is no telling.
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
    set(tails_, i, vertices_[at].difference);
    at = head_[at];
    set(heads_, i, vertices_[at].difference);
    set(tips_, i, point);
  }
  return at == first && !early;
}

// Leaves in `visible_` what is connected with the face.
template <class Scalar>
void PolytopeSurface<Scalar>::keep_connected(int face) {
  std::ranges::fill(reached_, 0);
  int waiting = 0;
  const auto reach = [&](int f) {
    std::uint64_t& bits = reached_[f >> 6];
    const std::uint64_t bit = std::uint64_t{1} << (f & 63);
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

// The planes of the cone over the horizon. False where one has the origin outside, or the point is
// on the horizon.
template <class Scalar>
bool PolytopeSurface<Scalar>::find_planes(Scalar furthest) {
  const bool good = loops<Scalar>().planes_through({tails_, heads_, tips_}, ring_size_,
                                                   outside<Scalar>, furthest, planes_);
  if (good) return true;
  for (int i = 0; i < ring_size_; ++i) {
    if (std::isnan(planes_.distances[i])) {
      const bool meets =
          tails_.x[i] == tips_.x[i] && tails_.y[i] == tips_.y[i] && tails_.z[i] == tips_.z[i];
      if (meets) return false;
      const int behind = face_of(beyond_[ring_[i]]);
      set(planes_.normals, i, normal(behind));
      planes_.distances[i] = planes_.keys[i] = distance(behind);
      planes_.margins[i] = 0;
    }
    if (!(planes_.distances[i] > outside<Scalar>)) return false;
  }
  return true;
}

// For the faces of the cone: first those of the faces that go.
template <class Scalar>
void PolytopeSurface<Scalar>::choose_places() {
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
void PolytopeSurface<Scalar>::write_plane(int face, int i) {
  Block& to = block(face);
  const std::size_t k = lane_of(face);
  to.x[k] = planes_.normals.x[i];
  to.y[k] = planes_.normals.y[i];
  to.z[k] = planes_.normals.z[i];
  to.distance[k] = planes_.distances[i];
  to.key[k] = planes_.keys[i];
  to.measured[k] = planes_.margins[i] > 0;
}

template class PolytopeSurface<float>;
template class PolytopeSurface<double>;

}  // namespace touchstone
