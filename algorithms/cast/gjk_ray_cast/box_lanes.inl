// Part of gjk-ray-cast-lanes, included by box_lanes.cpp for each level of vector instructions.
#include "algorithms/kernels/simd/lane_rows.inl"

// When the shadows of a lane's boxes overlap, over all axes seen so far.
struct LaneShadows {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;

  Vector offset_error;         // the bound on the error of a gap
  Vector begins, ends;         // no contact before the first time, nor after the second
  Vector surely, surely_ends;  // contact between these, if all axes agree
  Vector parallel;             // how far a box is off that is turned until edges are parallel
  Vector3<double> normal;      // of the axis that begins last
  typename Lanes::Mask miss;
};

// Two boxes in each lane.
struct LaneBoxes {
  using Vector = typename Simd<double>::Vector;
  Vector3<double> columns[2][3], edges[2][3];
  Vector3<double> offset, velocity;
  // Across edges, where they are not nearly parallel.
  Vector3<double> across[3][3];
  typename Simd<double>::Mask is_axis[3][3];
};

// Calls visit(axis, reach, counts) for the 15 axes: the boxes' half edges reach so far along it, and it is well
// defined in the lanes that count.
template <class Visit>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void for_each_axis(const LaneBoxes& boxes, Visit& visit) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  const auto& [columns, edges, offset, velocity, across, is_axis] = boxes;
  const auto all = Lanes::less(Lanes::broadcast(0), Lanes::broadcast(1));
  for (std::size_t body = 0; body < 2; ++body) {
    const std::size_t other = 1 - body;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const Vector3<double> n = cross<double>(columns[body][j], columns[body][k]);
      const Vector reach = Lanes::abs(dot<double>(n, edges[body][i])) +
                           ((Lanes::abs(dot<double>(n, edges[other][0])) +
                             Lanes::abs(dot<double>(n, edges[other][1]))) +
                            Lanes::abs(dot<double>(n, edges[other][2])));
      visit(n, reach, all);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3<double>& n = across[i][k];
      const Vector reach = (Lanes::abs(dot<double>(n, edges[0][(i + 1) % 3])) +
                            Lanes::abs(dot<double>(n, edges[0][(i + 2) % 3]))) +
                           (Lanes::abs(dot<double>(n, edges[1][(k + 1) % 3])) +
                            Lanes::abs(dot<double>(n, edges[1][(k + 2) % 3])));
      visit(n, reach, is_axis[i][k]);
    }
  }
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void add_axis(LaneShadows& shadows, const Vector3<double>& n,
                                                  const Vector3<double>& offset,
                                                  const Vector3<double>& velocity,
                                                  typename Simd<double>::Vector reach,
                                                  typename Simd<double>::Mask counts) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const Vector less_time = Lanes::broadcast(1 - 0x1p-50), more_time = Lanes::broadcast(1 + 0x1p-50);
  const Vector start = dot<double>(n, offset), speed = dot<double>(n, velocity),
               end = start + speed;
  const Vector outer = reach + shadows.offset_error;
  const Mask apart_first = Lanes::less(outer, Lanes::abs(start));
  const Mask apart_last = Lanes::less(outer, Lanes::abs(end));
  const Mask same_side = Lanes::less(zero, start * end);
  shadows.miss = either(shadows.miss, both(both(apart_first, apart_last), same_side));
  // The shadows close at the greatest speed that is left between the sides.
  const Vector pace = Lanes::abs(speed);
  const Vector enter = (Lanes::abs(start) - outer) / pace * less_time;
  const Vector leave = one - (Lanes::abs(end) - outer) / pace * less_time;
  const Mask later = both(apart_first, Lanes::less(shadows.begins, enter));
  shadows.begins = Lanes::select(later, enter, shadows.begins);
  const Mask backward = Lanes::less(start, zero);
  shadows.normal =
      select<double>(later, select<double>(backward, {-n.x, -n.y, -n.z}, n), shadows.normal);
  shadows.ends =
      Lanes::select(both(apart_last, Lanes::less(leave, shadows.ends)), leave, shadows.ends);

  const Vector inner = reach - shadows.offset_error - shadows.parallel;
  const Mask in_first = Lanes::less_equal(Lanes::abs(start), inner);
  const Mask in_last = Lanes::less_equal(Lanes::abs(end), inner);
  const Vector entered = (Lanes::abs(start) - inner) / pace * more_time;
  const Vector left = one - (Lanes::abs(end) - inner) / pace * more_time;
  const Vector never = Lanes::broadcast(2);
  // Bodies that enter on one side and leave on the other, or never come inside by the margin.
  const Mask enters = both(Lanes::less(zero, inner), Lanes::less(start * speed, zero));
  const Vector sure_begin = Lanes::select(in_first, zero, Lanes::select(enters, entered, never));
  const Mask leaves = both(Lanes::less(zero, inner), Lanes::less(zero, end * speed));
  const Vector sure_end = Lanes::select(in_last, one, Lanes::select(leaves, left, -never));
  shadows.surely = Lanes::select(both(counts, Lanes::less(shadows.surely, sure_begin)), sure_begin,
                                 shadows.surely);
  shadows.surely_ends = Lanes::select(both(counts, Lanes::less(sure_end, shadows.surely_ends)),
                                      sure_end, shadows.surely_ends);
}

// Adds each axis to the shadows.
struct AddAxis {
  const LaneBoxes& boxes;
  LaneShadows& shadows;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void operator()(const Vector3<double>& axis,
                                                      typename Simd<double>::Vector reach,
                                                      typename Simd<double>::Mask counts) {
    add_axis(shadows, axis, boxes.offset, boxes.velocity, reach, counts);
  }
};

