// Builds the cube map: divides each face of the cube and keeps the vertices that may be furthest
// there.
#include "algorithms/kernels/minkowski/support_cube_map.h"

#include <algorithm>
#include <numeric>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

// Some vertices by coordinate, with their places, ascending. Copies of the last vertex pad them to
// a multiple of eight, the lanes of the widest vectors.
struct Vertices {
  std::vector<double> x, y, z;
  std::vector<std::uint32_t> places;
  std::size_t size = 0;

  std::size_t rounded_size() const { return (size + 7) / 8 * 8; }
  void reserve(std::size_t count) {
    for (std::vector<double>* numbers : {&x, &y, &z}) numbers->resize(count + 8);
    places.resize(count + 8);
  }
  void clear() { size = 0; }
  void add(const Vertices& from, std::size_t i) { copy(from, i, size++); }
  void fill_up() {
    for (std::size_t k = size; k < rounded_size(); ++k) copy(*this, size - 1, k);
  }

 private:
  void copy(const Vertices& from, std::size_t i, std::size_t k) {
    x[k] = from.x[i];
    y[k] = from.y[i];
    z[k] = from.z[i];
    places[k] = from.places[i];
  }
};

// Heights of five vertices in the directions of a cell's four corners.
using Bars = std::array<std::array<double, 4>, 5>;

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/minkowski/support_cube_map.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

// A vertex dominates another in all directions of a cell if it is further, by more than rounding,
// in the directions of the cell's corners, since all others are sums of these with positive
// weights. A vertex dominated at all four corners of a cell can be skipped: its dominator, or one
// that dominates that, is kept.
template <class Scalar>
struct SupportCubeMap<Scalar>::Builder {
  SupportCubeMap& to;
  double margin = 0;  // more than rounding, for directions whose greatest component is 1
  double leeway = 0;  // how far outside a cell a direction may be that rounding assigns to it
  std::size_t most_listed = 0;

  // The vertices that may be furthest somewhere in a part of a face, for each depth of the
  // division.
  std::vector<Vertices> parts;
  std::array<std::vector<double>, 4> along;

  // Halves the vertices across their longest side, at multiples of a block.
  static void sort_by_place(std::span<std::uint32_t> numbers, std::span<const Vec3d> vertices) {
    if (numbers.size() <= block_size) return;
    Vec3d low = vertices[numbers[0]], high = low;
    for (const std::uint32_t i : numbers) {
      low = low.cwiseMin(vertices[i]);
      high = high.cwiseMax(vertices[i]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t blocks = (numbers.size() + block_size - 1) / block_size;
    const std::size_t half = blocks / 2 * block_size;
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(half);
    std::nth_element(numbers.begin(), middle, numbers.end(), [&](std::uint32_t i, std::uint32_t j) {
      return vertices[i][axis] < vertices[j][axis];
    });
    sort_by_place(numbers.first(half), vertices);
    sort_by_place(numbers.subspan(half), vertices);
  }

  void place(std::span<const Vec3<Scalar>> vertices) {
    std::vector<Vec3d> given;
    Vec3d low = vertices[0].template cast<double>(), high = low, reach = Vec3d::Zero();
    for (const Vec3<Scalar>& vertex : vertices) {
      given.push_back(vertex.template cast<double>());
      low = low.cwiseMin(given.back());
      high = high.cwiseMax(given.back());
      reach = reach.cwiseMax(given.back().cwiseAbs());
    }
    constexpr double flattest = 1. / 1024;
    const Vec3d size = high - low;
    const double longest = size.maxCoeff();
    const double shortest = std::max(size.minCoeff(), flattest * longest);
    for (int k = 0; k < 3 && shortest > 0; ++k) {
      const double ratio = std::max(size[k] / shortest, 1.);
      to.stretch_[static_cast<std::size_t>(k)] =
          static_cast<Scalar>(std::exp2(std::round(std::log2(ratio))));
    }
    for (int k = 0; k < 3; ++k) {
      const auto stretch = static_cast<double>(to.stretch_[static_cast<std::size_t>(k)]);
      margin +=
          16 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * reach[k] / stretch;
    }
    to.numbers_.resize(vertices.size());
    std::iota(to.numbers_.begin(), to.numbers_.end(), 0);
    sort_by_place(to.numbers_, given);
    to.blocks_.resize((vertices.size() + block_size - 1) / block_size);
    to.numbers_.resize(to.blocks_.size() * block_size, to.numbers_.back());
    for (std::size_t k = 0; k < to.numbers_.size(); ++k) {
      const Vec3<Scalar>& v = vertices[to.numbers_[k]];
      Block& block = to.blocks_[k / block_size];
      block.x[k % block_size] = v.x();
      block.y[k % block_size] = v.y();
      block.z[k % block_size] = v.z();
    }
    parts.resize(1);
    parts[0].reserve(vertices.size());
    for (; parts[0].size < vertices.size(); ++parts[0].size) {
      const std::size_t k = parts[0].size;
      const Vec3d& v = given[to.numbers_[k]];
      parts[0].x[k] = v.x();
      parts[0].y[k] = v.y();
      parts[0].z[k] = v.z();
      parts[0].places[k] = static_cast<std::uint32_t>(k);
    }
    parts[0].fill_up();
    for (std::vector<double>& numbers : along) numbers.resize(parts[0].x.size());
  }

  // Returns true if the lists have room for this many cells.
  bool divide(unsigned bits) {
    to.bits_ = bits;
    const auto side = static_cast<Scalar>(1u << bits);
    to.half_side_ = side / 2;
    to.last_ = side - 1;
    to.cells_.resize(std::size_t{6} << 2 * bits);
    to.lists_.clear();
    leeway = std::ldexp(1., -8 - static_cast<int>(bits));
    parts.resize(bits + 2);
    for (Vertices& part : parts) part.reserve(parts[0].size);
    for (std::size_t face = 0; face < 6; ++face) {
      if (!divide(face, 0, 0, 0)) return false;
    }
    return true;
  }

  // Divides the square (u, v) at this depth.
  bool divide(std::size_t face, unsigned depth, std::size_t u, std::size_t v) {
    const Vertices& part = sift(face, depth, u, v);
    if (depth == to.bits_) return write(part, to.cells_[(((face << depth) + v) << depth) + u]);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!divide(face, depth + 1, 2 * u + k % 2, 2 * v + k / 2)) return false;
    }
    return true;
  }

