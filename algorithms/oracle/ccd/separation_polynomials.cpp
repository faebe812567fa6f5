// Part of the oracle: polynomials of distances.
#include "algorithms/oracle/ccd/separation_polynomials.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle::ccd {
namespace {

using Vector = std::array<Sextic, 3>;

Sextic operator+(const Sextic& p, const Sextic& q) {
  Sextic sum;
  for (std::size_t i = 0; i < sum.coefficient.size(); ++i)
    sum.coefficient[i] = p.coefficient[i] + q.coefficient[i];
  trim(sum, std::max(p.degree, q.degree));
  return sum;
}

Sextic operator-(const Sextic& p, const Sextic& q) {
  Sextic difference;
  for (std::size_t i = 0; i < difference.coefficient.size(); ++i)
    difference.coefficient[i] = p.coefficient[i] - q.coefficient[i];
  trim(difference, std::max(p.degree, q.degree));
  return difference;
}

Sextic operator*(const Sextic& p, const Sextic& q) {
  Sextic product;
  for (int i = 0; i <= p.degree; ++i) {
    for (int k = 0; k <= q.degree; ++k) {
      product.coefficient[static_cast<std::size_t>(i + k)] +=
          p.coefficient[static_cast<std::size_t>(i)] * q.coefficient[static_cast<std::size_t>(k)];
    }
  }
  if (!p.is_zero() && !q.is_zero()) product.degree = p.degree + q.degree;
  return product;
}

Vector operator-(const Vector& u, const Vector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Sextic dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

// The vertices, of which the first stays at the origin, and the square of the separation.
struct Moving {
  std::array<Vector, 4> x;
  Sextic square;
};

Moving moving_of(const MovingFeatures& features, double separation) {
  Grid grid = grid_of(features);
  const Dyadic distance = dyadic(separation);
  if (separation > 0)
    grid.exponent = grid.bits == 0 ? distance.exponent : std::min(grid.exponent, distance.exponent);
  const MovingEdges<Integer> edges = integer_edges(features, grid);
  Moving moving;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Integer &start = edges.at[0][i][axis], &end = edges.at[1][i][axis];
      Sextic& place = moving.x[i + 1][axis];
      place.coefficient[0] = start;
      place.coefficient[1] = end - start;
      trim(place, 1);
    }
  }
  const Integer length = distance.over_power(grid.exponent);
  moving.square.coefficient[0] = length * length;
  trim(moving.square, 0);
  return moving;
}

PartPolynomials vertices(const Moving& moving, std::size_t i, std::size_t k) {
  const Vector w = moving.x[i] - moving.x[k];
  return {moving.square - dot(w, w), {}, {}};
}

PartPolynomials vertex_and_edge(const Moving& moving, std::size_t p, std::size_t q, std::size_t r) {
  const Vector e = moving.x[r] - moving.x[q], w = moving.x[p] - moving.x[q];
  const Vector across = cross(w, e);
  const Sextic length = dot(e, e), along = dot(w, e);
  return {moving.square * length - dot(across, across), {along, length - along}, {length}};
}

// s^2 n.n - (n.w)^2
Sextic within_along(const Moving& moving, const Vector& n, const Vector& w) {
  const Sextic height = dot(n, w);
  return moving.square * dot(n, n) - height * height;
}

PartPolynomials vertex_and_face(const Moving& moving) {
  const auto& [p, q, r, u] = moving.x;
  const Vector n = cross(r - q, u - q);
  PartPolynomials part = {within_along(moving, n, p - q), {}, {dot(n, n)}};
  const std::array<const Vector*, 4> around = {&q, &r, &u, &q};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector &from = *around[i], &to = *around[i + 1];
    part.inside.push_back(dot(cross(to - from, p - from), n));
  }
  return part;
}

PartPolynomials edges(const Moving& moving) {
  const auto& [p, q, r, u] = moving.x;
  const Vector first = q - p, second = u - r, w = r - p;
  const Vector n = cross(first, second);
  const Sextic area = dot(n, n);
  PartPolynomials part = {within_along(moving, n, w), {}, {area}};
  for (const Vector* other : {&second, &first}) {
    const Sextic place = dot(cross(w, *other), n);
    part.inside.push_back(place);
    part.inside.push_back(area - place);
  }
  return part;
}

}  // namespace

std::vector<PartPolynomials> separation_polynomials(const MovingFeatures& features,
                                                    double separation) {
  const Moving moving = moving_of(features, separation);
  std::vector<PartPolynomials> parts;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      if (features.side(i) != features.side(k)) parts.push_back(vertices(moving, i, k));
    }
  }
  if (features.first_count == 1) {
    for (std::size_t i = 1; i < 4; ++i) parts.push_back(vertex_and_edge(moving, 0, i, i % 3 + 1));
    parts.push_back(vertex_and_face(moving));
  } else {
    for (std::size_t i = 0; i < 2; ++i) {
      parts.push_back(vertex_and_edge(moving, i, 2, 3));
      parts.push_back(vertex_and_edge(moving, i + 2, 0, 1));
    }
    parts.push_back(edges(moving));
  }
  return parts;
}

}  // namespace touchstone::oracle::ccd
