// Part of gjk-ray-cast-lanes, included by round_lanes.cpp for each level of vector instructions.
#include "algorithms/kernels/simd/lane_rows.inl"

// A parallelogram about 0 in each lane.
struct Parallelogram {
  using Vector = typename Simd<double>::Vector;
  Vector3<double> p, q;
  Vector pp, qq, pq;
};

struct FromParallelogram {
  using Vector = typename Simd<double>::Vector;
  Vector3<double> away;  // from its nearest point
  Vector place;          // of that point along p, in [-1, 1]
};

// x / y in [-1, 1]; 0 where y is not positive.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<double>::Vector within(
    typename Simd<double>::Vector x, typename Simd<double>::Vector y) {
  using Lanes = Simd<double>;
  const auto one = Lanes::broadcast(1), zero = Lanes::broadcast(0);
  const auto some = Lanes::less(zero, y);
  return Lanes::select(some, Lanes::max(-one, Lanes::min(x / Lanes::select(some, y, one), one)),
                       zero);
}

// Ericson, "Real-Time Collision Detection", 2005, section 5.1.9.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE FromParallelogram nearest_of(const Parallelogram& shape,
                                                                 const Vector3<double>& x) {
  const auto xp = dot<double>(x, shape.p), xq = dot<double>(x, shape.q);
  const auto determinant = shape.pp * shape.qq - shape.pq * shape.pq;
  auto place = within(xp * shape.qq - xq * shape.pq, determinant);
  const auto other = within(xq - place * shape.pq, shape.qq);
  place = within(xp - other * shape.pq, shape.pp);
  return {moved<double>(moved<double>(x, -place, shape.p), -other, shape.q), place};
}

