// Moving boxes: the test in doubles and in expansions, and the choice of the instruction level.
#include "algorithms/kernels/motion/moving_boxes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/kernels/rays/expansion.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

// A time as a quotient of differences of floats: (a - b) / (c - d), with c > d.
struct Time {
  double a, b, c, d;
};
constexpr Time start = {0, 0, 1, 0};
constexpr Time end = {1, 0, 1, 0};

// Every product of two differences of floats is a sum of multiples of 2^-298 below 2^259, so that
// nothing underflows or overflows.
bool is_later(const Time& s, const Time& t) {
  const auto product = [](double a, double b, double c, double d) {
    return FloatExpansion::difference(a, b) * FloatExpansion::difference(c, d);
  };
  return (product(s.a, s.b, t.c, t.d) - product(t.a, t.b, s.c, s.d)).sign() > 0;
}

}  // namespace

bool moving_boxes_meet(const MovingBox& a, const MovingBox& b) {
  if (a.box.is_empty() || b.box.is_empty()) return false;
  // No time of `entries` may be later than one of `exits`.
  std::array<Time, 4> entries = {start}, exits = {end};
  std::size_t axes = 0;
  double first = 0, last = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double min_a = a.box.min[k], max_a = a.box.max[k], move_a = a.displacement[k];
    const double min_b = b.box.min[k], max_b = b.box.max[k], move_b = b.displacement[k];
    if (move_a == move_b) {
      if (max_b < min_a || max_a < min_b) return false;
      continue;
    }
    ++axes;
    // In order of time: a's lower end and b's upper one, or the other two.
    if (move_a > move_b) {
      entries[axes] = {min_b, max_a, move_a, move_b};
      exits[axes] = {max_b, min_a, move_a, move_b};
    } else {
      entries[axes] = {min_a, max_b, move_b, move_a};
      exits[axes] = {max_a, min_b, move_b, move_a};
    }
    const auto value = [](const Time& t) { return (t.a - t.b) / (t.c - t.d); };
    first = std::max(first, value(entries[axes]));
    last = std::min(last, value(exits[axes]));
  }
  // A time is off by less than 4 u of itself, u = 2^-53; infinite ends give infinite times.
  first = std::min(first, 2.0);
  last = std::max(last, -1.0);
  const double slack = 0x1p-49 * std::max(std::abs(first), std::abs(last));
  if (first + slack <= last) return true;
  if (last + slack < first) return false;
  for (std::size_t i = 0; i <= axes; ++i) {
    for (std::size_t k = 0; k <= axes; ++k) {
      const auto is_finite = [](const Time& t) { return std::isfinite(t.a - t.b); };
      if (is_finite(entries[i]) && is_finite(exits[k]) && is_later(entries[i], exits[k]))
        return false;
    }
  }
  return true;
}

namespace {
#define TOUCHSTONE_TARGET_NAMESPACE simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/motion/moving_boxes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"
}  // namespace

void keep_meeting(std::span<const MovingBox> bodies, std::span<const IndexPair> pairs,
                  PairBuffer& kept) {
  const auto whole = [&] {
    switch (isa()) {
      case Isa::avx512: return avx512::keep_whole(bodies.data(), pairs, kept);
      case Isa::avx2: return avx2::keep_whole(bodies.data(), pairs, kept);
      default: return baseline::keep_whole(bodies.data(), pairs, kept);
    }
  };
  for (const IndexPair& pair : pairs.subspan(whole())) {
    if (moving_boxes_meet(bodies[pair.a], bodies[pair.b])) kept.push(pair.a, pair.b);
  }
}

}  // namespace touchstone
