// Supports and points of a core in rationals. Only roots are rounded, upward.
#include "algorithms/oracle/certificates/rational_core.h"

#include <algorithm>

namespace touchstone::oracle {

RationalCore::RationalCore(const Body& body, mp_bitcnt_t root_bits)
    : RationalCore(*body.solid, rational_pose(body), root_bits) {}

RationalCore::RationalCore(const Solid& solid, const RationalPose& pose, mp_bitcnt_t root_bits)
    : solid_(solid), root_bits_(root_bits), rows_(pose.rows), translation_(pose.translation) {
  if (is_halfspace()) place_plane();
  extents_ = rational_vector(solid_.extents);
  for (const mpq_class& extent : extents_) require(extent >= 0, "an extent is negative");
  require(solid_.core != Solid::Core::polytope || !solid_.vertices.empty(),
          "a polytope has no vertices");
}

void RationalCore::turn(const std::array<RationalVector, 3>& rotation) {
  require(!is_halfspace(), "a half-space turns");
  const std::array<RationalVector, 3> old = rows_;
  for (int i = 0; i < 3; ++i) {
    rows_[i] = rotation[i][0] * old[0] + rotation[i][1] * old[1] + rotation[i][2] * old[2];
  }
}

void RationalCore::displace(const RationalVector& by) {
  translation_ = translation_ + by;
  if (is_halfspace()) height_ += dot(normal_, by);
}

mpq_class RationalCore::reach() const {
  require(!is_halfspace(), "a half-space turns");
  if (is_polytope()) {
    mpq_class square = 0;
    for (const RationalVector& vertex : vertices()) {
      const RationalVector from_origin = vertex - translation_;
      square = std::max<mpq_class>(square, dot(from_origin, from_origin));
    }
    return root_above(square, root_bits_);
  }
  // The greatest eigenvalue of M^T M, and so of M M^T, is at most its greatest row sum.
  mpq_class stretch = 0;
  for (const RationalVector& row : rows_) {
    mpq_class sum = 0;
    for (const RationalVector& other : rows_) sum += abs(dot(row, other));
    stretch = std::max<mpq_class>(stretch, sum);
  }
  const auto& [r, s, h] = extents_;
  mpq_class square = r * r + h * h;
  if (solid_.core == Solid::Core::ellipsoid) {
    const mpq_class greatest = std::max<mpq_class>({r, s, h});
    square = greatest * greatest;
  }
  return root_above(stretch * square, root_bits_);
}

std::vector<RationalVector> RationalCore::vertices() const {
  std::vector<Generator> all(solid_.vertices.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i].vertex = static_cast<std::int32_t>(i);
  return points(all);
}

std::optional<mpq_class> RationalCore::support(const RationalVector& n) const {
  if (is_halfspace()) {
    const mpq_class along = dot(n, normal_);
    if (!is_zero(cross(n, normal_)) || along <= 0) return {};
    return along / dot(normal_, normal_) * height_;
  }
  const RationalVector u = n[0] * rows_[0] + n[1] * rows_[1] + n[2] * rows_[2];
  return support_in_body(u) + dot(n, translation_);
}

std::vector<RationalVector> RationalCore::points(const std::vector<Generator>& generators) const {
  if (is_halfspace()) {
    require(generators.empty(), "a half-space has no generators");
    return {height_ / dot(normal(), normal()) * normal()};
  }
  std::vector<RationalVector> all;
  for (const Generator& generator : generators) {
    const RationalVector x = point_in_body(generator);
    all.push_back(RationalVector{dot(rows_[0], x), dot(rows_[1], x), dot(rows_[2], x)} +
                  translation_);
  }
  return all;
}

bool RationalCore::holds_in_world(const RationalVector& point) const {
  const std::array<RationalVector, 3> columns = {
      cross(rows_[1], rows_[2]), cross(rows_[2], rows_[0]), cross(rows_[0], rows_[1])};
  const mpq_class determinant = dot(rows_[0], columns[0]);
  require(determinant != 0, "the matrix of a part is singular");
  const RationalVector way = point - translation_;
  const RationalVector x =
      1 / determinant * (way[0] * columns[0] + way[1] * columns[1] + way[2] * columns[2]);
  if (!is_polytope()) return holds(x);
  require(solid_.is_box, "the core is neither round nor a box");
  const RationalVector corner = rational_vector(solid_.vertices.back());
  return abs(x[0]) <= corner[0] && abs(x[1]) <= corner[1] && abs(x[2]) <= corner[2];
}

void RationalCore::place_plane() {
  const RationalVector n = rational_vector(solid_.normal);
  require(!is_zero(n), "the normal of a half-space is zero");
  const std::array<RationalVector, 3> cofactors = {
      cross(rows_[1], rows_[2]), cross(rows_[2], rows_[0]), cross(rows_[0], rows_[1])};
  const mpq_class determinant = dot(rows_[0], cofactors[0]);
  for (int i = 0; i < 3; ++i) normal_[i] = sgn(determinant) * dot(cofactors[i], n);
  height_ = abs(determinant) * rational(solid_.offset) + dot(normal_, translation_);
}

mpq_class RationalCore::support_in_body(const RationalVector& u) const {
  const mpq_class end = extents_[2] * u[2];
  const auto rim = [&]() -> mpq_class {
    return extents_[0] * root_above(u[0] * u[0] + u[1] * u[1], root_bits_);
  };
  switch (solid_.core) {
    case Solid::Core::cylinder: return abs(end) + rim();
    case Solid::Core::cone: return std::max<mpq_class>(end, rim() - end);
    case Solid::Core::ellipsoid: {
      const RationalVector scaled = {extents_[0] * u[0], extents_[1] * u[1], end};
      return root_above(dot(scaled, scaled), root_bits_);
    }
    default: break;
  }
  mpq_class greatest = dot(u, rational_vector(solid_.vertices[0]));
  for (const Vec3d& vertex : solid_.vertices) {
    greatest = std::max<mpq_class>(greatest, dot(u, rational_vector(vertex)));
  }
  return greatest;
}

RationalVector RationalCore::point_in_body(const Generator& generator) const {
  if (solid_.core == Solid::Core::polytope) {
    require(generator.vertex >= 0 &&
                static_cast<std::size_t>(generator.vertex) < solid_.vertices.size(),
            "a generator names no vertex of its polytope");
    return rational_vector(solid_.vertices[static_cast<std::size_t>(generator.vertex)]);
  }
  require(generator.vertex < 0, "a generator names a vertex of a body that has none");
  RationalVector x = rational_vector(generator.point);
  require(holds(x), "a generator lies outside its body");
  return x;
}

// Returns true if a round core contains the point.
bool RationalCore::holds(const RationalVector& x) const {
  const auto& [r, s, h] = extents_;
  if (solid_.core == Solid::Core::ellipsoid) {
    mpq_class sum;
    for (int i = 0; i < 3; ++i) {
      if (extents_[i] == 0 && x[i] != 0) return false;
      if (extents_[i] != 0) sum += x[i] * x[i] / (extents_[i] * extents_[i]);
    }
    return sum <= 1;
  }
  const mpq_class off_axis = x[0] * x[0] + x[1] * x[1];
  if (abs(x[2]) > h || off_axis > r * r) return false;
  const mpq_class below_tip = r * (h - x[2]);
  return solid_.core == Solid::Core::cylinder || 4 * h * h * off_axis <= below_tip * below_tip;
}

}  // namespace touchstone::oracle
