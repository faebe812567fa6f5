// Part of the oracle: coordinates on a grid.
#include "algorithms/oracle/ccd/moving_features.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle::ccd {
namespace {

// x = mantissa * 2^exponent, for x != 0.
struct Parts {
  std::int64_t mantissa;
  int exponent;
};

Parts parts_of(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto biased = static_cast<int>(bits >> 52 & 0x7ff);
  auto mantissa = static_cast<std::int64_t>(bits & 0xfffffffffffff);
  if (biased != 0) mantissa |= std::int64_t{1} << 52;
  return {x < 0 ? -mantissa : mantissa, std::max(biased, 1) - 1075};
}

template <std::size_t size>
FixedInteger<size> on_grid(double x, const Grid& grid) {
  FixedInteger<size> number;
  if (x == 0) return number;
  const Parts parts = parts_of(x);
  const int shift = parts.exponent - grid.exponent;
  // A negative shift drops zeros alone.
  const std::int64_t mantissa = shift < 0 ? parts.mantissa >> -shift : parts.mantissa;
  const auto left = static_cast<unsigned>(std::max(shift, 0));
  if constexpr (size == 1) {
    number.limbs[0] = static_cast<std::uint64_t>(mantissa) << left;
  } else {
    const auto wide =
        static_cast<fixed_integer_detail::Twice>(fixed_integer_detail::Signed{mantissa}) << left;
    number.limbs[0] = static_cast<std::uint64_t>(wide);
    number.limbs[1] = static_cast<std::uint64_t>(wide >> 64);
  }
  return number;
}

template <class Coordinate, class Place>
MovingEdges<Coordinate> edges_of(const MovingFeatures& features, const Place& place) {
  MovingEdges<Coordinate> edges;
  for (int time = 0; time < 2; ++time) {
    for (int axis = 0; axis < 3; ++axis) {
      const Coordinate origin = place(features.at(time, 0)[axis]);
      for (std::size_t i = 0; i < 3; ++i) {
        edges.at[static_cast<std::size_t>(time)][i][static_cast<std::size_t>(axis)] =
            place(features.at(time, i + 1)[axis]) - origin;
      }
    }
  }
  return edges;
}

}  // namespace

Grid grid_of(const MovingFeatures& features) {
  int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
  for (const std::array<Vec3d, 4>* points : {&features.start, &features.end}) {
    for (const Vec3d& point : *points) {
      for (const double x : point) {
        if (x == 0) continue;
        const Parts parts = parts_of(x);
        const auto magnitude =
            static_cast<std::uint64_t>(parts.mantissa < 0 ? -parts.mantissa : parts.mantissa);
        low = std::min(low, parts.exponent + static_cast<int>(std::countr_zero(magnitude)));
        high = std::max(high, parts.exponent + static_cast<int>(std::bit_width(magnitude)));
      }
    }
  }
  if (low > high) return {};
  return {low, high - low};
}

template <std::size_t size>
MovingEdges<FixedInteger<size>> fixed_edges(const MovingFeatures& features, const Grid& grid) {
  return edges_of<FixedInteger<size>>(features, [&](double x) { return on_grid<size>(x, grid); });
}
template MovingEdges<FixedInteger<1>> fixed_edges(const MovingFeatures&, const Grid&);
template MovingEdges<FixedInteger<2>> fixed_edges(const MovingFeatures&, const Grid&);

MovingEdges<Integer> integer_edges(const MovingFeatures& features, const Grid& grid) {
  return edges_of<Integer>(features, [&](double x) { return dyadic(x).over_power(grid.exponent); });
}

MovingEdges<double> rounded_edges(const MovingFeatures& features) {
  double greatest = 0;
  for (const std::array<Vec3d, 4>* points : {&features.start, &features.end}) {
    for (const Vec3d& point : *points) greatest = std::max(greatest, point.cwiseAbs().maxCoeff());
  }
  // The biased exponent of the greatest gives the unit; two factors reach every unit.
  const int exponent = greatest == 0 ? 0 : std::ilogb(greatest) + 1;
  const double half = std::ldexp(1, -exponent / 2), rest = std::ldexp(1, -exponent + exponent / 2);
  return edges_of<double>(features, [&](double x) { return x * half * rest; });
}

bool are_apart_along_an_axis(const MovingFeatures& features, double separation) {
  // A difference of doubles is rounded once.
  const double least = separation * (1 + 0x1p-50);
  std::array<Eigen::Array<bool, 3, 1>, 2> apart = {Eigen::Array<bool, 3, 1>::Constant(true),
                                                   Eigen::Array<bool, 3, 1>::Constant(true)};
  for (const std::array<Vec3d, 4>* x : {&features.start, &features.end}) {
    const auto& [p, q, r, s] = *x;
    const bool has_edge = features.first_count == 2;
    const Vec3d first_low = has_edge ? p.cwiseMin(q) : p, first_high = has_edge ? p.cwiseMax(q) : p;
    const Vec3d rest_low = r.cwiseMin(s), rest_high = r.cwiseMax(s);
    const Vec3d second_low = has_edge ? rest_low : q.cwiseMin(rest_low);
    const Vec3d second_high = has_edge ? rest_high : q.cwiseMax(rest_high);
    apart[0] = apart[0] && first_low.array() - second_high.array() > least;
    apart[1] = apart[1] && second_low.array() - first_high.array() > least;
  }
  return apart[0].any() || apart[1].any();
}

}  // namespace touchstone::oracle::ccd