// Finds the axis along which boxes at time 0 are furthest apart, or least deep in each other.
struct FindTouch {
  using Vector = typename Simd<double>::Vector;
  const LaneBoxes& boxes;
  Vector gap;  // along the normal
  Vector3<double> normal;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void operator()(const Vector3<double>& axis, Vector reach,
                                                      typename Simd<double>::Mask counts) {
    using Lanes = Simd<double>;
    const Vector zero = Lanes::broadcast(0);
    const Vector start = dot<double>(axis, boxes.offset);
    // A short axis, of edges that are nearly parallel, tells less than the tolerance.
    const Vector length = length_of(axis);
    const Vector apart = (Lanes::abs(start) - reach) / length;
    const auto better =
        both(both(counts, Lanes::less(Lanes::broadcast(1e-3), length)), Lanes::less(gap, apart));
    gap = Lanes::select(better, apart, gap);
    normal = select<double>(
        better, select<double>(Lanes::less(start, zero), {-axis.x, -axis.y, -axis.z}, axis),
        normal);
  }
};

TOUCHSTONE_TARGET inline void cast_lanes(const BoxLane* boxes, LaneTimes* times,
                                         std::size_t count) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  constexpr std::size_t width = Lanes::width;
  constexpr std::size_t numbers = sizeof(BoxLane) / sizeof(double);
  alignas(64) double rows[numbers][width];
  load_rows(boxes, count, rows);
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  LaneBoxes both_boxes;
  auto& [columns, edges, offset, velocity, across, is_axis] = both_boxes;
  Vector size = zero;
  for (std::size_t body = 0; body < 2; ++body) {
    Vector own = zero;
    for (std::size_t k = 0; k < 3; ++k) {
      columns[body][k] = three_rows(rows + 9 * body + 3 * k);
      const Vector extent = Lanes::load(rows[18 + 3 * body + k]);
      edges[body][k] = scaled<double>(extent, columns[body][k]);
      own = own + extent;
    }
    size = size + own;
  }
  offset = three_rows(rows + 24);
  velocity = three_rows(rows + 27);

  LaneShadows shadows;
  shadows.offset_error =
      Lanes::broadcast(128 * 0x1p-53) * (length_of(offset) + length_of(velocity) + size);
  shadows.begins = zero;
  shadows.ends = one;
  shadows.surely = zero;
  shadows.surely_ends = one;
  shadows.normal = {zero, zero, zero};
  shadows.miss = Lanes::less(one, zero);
  // Pairs of edges that are parallel are found first, since all axes allow for them.
  shadows.parallel = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      across[i][k] = cross<double>(columns[0][i], columns[1][k]);
      const Vector sine = length_of(across[i][k]);
      is_axis[i][k] = Lanes::less(Lanes::broadcast(1e-9), sine);
      const Vector off = Lanes::broadcast(16) * size * (sine + Lanes::broadcast(16 * 0x1p-53));
      shadows.parallel = shadows.parallel + Lanes::select(is_axis[i][k], zero, off);
    }
  }
  AddAxis add{both_boxes, shadows};
  for_each_axis(both_boxes, add);
  const Mask miss = either(shadows.miss, Lanes::less(shadows.ends, shadows.begins));
  const Mask in_time = both(Lanes::less_equal(shadows.surely, shadows.surely_ends),
                            Lanes::less_equal(shadows.surely, one));
  const Vector path = (shadows.surely - shadows.begins) * length_of(velocity);
  const Vector tolerance = Lanes::load(rows[30]);
  const Mask hit = both(in_time, both(Lanes::less_equal(path, tolerance),
                                      Lanes::less_equal(shadows.begins, shadows.surely)));
  const unsigned misses = Lanes::to_bits(miss), hits = Lanes::to_bits(hit) & ~misses;
  const Mask at_start = both(hit, Lanes::less_equal(shadows.begins, zero));
  if (Lanes::to_bits(at_start) != 0) {
    // Bodies that are deeper in each other than the tolerance have no normal.
    FindTouch touch{both_boxes, -tolerance, {zero, zero, zero}};
    for_each_axis(both_boxes, touch);
    shadows.normal = select<double>(at_start, touch.normal, shadows.normal);
  }
  alignas(64) double out[5][width];
  const Vector results[5] = {shadows.begins, shadows.surely, shadows.normal.x, shadows.normal.y,
                             shadows.normal.z};
  for (std::size_t k = 0; k < 5; ++k) Lanes::store(out[k], results[k]);
  for (std::size_t lane = 0; lane < std::min(count, width); ++lane) {
    times[lane] = {.is_miss = (misses >> lane & 1) != 0,
                   .is_hit = (hits >> lane & 1) != 0,
                   .lower = out[0][lane],
                   .upper = out[1][lane],
                   .normal = {out[2][lane], out[3][lane], out[4][lane]},
                   .on_a = Vec3d::Constant(std::numeric_limits<double>::quiet_NaN()),
                   .iterations = 1};
  }
}

TOUCHSTONE_TARGET inline void cast_all_lanes(std::span<const BoxLane> boxes,
                                             std::span<LaneTimes> times) {
  constexpr std::size_t width = Simd<double>::width;
  for (std::size_t i = 0; i < boxes.size(); i += width) {
    cast_lanes(&boxes[i], &times[i], boxes.size() - i);
  }
}
