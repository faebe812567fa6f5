// The difference of two triangles is the hull of nine points. It does not contain zero if and only if
// the normal of a facet separates, or, where it is flat, its normal or that of an edge in its plane,
// or, where it is a segment, its direction or the way to it. Every other axis does no harm.
#include "tests/algorithms/concave/triangle_truth.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace touchstone::reference {
namespace {

using Big = std::array<mpz_class, 3>;

Big operator-(const Big& u, const Big& v) { return {u[0] - v[0], u[1] - v[1], u[2] - v[2]}; }
Big big_cross(const Big& u, const Big& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
mpz_class big_dot(const Big& u, const Big& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

// x times 2^shift, which is an integer.
mpz_class scaled(double x, int shift) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  mpz_class value(std::ldexp(fraction, 53));
  const int up = exponent - 53 + shift;
  if (up >= 0) return value << static_cast<unsigned>(up);
  return value >> static_cast<unsigned>(-up);
}

// Enough bits after the point for every number given.
int bits_behind(double x) {
  if (x == 0) return 0;
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::max(0, 53 - exponent);
}

std::array<Big, 3> placed(const std::array<Vec3d, 3>& corners, const Pose& pose, int of_rotation,
                          int of_points) {
  std::array<Big, 3> world;
  for (int k = 0; k < 3; ++k) {
    for (int row = 0; row < 3; ++row) {
      world[k][row] = scaled(pose.translation[row], of_rotation + of_points);
      for (int j = 0; j < 3; ++j) {
        world[k][row] +=
            scaled(pose.rotation(row, j), of_rotation) * scaled(corners[k][j], of_points);
      }
    }
  }
  return world;
}

bool separates(const Big& axis, const std::array<Big, 3>& a, const std::array<Big, 3>& b) {
  std::array<mpz_class, 3> on_a, on_b;
  for (int k = 0; k < 3; ++k) {
    on_a[k] = big_dot(axis, a[k]);
    on_b[k] = big_dot(axis, b[k]);
  }
  const auto [low_a, high_a] = std::ranges::minmax(on_a);
  const auto [low_b, high_b] = std::ranges::minmax(on_b);
  return high_a < low_b || high_b < low_a;
}

}  // namespace

bool triangles_meet(const families::TrianglePair& pair) {
  int of_rotation = 0, of_points = 0;
  for (const Pose* pose : {&pair.pose_a, &pair.pose_b}) {
    for (const double x : pose->rotation.reshaped()) {
      of_rotation = std::max(of_rotation, bits_behind(x));
    }
    for (const double x : pose->translation) of_points = std::max(of_points, bits_behind(x));
  }
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      of_points = std::max({of_points, bits_behind(pair.a[k][j]), bits_behind(pair.b[k][j])});
    }
  }
  const auto a = placed(pair.a, pair.pose_a, of_rotation, of_points);
  const auto b = placed(pair.b, pair.pose_b, of_rotation, of_points);
  std::vector<Big> edges_a, edges_b, normals, axes;
  for (int k = 0; k < 3; ++k) {
    edges_a.push_back(a[(k + 1) % 3] - a[k]);
    edges_b.push_back(b[(k + 1) % 3] - b[k]);
  }
  normals.push_back(big_cross(edges_a[0], edges_a[1]));
  normals.push_back(big_cross(edges_b[0], edges_b[1]));
  for (const Big& u : edges_a) {
    for (const Big& v : edges_b) normals.push_back(big_cross(u, v));
  }
  std::vector<Big> edges = edges_a;
  edges.insert(edges.end(), edges_b.begin(), edges_b.end());
  bool is_solid = false;
  for (const Big& n : normals) {
    for (const Big& e : edges) is_solid = is_solid || big_dot(n, e) != 0;
  }
  axes = normals;
  if (!is_solid) {
    for (const Big& e : edges) {
      axes.push_back(e);
      for (const Big& n : normals) axes.push_back(big_cross(n, e));
      for (const Big& p : a) {
        for (const Big& q : b) axes.push_back(big_cross(big_cross(e, p - q), e));
      }
    }
    for (const Big& p : a) {
      for (const Big& q : b) axes.push_back(p - q);
    }
  }
  return std::ranges::none_of(axes, [&](const Big& axis) { return separates(axis, a, b); });
}

}  // namespace touchstone::reference
