// Part of certified: the vertices near the plane of contact, and what their portal proves.
#include "algorithms/narrow_phase/certified/exact_contact.h"

#include <array>
#include <cmath>
#include <span>
#include <type_traits>

#include "algorithms/narrow_phase/certified/exact_gap.inl"
#include "algorithms/narrow_phase/certified/exact_height.inl"
#include "algorithms/narrow_phase/certified/exact_portal.inl"

namespace touchstone {
namespace {

// A plane whose normal differs by 2^-33 moves a vertex by less than 2^-31 of the unit, so one that
// is this far behind the support plane, less the rounding of that, stays behind another.
constexpr double slab_of_unit = 0x1p-29;

// The numbers of a pair of bodies, split.
struct GridPair {
  const PlacedBody &a, &b;
  SplitPose split_a, split_b;
  std::array<SplitDouble, 2> radii;
  double unit;   // metres
  int step = 0;  // of the grid: a power of two

  // Coordinates are relative to `origin`.
  GridPair(const PlacedBody& a_, const PlacedBody& b_, const Vec3d& origin, double unit_)
      : a(a_),
        b(b_),
        split_a(a.pose, origin),
        split_b(b.pose, origin),
        radii{SplitDouble(a.shape.solid.radius), SplitDouble(b.shape.solid.radius)},
        unit(unit_) {}

  void add_to(GridRange& range) const {
    for (const SplitDouble& radius : radii) range.add(radius);
    add(split_a, a.shape.solid, range);
    add(split_b, b.shape.solid, range);
  }

 private:
  static void add(const SplitPose& pose, const oracle::Solid& solid, GridRange& range) {
    for (std::size_t i = 0; i < 3; ++i) {
      range.begin_sum();
      for (const SplitDouble& part : pose.place[i]) range.add(part);
      if (solid.vertices.empty()) continue;
      for (std::size_t j = 0; j < 3; ++j) {
        range.add(pose.matrix[i][j], solid.grid[j], solid.exponent);
      }
    }
  }
};

template <std::size_t size>
FixedInteger<size> sum_on_grid(std::span<const SplitDouble> parts, int step) {
  FixedInteger<size> sum;
  for (const SplitDouble& part : parts) {
    if (part.mantissa == 0) continue;
    add_product(sum, part.mantissa, 1, static_cast<unsigned>(part.exponent - step));
  }
  return sum;
}

template <std::size_t size>
void write(const ExactPortal<size>& portal, const GridBody<size>& a, const GridBody<size>& b,
           double metres, const Vec3d& origin, ExactContact& contact) {
  const auto& proof = portal.proof();
  contact.normal = proof.normal;
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& corner = proof.portal[k];
    const double weight = proof.weights[static_cast<int>(k)];
    on_a += weight * rounded(a[corner.a]);
    on_b += weight * rounded(b[corner.b]);
  }
  contact.on_a = origin + metres * on_a;
  contact.on_b = origin + metres * on_b;
  if (contact.answer == Answer::touching) {
    contact.lower = contact.upper = 0;
    return;
  }
  // The plane bounds the signed distance from below, the portal's point from above.
  const double along = metres * proof.lower;
  contact.lower = along - 0x1p-48 * std::abs(along);
  contact.upper = contact.answer == Answer::separated ? metres * proof.upper : 0;
}

template <std::size_t size>
void solve(const GridPair& pair, const ContactGuess& guess, SupportPair<double>& supports,
           Task task, std::vector<double>& heights, ExactContact& contact) {
  GridBody<size> a(pair.a, pair.split_a, pair.step, heights);
  GridBody<size> b(pair.b, pair.split_b, pair.step, heights);
  const double metres = std::ldexp(1.0, pair.step), slab = slab_of_unit * pair.unit;
  const oracle::Solid &solid_a = pair.a.shape.solid, &solid_b = pair.b.shape.solid;
  if (solid_a.radius + solid_b.radius > 0) {
    const auto count = static_cast<std::size_t>(guess.simplex.size);
    if (!a.list_near(guess.normal, slab) || !b.list_near(-guess.normal, slab)) return;
    std::array<std::array<std::size_t, 2>, 3> corners = {};
    for (std::size_t k = 0; k < count; ++k) {
      const DifferencePoint<double>& point = guess.simplex.points[k];
      corners[k] = {a.nearest(point.a, pair.unit, Vec3d::Zero()),
                    b.nearest(point.b, pair.unit, supports.centre_b())};
    }
    const ExactGap<size> gap(a, b, sum_on_grid<size>(pair.radii, pair.step));
    contact.answer = gap.decide(std::span(corners).first(count), [&](const Vec3d& direction) {
      return is_same_direction(direction.stableNormalized(), -guess.normal);
    });
    return;
  }
  RoughPortal rough(supports, solid_a, solid_b, guess.simplex);
  ExactPortal<size> portal(a, b, metres, pair.unit, slab, task);
  contact.answer = portal.decide(rough, guess.normal);
  if (asks_for_number(task, contact.answer)) {
    write(portal, a, b, metres, pair.a.pose.translation, contact);
  }
}

// Calls with the least number of limbs, as a constant, that holds the bits. Returns what that
// returns, or an empty value if there is none.
template <class Result, class Call>
Result with_size_of(int bits, const Call& call) {
  const auto of = [&]<std::size_t size>() {
    return call(std::integral_constant<std::size_t, size>{});
  };
  // A product of three coordinates is a sum of six, which takes 2 bits more than thrice theirs.
  if (bits <= 62) return of.template operator()<1>();
  if (bits <= 126) return of.template operator()<2>();
  if (bits <= 190) return of.template operator()<3>();
  if (bits <= 254) return of.template operator()<4>();
  return Result{};
}

// Returns false if every number is zero, or lengths in steps of the grid are no doubles.
bool is_a_grid(const GridRange& range) {
  return range.least <= range.most && range.least >= -900 && range.most <= 900;
}

}  // namespace

