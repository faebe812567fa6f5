#include "algorithms/kernels/simplex_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// A vector along the way from the origin to a feature's nearest point, of any length, and the
// corners of the feature as bits.
template <class Scalar>
struct Way {
  Vec3<Scalar> vector;
  unsigned corners;
};

constexpr unsigned all_corners = 0xf;

// Features that the newest corner is on, as a step of the walk cannot end on others: w[0] of all.
template <class Scalar>
class QuickSimplex {
 public:
  explicit QuickSimplex(const std::array<const Vec3<Scalar>*, 4>& corners) : w_(corners) {}

  Way<Scalar> segment(int b) const {
    const Vec3<Scalar>& a = *w_[0];
    const Vec3<Scalar> edge = *w_[b] - a;
    const Scalar along = -a.dot(edge);
    if (!(along > 0)) return {a, 1};
    return on_edge(edge, along, b);
  }

  Way<Scalar> triangle(int b, int c) const {
    const Vec3<Scalar>& a = *w_[0];
    const Vec3<Scalar> ab = *w_[b] - a, ac = *w_[c] - a;
    return on_triangle(ab, ac, ab.cross(ac), b, c);
  }

  // All corners where the origin is inside.
  Way<Scalar> tetrahedron() const {
    const Vec3<Scalar>& a = *w_[0];
    const Vec3<Scalar> ab = *w_[1] - a, ac = *w_[2] - a, ad = *w_[3] - a;
    const Vec3<Scalar> abc = ab.cross(ac), acd = ac.cross(ad), adb = ad.cross(ab);
    const Scalar volume = ad.dot(abc);
    const auto beyond = [&](const Vec3<Scalar>& normal) {
      const Scalar side = a.dot(normal);
      return volume > 0 ? side > 0 : side < 0;
    };
    const bool beyond_abc = beyond(abc), beyond_acd = beyond(acd), beyond_adb = beyond(adb);
    if (!(beyond_abc || beyond_acd || beyond_adb)) return {Vec3<Scalar>::Zero(), all_corners};
    Way<Scalar> best{a, 1};
    Scalar least = std::numeric_limits<Scalar>::infinity();
    const auto keep_nearer = [&](const Way<Scalar>& way) {
      const Scalar reach = way.vector.dot(a);  // all of the feature is as far along it
      const Scalar squared = reach * reach / way.vector.squaredNorm();
      if (!(squared < least)) return;
      least = squared;
      best = way;
    };
    const int faces = int{beyond_abc} + int{beyond_acd} + int{beyond_adb};
    if (faces == 1) {
      if (beyond_abc) return on_triangle(ab, ac, abc, 1, 2);
      if (beyond_acd) return on_triangle(ac, ad, acd, 2, 3);
      return on_triangle(ad, ab, adb, 3, 1);
    }
    if (beyond_abc) keep_nearer(on_triangle(ab, ac, abc, 1, 2));
    if (beyond_acd) keep_nearer(on_triangle(ac, ad, acd, 2, 3));
    if (beyond_adb) keep_nearer(on_triangle(ad, ab, adb, 3, 1));
    return best;
  }

 private:
  // `along` is how far the origin is along the edge from the newest corner, times its length.
  Way<Scalar> on_edge(const Vec3<Scalar>& edge, Scalar along, int b) const {
    const Scalar whole = edge.squaredNorm();
    return {whole * *w_[0] + along * edge, 1u | 1u << b};
  }

