// Part of the oracle: the polynomials in time whose signs say whether two moving features share a
// point. Included by the files of this folder.
//
// The features are the hulls of two sets of vertices, four vertices in all. They share a point where
// there are numbers c_i with sum 0 and sum c_i x_i = 0, not all zero, that are >= 0 for the vertices
// of the first feature and <= 0 for those of the second (or the other way round).
// - Four points have such numbers only in a plane: the `volume` is zero, a cubic in time.
// - In a plane and not on a line, they are the areas of the triangles of the other three vertices,
//   projected along any axis: one axis at least shows areas that are not all zero. All axes show the
//   same numbers up to a factor. `areas` are quadratics in time.
// - On a line all areas are zero. Then the features share a point if their boxes do: the differences
//   of coordinates are linear in time.
// This holds for parallel edges, and for triangles and edges that are segments or points.
//
// A polynomial of degree n has the coefficients a_0..a_n of sum a_i t^i (1 - t)^(n - i), which are
// the Bernstein coefficients times binomials.
#pragma once

#include <array>
#include <cstddef>

#include "algorithms/core/fixed_integer.h"
#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle::ccd {

template <class Number>
using Triple = std::array<Number, 3>;

// at[time][i] is the vertex i + 1 less the vertex 0, at time 0 and 1.
template <class Coordinate>
struct MovingEdges {
  std::array<std::array<Triple<Coordinate>, 3>, 2> at;
};

template <class Area, class Volume>
struct ContactPolynomials {
  std::array<Volume, 4> volume;
  std::array<std::array<Triple<Area>, 3>, 4> areas;  // [vertex][coefficient][axis]
};

inline Triple<double> cross(const Triple<double>& u, const Triple<double>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
inline double dot(const Triple<double>& u, const Triple<double>& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
using oracle::cross;
using oracle::dot;

template <class Number>
Triple<Number> sum(const Triple<Number>& u, const Triple<Number>& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}

// The same number.
template <std::size_t size>
Integer integer_of(const FixedInteger<size>& x) {
  const FixedInteger<size> magnitude = x.is_negative() ? FixedInteger<size>{} - x : x;
  Integer number;
  number.backend().resize(size, size);
  for (std::size_t i = 0; i < size; ++i) number.backend().limbs()[i] = magnitude.limbs[i];
  number.backend().normalize();
  return x.is_negative() ? Integer(-number) : number;
}

using IntegerPolynomials = ContactPolynomials<Integer, Integer>;

template <class Area, class Volume>
IntegerPolynomials in_integers(const ContactPolynomials<Area, Volume>& given) {
  IntegerPolynomials all;
  for (std::size_t c = 0; c < 4; ++c) all.volume[c] = integer_of(given.volume[c]);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        all.areas[i][c][axis] = integer_of(given.areas[i][c][axis]);
      }
    }
  }
  return all;
}

template <class Coordinate>
auto contact_polynomials(const MovingEdges<Coordinate>& edges) {
  const auto& [s, e] = edges.at;
  using Area = std::decay_t<decltype(cross(s[0], s[0])[0])>;
  using Volume = std::decay_t<decltype(dot(s[0], cross(s[0], s[0])))>;
  ContactPolynomials<Area, Volume> all;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    all.areas[i + 1] = {cross(s[j], s[k]), sum(cross(s[j], e[k]), cross(e[j], s[k])),
                        cross(e[j], e[k])};
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const Triple<Area> others = sum(sum(all.areas[1][c], all.areas[2][c]), all.areas[3][c]);
    for (std::size_t axis = 0; axis < 3; ++axis) all.areas[0][c][axis] = Area{} - others[axis];
  }
  const auto& area = all.areas[1];
  all.volume = {dot(s[0], area[0]), dot(s[0], area[1]) + dot(e[0], area[0]),
                dot(s[0], area[2]) + dot(e[0], area[1]), dot(e[0], area[2])};
  return all;
}

}  // namespace touchstone::oracle::ccd