ExactContact ExactContactFinder::find(const PlacedBody& a, const PlacedBody& b,
                                      const ContactGuess& guess, SupportPair<double>& supports,
                                      Task task) {
  const int count = guess.simplex.size;
  if (!(count >= 1 && count <= 3) && a.shape.solid.radius + b.shape.solid.radius > 0) return {};
  if (!(std::abs(guess.normal.squaredNorm() - 1) < 0x1p-45)) return {};
  GridPair pair(a, b, a.pose.translation, supports.unit());
  GridRange range;
  pair.add_to(range);
  if (!is_a_grid(range)) return {};
  pair.step = range.least;
  return with_size_of<ExactContact>(range.bits(), [&](auto size) {
    ExactContact contact;
    solve<size>(pair, guess, supports, task, heights_, contact);
    return contact;
  });
}

Answer ExactContactFinder::find_over_plane(const PlacedBody& a, const PlacedBody& halfspace,
                                           double unit) {
  const oracle::Solid& solid = halfspace.shape.solid;
  bool fits = false;
  const GridPlane plane(solid.normal, solid.offset, fits);
  if (!fits || !halfspace.pose.rotation.isIdentity(0)) return Answer::unknown;
  GridPair pair(a, halfspace, halfspace.pose.translation, unit);
  SplitDouble offset = plane.offset;
  offset.exponent -= plane.exponent;
  GridRange range;
  pair.add_to(range);
  range.add(offset);
  if (!is_a_grid(range)) return Answer::unknown;
  pair.step = range.least;
  const auto answer = with_size_of<std::optional<Answer>>(range.bits(), [&](auto size) {
    GridBody<size> body(a, pair.split_a, pair.step, heights_);
    const Vec3d down = -solid.normal.stableNormalized();
    if (!body.list_near(down, slab_of_unit * unit)) return std::optional<Answer>{};
    const auto radius = sum_on_grid<size>(pair.radii, pair.step);
    return std::optional(verdict_over_plane<size>(body, plane, radius, pair.step));
  });
  return answer.value_or(Answer::unknown);
}

}  // namespace touchstone
