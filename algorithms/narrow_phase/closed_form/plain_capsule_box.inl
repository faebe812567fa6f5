// The nearest point of a segment to a box, by eight numbers at once. plain_capsule_box.cpp includes
// this file once for each level of vector instructions, inside that level's namespace.

// Eight numbers, in one vector or two.
template <class Lanes>
struct Eight {
  static constexpr std::size_t parts = 8 / Lanes::width;
  typename Lanes::Vector part[parts];
};

template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Eight<Lanes> eight_of(const Quad<double>& first,
                                                          const Quad<double>& second) {
  return bit_cast<Eight<Lanes>>(__builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7));
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> greater(const Quad<double>& x,
                                                         const Quad<double>& y) {
  return x > y ? x : y;
}
template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> greater_half(const Eight<Lanes>& x) {
  struct Two {
    Quad<double> first, second;
  };
  const auto [first, second] = bit_cast<Two>(x);
  return greater(first, second);
}

// The greatest number of each.
template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> greatest(const Eight<Lanes>& x,
                                                          const Eight<Lanes>& y,
                                                          const Eight<Lanes>& z,
                                                          const Eight<Lanes>& w) {
  const Quad<double> a = greater_half(x), b = greater_half(y);
  const Quad<double> c = greater_half(z), d = greater_half(w);
  const Quad<double> of_ab =
      greater(__builtin_shufflevector(a, b, 0, 4, 2, 6), __builtin_shufflevector(a, b, 1, 5, 3, 7));
  const Quad<double> of_cd =
      greater(__builtin_shufflevector(c, d, 0, 4, 2, 6), __builtin_shufflevector(c, d, 1, 5, 3, 7));
  return greater(__builtin_shufflevector(of_ab, of_cd, 0, 1, 4, 5),
                 __builtin_shufflevector(of_ab, of_cd, 2, 3, 6, 7));
}

// The t in [-1, 1] at which q + t d is nearest to the box with these half extents around the origin,
// in the axes of the box. The square of the distance is convex along the segment. Half its slope is
// the sum of d_k (x_k - x_k clamped to the box), which is linear between the places where a coordinate
// passes a face: these six and the two ends bracket the zero, and a line between the two that are next
// to it has it.
template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE double nearest_to_box(const Vec& q, const Vec& d,
                                                          const Vec3d& half) {
  using Vector = typename Lanes::Vector;
  const double x = half[0], y = half[1], z = half[2];
  const Eight<Lanes> to_face = eight_of<Lanes>(Quad<double>{x - q.x, -x - q.x, y - q.y, -y - q.y},
                                               Quad<double>{z - q.z, -z - q.z, 1, -1});
  const Eight<Lanes> along =
      eight_of<Lanes>(Quad<double>{d.x, d.x, d.y, d.y}, Quad<double>{d.z, d.z, 1, 1});
  const Vector one = Lanes::broadcast(1), minus_one = Lanes::broadcast(-1);
  const Vector zero = Lanes::broadcast(0);
  const Vector none = Lanes::broadcast(-std::numeric_limits<double>::infinity());
  const double starts[3] = {q.x, q.y, q.z}, steps[3] = {d.x, d.y, d.z};
  Eight<Lanes> low, minus_high, slope_low, minus_slope_high, slopes;
  for (std::size_t i = 0; i < Eight<Lanes>::parts; ++i) {
    // A coordinate that does not change gives an infinity, or NaN, and so an end.
    const Vector t = Lanes::max(Lanes::min(to_face.part[i] / along.part[i], one), minus_one);
    Vector slope = zero;
    for (int k = 0; k < 3; ++k) {
      const Vector step = Lanes::broadcast(steps[k]), most = Lanes::broadcast(half[k]);
      const Vector at = Lanes::broadcast(starts[k]) + t * step;
      slope = slope + step * (at - Lanes::max(Lanes::min(at, most), zero - most));
    }
    const auto rises = Lanes::less(zero, slope), falls = Lanes::less(slope, zero);
    slopes.part[i] = slope;
    low.part[i] = Lanes::select(rises, minus_one, t);
    minus_high.part[i] = Lanes::select(falls, minus_one, zero - t);
    slope_low.part[i] = Lanes::select(rises, none, slope);
    minus_slope_high.part[i] = Lanes::select(falls, none, zero - slope);
  }
  constexpr std::size_t last = Eight<Lanes>::parts - 1;
  const double at_end = slopes.part[last][Lanes::width - 2];
  const double at_start = slopes.part[last][Lanes::width - 1];
  if (!(at_start < 0)) return at_end > 0 ? -1 : 0;
  if (!(at_end > 0)) return 1;
  const Quad<double> ends = greatest(low, minus_high, slope_low, minus_slope_high);
  const double from = ends[0], to = -ends[1], slope_from = ends[2], slope_to = -ends[3];
  const double rise = slope_to - slope_from;
  return rise > 0 ? from - (to - from) * slope_from / rise : (from + to) / 2;
}

TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN bool solve_capsule_box(Task task, const Shape& capsule,
                                                            const Pose& pose_a, const Shape& box,
                                                            const Pose& pose_b, Outcome& outcome,
                                                            double margin) {
  const Vec centre = read(pose_b.translation) - read(pose_a.translation);
  const Vec half = half_of(capsule, pose_a);
  const Vec x = column(pose_b.rotation, 0), y = column(pose_b.rotation, 1),
            z = column(pose_b.rotation, 2);
  const Vec q{-dot(x, centre), -dot(y, centre), -dot(z, centre)};
  const Vec d{dot(x, half), dot(y, half), dot(z, half)};
  const double t = nearest_to_box<Simd<double>>(q, d, box.half_extents);
  return solve_at(task, margin, t, {centre, half, x, y, z, q, d}, capsule.radius, pose_a,
                  box.half_extents, outcome);
}
