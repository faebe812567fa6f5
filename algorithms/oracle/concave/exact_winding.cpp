// The winding number by the signed crossings of a ray along the world's z axis.
//
// The ray begins at the point and is moved by (d, d^2, 0) for an infinitely small d > 0, so that it
// meets no edge: where the sign of a determinant is 0, those of its derivatives decide. Triangles that it passes
// by more than doubles can be wrong are left out first.
#include "algorithms/oracle/concave/exact_winding.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
namespace {

// The three coordinates of a placed point: sums of products of numbers that are kept apart.
struct PlacedSum {
  std::array<std::array<Dyadic, 4>, 3> terms;

  PlacedSum(const Pose& pose, const Vec3d& point) {
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 3; ++k) {
        const Dyadic entry = dyadic(pose.rotation(row, k)), x = dyadic(point[k]);
        if (entry.mantissa.is_zero() || x.mantissa.is_zero()) continue;
        terms[row][k] = {entry.mantissa * x.mantissa, entry.exponent + x.exponent};
      }
      terms[row][3] = dyadic(pose.translation[row]);
    }
  }
  int least_exponent() const {
    int least = Dyadic::of_zero;
    for (const auto& row : terms) {
      for (const Dyadic& term : row) least = std::min(least, term.exponent);
    }
    return least;
  }
  IntegerVector over_power(int e) const {
    IntegerVector sum;
    for (int row = 0; row < 3; ++row) {
      for (const Dyadic& term : terms[row]) sum[row] += term.over_power(e);
    }
    return sum;
  }
};

// A placed point in doubles. Its difference from another is off by no more than the sum of their errors.
struct RoundedPlace {
  Vec3d at, error;

  RoundedPlace(const Pose& pose, const Vec3d& point) : at(pose(point)) {
    // Three products, three sums and the difference are each off by half an epsilon of the magnitudes.
    constexpr double share = 4 * std::numeric_limits<double>::epsilon();
    error = share * (pose.rotation.cwiseAbs() * point.cwiseAbs() + pose.translation.cwiseAbs());
    error.array() += std::numeric_limits<double>::min();
  }
};

// True if the upward ray from `from`, however little it is moved, certainly passes the triangle.
bool passes(const RoundedPlace& from, const std::array<RoundedPlace, 3>& corners) {
  Vec3d most = Vec3d::Constant(-std::numeric_limits<double>::infinity()), least = -most;
  for (const RoundedPlace& corner : corners) {
    const Vec3d way = corner.at - from.at, error = corner.error + from.error;
    // What is no number is in all directions.
    if (!(way + error).allFinite()) return false;
    most = most.cwiseMax(way + error);
    least = least.cwiseMin(way - error);
  }
  return most.minCoeff() < 0 || least.head<2>().maxCoeff() > 0;
}

int sign(const Integer& x) { return x.sign(); }

// On which side of the line from u to v the origin is, as seen along z, once it is moved; 0 if the
// line is a point.
int side(const IntegerVector& u, const IntegerVector& v) {
  const Integer area = u[0] * v[1] - u[1] * v[0];
  if (!area.is_zero()) return sign(area);
  // (u - p) x (v - p) with p = (d, d^2) has the derivatives u_y - v_y along x and v_x - u_x along y.
  const Integer along_x = u[1] - v[1];
  return along_x.is_zero() ? sign(v[0] - u[0]) : sign(along_x);
}

}  // namespace

int exact_winding(const TriangleMesh& mesh, const Pose& pose, const Vec3d& point,
                  const Pose& pose_of_point) {
  const PlacedSum origin(pose_of_point, point);
  const RoundedPlace about(pose_of_point, point);
  const auto rounded = [&](std::uint32_t corner) {
    return RoundedPlace(pose, mesh.vertices[corner]);
  };
  int turns = 0;
  for (const auto& corners : mesh.triangles) {
    const auto& [a, b, c] = corners;
    if (passes(about, {rounded(a), rounded(b), rounded(c)})) continue;
    std::vector<PlacedSum> sums;
    int e = origin.least_exponent();
    for (const std::uint32_t corner : corners) {
      sums.emplace_back(pose, mesh.vertices[corner]);
      e = std::min(e, sums.back().least_exponent());
    }
    const IntegerVector from = origin.over_power(e);
    std::array<IntegerVector, 3> t;
    for (int k = 0; k < 3; ++k) t[k] = sums[k].over_power(e) - from;
    const int turn = side(t[0], t[1]);
    if (turn == 0 || turn != side(t[1], t[2]) || turn != side(t[2], t[0])) continue;
    // The volume has the sign of the turn if the triangle is above the point.
    if (sign(dot(t[0], cross(t[1], t[2]))) == turn) turns += turn;
  }
  return turns;
}

}  // namespace touchstone::oracle