TOUCHSTONE_TARGET inline void cast_lanes(const RoundLane* pairs, LaneTimes* times,
                                         std::size_t count) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  constexpr std::size_t width = Lanes::width;
  constexpr int most_planes = 12, most_tries = 4;
  alignas(64) double rows[sizeof(RoundLane) / sizeof(double)][width];
  load_rows(pairs, count, rows);
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  Parallelogram shape{three_rows(rows), three_rows(rows + 3), zero, zero, zero};
  shape.pp = dot<double>(shape.p, shape.p);
  shape.qq = dot<double>(shape.q, shape.q);
  shape.pq = dot<double>(shape.p, shape.q);
  const Vector3<double> offset = three_rows(rows + 6), velocity = three_rows(rows + 9);
  const Vector radius_a = Lanes::load(rows[12]), radius = Lanes::load(rows[13]);
  const Vector tolerance = Lanes::load(rows[14]);
  const Vector square = dot<double>(velocity, velocity);
  const Vector error =
      Lanes::broadcast(48 * 0x1p-53) * ((length_of(offset) + Lanes::sqrt(square)) +
                                        (Lanes::sqrt(shape.pp) + Lanes::sqrt(shape.qq)) + radius);
  const Mask is_round = Lanes::less(Lanes::broadcast(0x1p10) * error, radius);
  const Vector near = radius + Lanes::max(tolerance, Lanes::broadcast(4) * error);

  Vector time = zero, distance = zero, place = zero, look = zero;
  // The first look is where the centres are nearest.
  const Vector half = within(-dot<double>(offset, velocity), square);
  look = Lanes::max(half, zero);
  Vector3<double> normal = {zero, zero, zero};
  Vector speed = zero;
  Mask miss = Lanes::less(one, zero), hit = miss;
  unsigned active = (1u << width) - 1;
  int planes = 0;
  for (; planes < most_planes && active != 0; ++planes) {
    const Mask on = Lanes::from_bits(active);
    const Vector3<double> x = moved<double>(offset, look, velocity);
    const FromParallelogram found = nearest_of(shape, x);
    const Vector away = length_of(found.away);
    const Mask touches =
        planes == 0 ? Lanes::less(one, zero) : both(on, Lanes::less_equal(away, near));
    hit = either(hit, touches);
    distance = Lanes::select(touches, away, distance);
    place = Lanes::select(touches, found.place, place);
    const Vector3<double> n = scaled<double>(one / away, found.away);
    const Vector start = dot<double>(n, offset) - Lanes::abs(dot<double>(n, shape.p)) -
                         Lanes::abs(dot<double>(n, shape.q)) - radius - error;
    const Vector closing = -dot<double>(n, velocity);
    // The gap is linear in time: if it is open at `time`, from which it is reached, and later, then
    // between them too.
    const Mask opens = without(both(on, Lanes::less(zero, start - time * closing)), touches);
    const Mask passes = both(opens, Lanes::less(zero, start - closing));
    miss = either(miss, passes);
    const Vector reached = start / closing * Lanes::broadcast(1 - 0x1p-50);
    const Mask goes = both(without(opens, passes), Lanes::less(time, reached));
    time = Lanes::select(goes, Lanes::min(reached, one), time);
    // Where they touch, the nearest points name it, unless the radii are no more than rounding.
    normal = select<double>(either(goes, both(touches, is_round)), n, normal);
    const Mask at_start = both(touches, Lanes::less_equal(time, zero));
    speed = Lanes::select(either(goes, at_start), closing, speed);
    // Past the first look, a lane that gains nothing is left open.
    unsigned stays = planes == 0 ? active : Lanes::to_bits(goes);
    stays &= ~Lanes::to_bits(either(miss, hit));
    active &= stays;
    look = time;
  }

  // Bodies that overlap at time 0, and whose axes are further apart than rounding.
  const Mask overlaps = both(both(hit, Lanes::less_equal(time, zero)),
                             both(Lanes::less(Lanes::broadcast(0x1p10) * error, distance),
                                  Lanes::less(distance + error, radius)));
  unsigned hits = Lanes::to_bits(overlaps);
  Vector upper = Lanes::select(overlaps, zero, Lanes::broadcast(2));
  // Otherwise, a little later the bodies are surely nearer than the radii.
  const Vector deep = Lanes::max(distance - radius, zero) + Lanes::broadcast(8) * error;
  Vector step = deep / speed;
  unsigned open = Lanes::to_bits(both(hit, Lanes::less(zero, speed))) & ~hits;
  for (int k = 0; k < most_tries && open != 0; ++k) {
    const Vector later = Lanes::min(time + step, one);
    const Vector there =
        length_of(nearest_of(shape, moved<double>(offset, later, velocity)).away) + error;
    const unsigned proven = open & Lanes::to_bits(Lanes::less(there, radius));
    upper = Lanes::select(Lanes::from_bits(proven), later, upper);
    hits |= proven;
    open &= ~proven;
    step = step * Lanes::broadcast(16);
  }
  const unsigned misses = Lanes::to_bits(miss);
  // In the ball of either body as deep as in the other's, in proportion to their radii.
  const Vector deep_in_a = Lanes::min(distance / radius, one) * radius_a;
  const Vector3<double> on_a = moved<double>(scaled<double>(place, shape.p), deep_in_a, normal);
  alignas(64) double out[8][width];
  const Vector results[8] = {time, upper, normal.x, normal.y, normal.z, on_a.x, on_a.y, on_a.z};
  for (std::size_t k = 0; k < 8; ++k) Lanes::store(out[k], results[k]);
  for (std::size_t lane = 0; lane < std::min(count, width); ++lane) {
    times[lane] = {.is_miss = (misses >> lane & 1) != 0,
                   .is_hit = (hits >> lane & 1) != 0,
                   .lower = out[0][lane],
                   .upper = out[1][lane],
                   .normal = {out[2][lane], out[3][lane], out[4][lane]},
                   .on_a = {out[5][lane], out[6][lane], out[7][lane]},
                   .iterations = planes};
  }
}

TOUCHSTONE_TARGET inline void cast_all_lanes(std::span<const RoundLane> pairs,
                                             std::span<LaneTimes> times) {
  constexpr std::size_t width = Simd<double>::width;
  for (std::size_t i = 0; i < pairs.size(); i += width) {
    cast_lanes(&pairs[i], &times[i], pairs.size() - i);
  }
}