  Way<Scalar> on_triangle(const Vec3<Scalar>& ab, const Vec3<Scalar>& ac,
                          const Vec3<Scalar>& normal, int b, int c) const {
    const Vec3<Scalar>& a = *w_[0];
    const bool beyond_ab = ab.cross(normal).dot(a) < 0;
    const bool beyond_ac = normal.cross(ac).dot(a) < 0;
    if (!beyond_ab && !beyond_ac) {
      return {normal.dot(a) < 0 ? Vec3<Scalar>(-normal) : normal, 1u | 1u << b | 1u << c};
    }
    // Where it is beyond both sides it is along one of them at most.
    const Scalar along_ab = -ab.dot(a), along_ac = -ac.dot(a);
    if (beyond_ab && along_ab > 0) return on_edge(ab, along_ab, b);
    if (beyond_ac && along_ac > 0) return on_edge(ac, along_ac, c);
    return {a, 1};
  }

  std::array<const Vec3<Scalar>*, 4> w_;
};

// The way to the simplex, whose newest point is its last one; only the feature's corners stay, the
// newest of them last.
template <class Scalar>
Vec3<Scalar> reduce_quickly(Simplex<Scalar>& simplex) {
  const int newest = simplex.size - 1;
  std::array<const Vec3<Scalar>*, 4> corners{};
  for (int i = 0; i < simplex.size; ++i) corners[i] = &simplex.points[newest - i].difference;
  const QuickSimplex<Scalar> quick(corners);
  Way<Scalar> way{*corners[0], 1};
  switch (simplex.size) {
    case 1: break;
    case 2: way = quick.segment(1); break;
    case 3: way = quick.triangle(1, 2); break;
    default: way = quick.tetrahedron();
  }
  int kept = 0;
  for (int i = 0; i < newest; ++i) {
    if ((way.corners >> (newest - i) & 1) == 0) continue;
    if (kept != i) simplex.points[kept] = simplex.points[i];
    ++kept;
  }
  if (kept != newest) simplex.points[kept] = simplex.points[newest];
  simplex.size = kept + 1;
  return way.vector;
}

}  // namespace

// The determinants of its corners by threes, each with the origin, keep their signs. With corners
// no longer than m that are off by r = 107 u (proven_rounding says why; u is half of epsilon) they
// are off by 3 r m^2
// + 3 r^2 m + r^3, and by 50 u m^3 of their own rounding; none exceeds m^3. So 512 u m^2 (1 + m) is
// enough.
template <class Scalar>
bool is_surely_inside(const Simplex<Scalar>& simplex) {
  constexpr Scalar factor = 256 * std::numeric_limits<Scalar>::epsilon();
  const auto w = [&](int i) -> const Vec3<Scalar>& { return simplex.points[i].difference; };
  Scalar longest = 0;
  for (int i = 0; i < 4; ++i) longest = std::max(longest, w(i).squaredNorm());
  const Scalar enough = factor * longest * (1 + std::sqrt(longest));
  const auto determinant = [&](int i, int j, int k) {
    return w(i).dot((w(j) - w(i)).cross(w(k) - w(i)));
  };
  const std::array<Scalar, 4> parts = {determinant(1, 2, 3), -determinant(0, 2, 3),
                                       determinant(0, 1, 3), -determinant(0, 1, 2)};
  const auto [least, most] = std::ranges::minmax(parts);
  return least > enough || most < -enough;
}

namespace {

#define TOUCHSTONE_LANES hull_scan
#define TOUCHSTONE_LOOPS "algorithms/kernels/simplex_walk.inl"
#include "algorithms/kernels/every_level.inl"

}  // namespace

template <class Scalar>
Walk<Scalar> walk(SupportPair<Scalar>& pair, const WalkGoal& goal, Scalar tolerance) {
  switch (isa()) {
    case Isa::avx512: return avx512::walk_at(pair, goal, tolerance);
    case Isa::avx2: return avx2::walk_at(pair, goal, tolerance);
    default: return baseline::walk_at(pair, goal, tolerance);
  }
}

template bool is_surely_inside(const Simplex<float>&);
template bool is_surely_inside(const Simplex<double>&);
template Walk<float> walk(SupportPair<float>&, const WalkGoal&, float);
template Walk<double> walk(SupportPair<double>&, const WalkGoal&, double);

}  // namespace touchstone
