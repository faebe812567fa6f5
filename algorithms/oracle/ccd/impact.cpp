// Part of the oracle: the first contact behind filters, in doubles and in fixed-width integers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "algorithms/oracle/ccd/first_contact.h"
#include "algorithms/oracle/ccd/interval_proof.h"

namespace touchstone::oracle::ccd {
namespace {

constexpr double roundoff = 0x1p-53;

// The axis along which the areas are greatest in the middle of the time.
template <class Area>
std::size_t widest_axis(const std::array<std::array<Triple<Area>, 3>, 4>& areas) {
  Triple<double> size{};
  for (const auto& area : areas) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double middle = 0;
      for (const Triple<Area>& coefficient : area) {
        if constexpr (std::is_same_v<Area, double>) {
          middle += coefficient[axis];
        } else {
          middle += to_double(coefficient[axis]);
        }
      }
      size[axis] += std::abs(middle);
    }
  }
  return static_cast<std::size_t>(std::ranges::max_element(size) - size.begin());
}

double greatest(const Triple<double>& edge) {
  return std::max({std::abs(edge[0]), std::abs(edge[1]), std::abs(edge[2])});
}

// The polynomials in doubles. With u = 2^-53 and m_i at least the greatest coordinate of edge i:
//   an edge                  relative error u
//   a product of two         3 u; their difference, of two at most m_j m_k each: 8 u m_j m_k
//   the area's middle        two of them, halved: 10 u m_j m_k
//   the sum of three areas   14 u (m_1 m_2 + m_2 m_3 + m_3 m_1)
//   a volume                 at most 3 dot products of 3 terms below 2 m_1 m_2 m_3 each, divided
//                            by 3 where there are three: 28 u of edges and sums for each of them, and
//                            3 m_1 times the area's error: below 64 u m_1 m_2 m_3
// The edges are below 2, so what underflows is below 2^-1060.
RoundedPolynomials in_doubles(const MovingFeatures& features) {
  const MovingEdges<double> edges = rounded_edges(features);
  const auto given = contact_polynomials(edges);
  Triple<double> m;
  for (std::size_t i = 0; i < 3; ++i) {
    m[i] = std::max(greatest(edges.at[0][i]), greatest(edges.at[1][i]));
  }
  RoundedPolynomials all;
  all.volume = {given.volume[0], given.volume[1] / 3, given.volume[2] / 3, given.volume[3]};
  all.volume_error = 72 * roundoff * m[0] * m[1] * m[2] + 0x1p-1000;
  const std::size_t axis = widest_axis(given.areas);
  for (std::size_t i = 0; i < 4; ++i) {
    const double side = features.side(i);
    for (std::size_t c = 0; c < 3; ++c) {
      all.areas[i][c] = (c == 1 ? 0.5 : 1.0) * side * given.areas[i][c][axis];
    }
  }
  all.area_error = 32 * roundoff * (m[0] * m[1] + m[1] * m[2] + m[2] * m[0]) + 0x1p-1000;
  return all;
}

// What integers decide at time 0 or 1, where the volume is zero. Nothing: all on one line.
template <class Area>
std::optional<bool> share_a_point_at(const MovingFeatures& features,
                                     const std::array<std::array<Triple<Area>, 3>, 4>& areas,
                                     int time) {
  const std::size_t c = time == 0 ? 0 : 2;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bool positive = false, negative = false;
    for (std::size_t i = 0; i < 4; ++i) {
      const int sign = areas[i][c][axis].sign() * features.side(i);
      positive = positive || sign > 0;
      negative = negative || sign < 0;
    }
    if (positive || negative) return !(positive && negative);
  }
  return {};
}

// Exact coefficients, then the proof in doubles from coefficients that are rounded once: to_double is
// off by at most 8 roundings of 2^-53, and the division by a binomial by one.
template <class Area, class Volume>
std::optional<Impact> by_exact_coefficients(const MovingFeatures& features,
                                            const ContactPolynomials<Area, Volume>& given) {
  // Roots at 0 and 1 are taken out: the volume is t^first (1 - t)^(3 - last) times another.
  int first = 0, last = 3;
  const auto is_zero = [&](int i) { return given.volume[static_cast<std::size_t>(i)].is_zero(); };
  while (first <= 3 && is_zero(first)) ++first;
  const bool is_planar = first > 3;  // at all times
  while (!is_planar && is_zero(last)) --last;
  if (first > 0) {
    const std::optional<bool> shared = share_a_point_at(features, given.areas, 0);
    if (!shared) return {};
    if (*shared) return Impact{true, 0, 0};
  }
  RoundedPolynomials all;
  // In one plane nothing but areas can prove a miss, and nothing here a hit.
  all.degree = is_planar ? 0 : last - first;
  static constexpr double binomials[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
  double most = 0;
  for (int i = 0; i <= all.degree && !is_planar; ++i) {
    const auto k = static_cast<std::size_t>(i);
    all.volume[k] =
        to_double(given.volume[k + static_cast<std::size_t>(first)]) / binomials[all.degree][k];
    most = std::max(most, std::abs(all.volume[k]));
  }
  all.volume_error = 16 * roundoff * most;
  const std::size_t axis = widest_axis(given.areas);
  most = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    all.is_zero[i] = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& area = given.areas[i][c][axis];
      all.is_zero[i] = all.is_zero[i] && area.is_zero();
      all.areas[i][c] = (c == 1 ? 0.5 : 1.0) * features.side(i) * to_double(area);
      most = std::max(most, std::abs(all.areas[i][c]));
    }
  }
  all.area_error = 16 * roundoff * most;
  const IntervalProof proof = prove_over_intervals(all);
  if (proof.proven == Proven::nothing) return {};
  if (proof.proven == Proven::hit) return Impact{true, proof.free_before, proof.contact_by};
  if (last == 3) return Impact{};
  const std::optional<bool> shared = share_a_point_at(features, given.areas, 1);
  if (!shared) return {};
  return *shared ? Impact{true, 1, 1} : Impact{};
}

Impact bounded(std::optional<ContactTime> time) {
  if (!time) return {};
  const TimeBounds bounds = time->bounds();
  return {true, bounds.low, bounds.high};
}

template <std::size_t size>
Impact by_fixed_integers(const MovingFeatures& features, const Grid& grid) {
  const auto given = contact_polynomials(fixed_edges<size>(features, grid));
  const std::optional<Impact> impact = by_exact_coefficients(features, given);
  return impact ? *impact : bounded(first_contact(features, in_integers(given)));
}

}  // namespace

Impact impact_of(const MovingFeatures& features, Filters filters) {
  if (filters == Filters::all) {
    if (are_apart_along_an_axis(features, 0)) return {};
    const IntervalProof proof = prove_over_intervals(in_doubles(features));
    if (proof.proven == Proven::miss) return {};
    if (proof.proven == Proven::hit) return {true, proof.free_before, proof.contact_by};
  }
  if (filters != Filters::none) {
    const Grid grid = grid_of(features);
    if (grid.bits <= 60) return by_fixed_integers<1>(features, grid);
    if (grid.bits <= 124) return by_fixed_integers<2>(features, grid);
  }
  return bounded(first_contact(features));
}

}  // namespace touchstone::oracle::ccd
