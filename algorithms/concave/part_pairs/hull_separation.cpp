// The plane turns until polytopes around the meshes are on its two sides, for a few turns.
// Papers:  Klosowski, Held, Mitchell, Sowizral, Zikan, "Efficient collision detection using bounding volume hierarchies
//          of k-DOPs", TVCG 1998 (the polytope, of 26 planes); Chung, Wang, "Quick collision detection of polytopes in
//          virtual environments", VRST 1996 (the turns: the way is mirrored at what it fails to part).
//
// A body reaches no further along a sum of ways than the sum of how far it reaches along each. Each way is a sum of
// one to a face, one to an edge and one to a corner of the cube, with parts that are not negative: of parts of the way
// that fall from |x| to |y| and |z|, these are |x| - |y|, |y| - |z| and |z|.
//
// All this is in floats, with u half an epsilon of theirs. The normal keeps its length, 1 up to rounding, so that its
// magnitudes sum up to 2 at most. A coordinate of a polytope's point is at most twice the reach, and
// n . (R x + t) is off by less than 128 u of the sum of t and of each rotation's norm times its body's reach.
#include "algorithms/concave/part_pairs/hull_separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// Meshes with fewer triangles are one node of the tree, which tells as much.
constexpr std::size_t least_triangles = 64;
constexpr int most_turns = 4;
constexpr float rounding = 0x1p-16F;

// How far a mesh reaches along the way (x, y, z), of parts -1, 0 and 1, stands at 13 + x + 3 y + 9 z.
using Ends = std::array<double, 27>;
constexpr std::size_t middle = 13;
constexpr std::array<int, 3> stride = {1, 3, 9};

Vec3d way_at(std::size_t place) {
  const auto part = [&](std::size_t step) { return static_cast<double>(place / step % 3) - 1; };
  return {part(1), part(3), part(9)};
}

Ends ends_of(std::span<const Vec3d> vertices) {
  Ends ends;
  ends.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t place = middle + 1; place < ends.size(); ++place) {
    const Vec3d way = way_at(place);
    double &end = ends[place], &opposite = ends[2 * middle - place];
    for (const Vec3d& v : vertices) {
      const double at = way.dot(v);
      end = std::max(end, at);
      opposite = std::max(opposite, -at);
    }
  }
  return ends;
}

using Vector = DiscretePolytope::Vector;
using Lanes = simd::baseline::Simd<float>;

Vector vector_of(const Vec3d& v) {
  return Vector{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 0};
}
float dot(const Vector& a, const Vector& b) {
  const Vector products = a * b;
  return products[0] + products[1] + products[2];
}

// A rotation matrix and its transpose.
class Turn {
 public:
  explicit Turn(const Mat3d& matrix) {
    for (int k = 0; k < 3; ++k) columns_[k] = vector_of(matrix.col(k));
    for (int k = 0; k < 3; ++k)
      rows_[k] = Vector{columns_[0][k], columns_[1][k], columns_[2][k], 0};
  }
  Vector operator()(const Vector& v) const { return sum(columns_, v); }
  Vector back(const Vector& v) const { return sum(rows_, v); }
  // The greatest sum of a row's magnitudes.
  float norm() const {
    return Lanes::reduce_max(Lanes::abs(columns_[0]) + Lanes::abs(columns_[1]) +
                             Lanes::abs(columns_[2]));
  }

 private:
  static Vector sum(const Vector* of, const Vector& v) {
    return of[0] * v[0] + of[1] * v[1] + of[2] * v[2];
  }
  Vector columns_[3], rows_[3];
};

}  // namespace

DiscretePolytope::DiscretePolytope(std::span<const Vec3d> vertices) {
  const Ends ends = ends_of(vertices);
  const auto end = [&](int place) { return ends[static_cast<std::size_t>(place)]; };
  const int origin = middle;
  Vec3d centre;
  for (int k = 0; k < 3; ++k) {
    centre[k] = (end(origin + stride[k]) - end(origin - stride[k])) / 2;
  }
  double inner = std::numeric_limits<double>::infinity(), reach = 0;
  for (std::size_t place = 0; place < ends.size(); ++place) {
    if (place == middle) continue;
    const Vec3d way = way_at(place);
    inner = std::min(inner, (ends[place] - way.dot(centre)) / way.norm());
    reach = std::max(reach, std::abs(ends[place]));
  }
  centre_ = vector_of(centre);
  inner_ = static_cast<float>(inner);
  reach_ = static_cast<float>(reach);
  points_.fill(Vector{});
  std::array<int, 3> order = {0, 1, 2};  // axes, from the greatest part of a way to the least
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      Vector way = {}, point = {};
      int place = origin;
      double before = 0;
      for (std::size_t rank = 0; rank < 3; ++rank) {
        const int axis = order[rank], sign = (signs >> axis & 1) != 0 ? -1 : 1;
        way[axis] = static_cast<float>(sign * (3 - static_cast<int>(rank)));
        place += sign * stride[axis];
        point[axis] = static_cast<float>(sign * (end(place) - before));
        before = end(place);
      }
      points_[sector_of(way)] = point;
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

void HullSeparation::bind(std::span<const BoundBody> bodies) {
  bodies_ = bodies;
  polytopes_.clear();
  for (const BoundBody& body : bodies) {
    std::optional<DiscretePolytope>& polytope = polytopes_.emplace_back();
    if (body.mesh() == nullptr || body.mesh()->triangles.size() < least_triangles) continue;
    polytope.emplace(body.mesh()->vertices);
  }
}

bool HullSeparation::parts(const PlacedConcave& a, const PlacedConcave& b) const {
  if (!polytopes_[a.body] || !polytopes_[b.body]) return false;
  const DiscretePolytope &first = *polytopes_[a.body], &second = *polytopes_[b.body];
  const Turn turn_a(a.pose.rotation), turn_b(b.pose.rotation);
  const Vector offset = vector_of(b.pose.translation - a.pose.translation);
  Vector n = turn_b(second.centre()) - turn_a(first.centre()) + offset;
  // Balls in both that overlap leave no plane.
  const float inner = first.inner() + second.inner(), away = dot(n, n);
  if (!(away > inner * inner)) return false;
  const float greatest = turn_a.norm() * first.reach() + turn_b.norm() * second.reach() +
                         Lanes::reduce_max(Lanes::abs(offset));
  if (!(greatest > 1e-15F && greatest < 1e15F)) return false;
  n *= 1 / std::sqrt(away);
  for (int turn = 0; turn < most_turns; ++turn) {
    const Vector on_a = first.support(turn_a.back(n)), on_b = second.support(turn_b.back(-n));
    const Vector apart = turn_b(on_b) - turn_a(on_a) + offset;
    const float gap = dot(n, apart);
    if (gap > rounding * greatest) return true;
    n -= 2 * gap / dot(apart, apart) * apart;
  }
  return false;
}

}  // namespace touchstone