  Vec3d direction(std::size_t face, double u, double v) const {
    const std::size_t axis = face / 2;
    Vec3d d;
    const auto set = [&](std::size_t k, double x) {
      d[static_cast<Eigen::Index>(k % 3)] = x / static_cast<double>(to.stretch_[k % 3]);
    };
    set(axis, face % 2 == 0 ? 1 : -1);
    set(axis + 1, u);
    set(axis + 2, v);
    return d;
  }

  const Vertices& sift(std::size_t face, unsigned depth, std::size_t u, std::size_t v) {
    const double width = std::ldexp(2., -static_cast<int>(depth));
    const auto end = [&](std::size_t at, bool upper) {
      const double edge = static_cast<double>(at + (upper ? 1 : 0)) * width - 1;
      return edge + (upper ? leeway : -leeway);
    };
    std::array<Vec3d, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = direction(face, end(u, k % 2 != 0), end(v, k / 2 != 0));
    }
    Vertices& part = parts[depth + 1];
    switch (isa()) {
      case Isa::avx512:
        sift_with(avx512::measure_at, avx512::sift_at, parts[depth], corners, part);
        break;
      case Isa::avx2:
        sift_with(avx2::measure_at, avx2::sift_at, parts[depth], corners, part);
        break;
      default: sift_with(baseline::measure_at, baseline::sift_at, parts[depth], corners, part);
    }
    return part;
  }
  template <class Measure, class Sift>
  void sift_with(const Measure& measure, const Sift& sift_by, const Vertices& from,
                 const std::array<Vec3d, 4>& corners, Vertices& part) {
    Bars bars = measure(from, corners, along);
    for (std::array<double, 4>& bar : bars) {
      for (double& x : bar) x -= margin;
    }
    sift_by(from, bars, along, part);
  }

  bool write(const Vertices& part, Cell& cell) {
    std::vector<std::uint16_t>& lists = to.lists_;
    const std::size_t begin = lists.size();
    lists.push_back(0);
    for (const std::uint32_t place : std::span(part.places).first(part.size)) {
      const auto block = static_cast<std::uint16_t>(place / block_size);
      if (lists.size() == begin + 1 || lists.back() != block) lists.push_back(block);
    }
    const std::size_t count = lists.size() - begin - 1;
    if (count > 4) {
      lists[begin] = static_cast<std::uint16_t>(count);
      cell.blocks = {static_cast<std::uint16_t>(begin & 0xffff),
                     static_cast<std::uint16_t>(begin >> 16), 0, Cell::listed};
      return lists.size() <= most_listed;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      cell.blocks[k] = lists[begin + 1 + std::min(k, count - 1)];
    }
    lists.resize(begin);
    return true;
  }
};

template <class Scalar>
SupportCubeMap<Scalar>::SupportCubeMap(std::span<const Vec3<Scalar>> vertices) {
  Builder builder{.to = *this, .parts = {}, .along = {}};
  builder.place(vertices);
  // There are about as many cells as vertices, and fewer if many vertices are furthest in many of
  // the cells.
  unsigned bits = 0;
  while (std::size_t{12} << 2 * bits < vertices.size()) ++bits;
  builder.most_listed = 2 * vertices.size();
  while (!builder.divide(bits) && bits > 0) --bits;
  lists_.shrink_to_fit();
}

template <class Scalar>
typename SupportCubeMap<Scalar>::Found SupportCubeMap<Scalar>::furthest(
    const Vec3<Scalar>& direction) const {
  const Scalar x = direction.x(), y = direction.y(), z = direction.z();
  switch (isa()) {
    case Isa::avx512: return avx512::furthest_at(*this, x, y, z);
    case Isa::avx2: return avx2::furthest_at(*this, x, y, z);
    default: return baseline::furthest_at(*this, x, y, z);
  }
}

template <class Scalar>
std::size_t SupportCubeMap<Scalar>::held_bytes() const {
  return cells_.capacity() * sizeof(Cell) + blocks_.capacity() * sizeof(Block) +
         lists_.capacity() * sizeof(std::uint16_t) + numbers_.capacity() * sizeof(std::uint32_t);
}

template class SupportCubeMap<float>;
template class SupportCubeMap<double>;

}  // namespace touchstone
