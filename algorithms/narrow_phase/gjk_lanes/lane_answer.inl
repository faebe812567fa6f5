// Part of gjk-lanes, included by lane_gjk.inl: writes the answers of lanes that have ended.
#include "algorithms/narrow_phase/gjk_lanes/lane_start.inl"

// The points of the lanes' simplices that are nearest to the origin.
template <class Scalar>
struct Nearest {
  Vector3<Scalar> point, on_a;  // of the difference, and on the core of a
  unsigned sound;               // lanes without a negative weight, as bits
};

template <class Scalar, bool points>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Nearest<Scalar> find_nearest(
    const LaneSimplex<Scalar>& simplex) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const auto& [b, c, d, has_b, has_c, has_d] = simplex;
  const Vector3<Scalar> nothing{zero, zero, zero};
  const Vector3<Scalar> to_c = select<Scalar>(has_c, difference<Scalar>(c.point, b.point), nothing);
  const Vector3<Scalar> to_d = select<Scalar>(has_d, difference<Scalar>(d.point, b.point), nothing);
  const Vector cc = Lanes::select(has_c, dot<Scalar>(to_c, to_c), one);
  const Vector dd = Lanes::select(has_d, dot<Scalar>(to_d, to_d), one);
  const Vector cd = dot<Scalar>(to_c, to_d);
  const Vector scale = one / (cc * dd - cd * cd);
  Vector of_c = zero, of_d = zero;
  Nearest<Scalar> nearest;
  nearest.point = b.point;
  // The second pass removes what rounding left.
  for (int time = 0; time < 2; ++time) {
    const Vector left_c = -dot<Scalar>(nearest.point, to_c),
                 left_d = -dot<Scalar>(nearest.point, to_d);
    of_c = of_c + (dd * left_c - cd * left_d) * scale;
    of_d = of_d + (cc * left_d - cd * left_c) * scale;
    nearest.point = moved<Scalar>(moved<Scalar>(b.point, of_c, to_c), of_d, to_d);
  }
  nearest.sound = ~Lanes::to_bits(Lanes::less(Lanes::min(of_c, of_d), zero)) &
                  ~Lanes::to_bits(Lanes::less(one, of_c + of_d));
  if constexpr (points) {
    nearest.on_a = b.on_a;
    nearest.on_a = moved<Scalar>(
        nearest.on_a, of_c, select<Scalar>(has_c, difference<Scalar>(c.on_a, b.on_a), nothing));
    nearest.on_a = moved<Scalar>(
        nearest.on_a, of_d, select<Scalar>(has_d, difference<Scalar>(d.on_a, b.on_a), nothing));
  }
  return nearest;
}

// Writes distances (depths if negative), bounds, normals and witness points of the given lanes.
// Leaves out lanes whose nearest point does not agree with the support plane. Returns the lanes
// that it wrote, as bits.
template <class Scalar>
TOUCHSTONE_TARGET unsigned write_distances(const PairTable<Scalar>& table,
                                           const LaneGoal<Scalar>& goal,
                                           const LaneState<Scalar>& state,
                                           const Nearest<Scalar>& nearest, unsigned lanes) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector one = Lanes::broadcast(1), margin = Lanes::broadcast(lane_rounding<Scalar>);
  const Vector scale = one / state.length;
  const Vector3<Scalar> direction = scaled<Scalar>(scale, state.search);
  const Vector distance = state.along * scale, lower = state.plane * scale;
  const Vector3<Scalar> aside = moved<Scalar>(nearest.point, -distance, direction);
  const Vector most =
      Lanes::max(Lanes::max(Lanes::abs(aside.x), Lanes::abs(aside.y)), Lanes::abs(aside.z));
  lanes &= nearest.sound & Lanes::to_bits(Lanes::less(most, Scalar(0.5) * margin));
  if (lanes == 0) return 0;
  const Vector radius = state.radius_a + state.radius_b;
  const Vector3<Scalar> normal = scaled<Scalar>(-one, direction);
  const Vector3<Scalar> on_a = moved<Scalar>(nearest.on_a, state.radius_a, normal);
  const Vector3<Scalar> on_b =
      moved<Scalar>(difference<Scalar>(nearest.on_a, nearest.point), -state.radius_b, normal);
  Vector columns[3][4] = {
      {distance - radius, lower - radius - margin, distance - radius + margin, normal.x},
      {normal.y, normal.z, on_a.x, on_a.y},
      {on_a.z, on_b.x, on_b.y, on_b.z}};
  alignas(64) Quad<Scalar> quads[3][Lanes::width];
  for (std::size_t k = 0; k < 3; ++k) quads_of<Scalar>(columns[k], quads[k]);
  for (unsigned open = lanes; open != 0; open &= open - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(open));
    const std::uint32_t place_of_pair = state.place[lane];
    const std::uint32_t body = table.pairs.first[place_of_pair];
    const Pose& pose = table.pairs.poses[body];
    Quad<double> origin = pose_quad(pose, 8);
    if (!goal.centred) {
      origin += turned_centre(goal.shapes[table.pairs.shape_of[body]], pose);
    }
    const Quad<double> none{};
    const double unit = state.unit[lane];
    const std::size_t at = place<Lanes>(lane);
    char* const to = reinterpret_cast<char*>(&table.outcomes[place_of_pair].distance);
    put_quad(widen<Scalar>(quads[0][at]) * Quad<double>{unit, unit, unit, 1}, to);
    put_quad(widen<Scalar>(quads[1][at]) * Quad<double>{1, 1, unit, unit} +
                 __builtin_shufflevector(none, origin, 0, 0, 5, 6),
             to + sizeof origin);
    put_quad(
        widen<Scalar>(quads[2][at]) * unit + __builtin_shufflevector(origin, origin, 3, 1, 2, 3),
        to + 2 * sizeof origin);
  }
  return lanes;
}

// Appends the planes that part the pairs of the given lanes. Their last search direction lies across
// the newest support plane.
template <class Scalar>
TOUCHSTONE_TARGET void note_planes(const LaneState<Scalar>& state, unsigned lanes,
                                   std::vector<LanePlane>& planes) {
  constexpr std::size_t width = LaneState<Scalar>::width;
  alignas(64) Scalar x[width], y[width], z[width], along[width], length[width], radius[width];
  std::memcpy(x, &state.search.x, sizeof x);
  std::memcpy(y, &state.search.y, sizeof y);
  std::memcpy(z, &state.search.z, sizeof z);
  std::memcpy(along, &state.plane, sizeof along);
  std::memcpy(length, &state.length, sizeof length);
  const auto radii = state.radius_a + state.radius_b;
  std::memcpy(radius, &radii, sizeof radius);
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const double per_length = 1 / static_cast<double>(length[lane]);
    // The length is off by rounding as well as the bound.
    const double gap = static_cast<double>(along[lane]) * per_length -
                       static_cast<double>(radius[lane] + 2 * lane_rounding<Scalar>);
    planes.push_back({state.place[lane],
                      {-x[lane] * per_length, -y[lane] * per_length, -z[lane] * per_length},
                      state.unit[lane] * gap});
  }
}

// Writes the answers of lanes that have ended, and the places of pairs without an answer to `left`.
// Returns the new number of places in `left`.
template <class Scalar, bool points>
TOUCHSTONE_TARGET std::size_t answer_lanes(const PairTable<Scalar>& table,
                                           const LaneGoal<Scalar>& goal, LaneState<Scalar>& state,
                                           std::size_t left) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  unsigned apart = state.apart, inside = state.inside;
  if (goal.planes != nullptr && apart != 0) note_planes<Scalar>(state, apart, *goal.planes);
  const unsigned with_points = !points ? 0 : goal.starts == nullptr ? apart : state.shallow;
  if ((with_points | state.shallow) != 0) {
    const Nearest<Scalar> nearest = find_nearest<Scalar, points>(state.simplex);
    if constexpr (points) {
      const unsigned written = write_distances<Scalar>(table, goal, state, nearest, with_points);
      (goal.starts == nullptr ? apart : inside) = written;
    }
    if (state.shallow != 0 && goal.starts == nullptr) {
      // A point of the difference that is nearer than the radii proves an overlap.
      const Vector length = Lanes::sqrt(dot<Scalar>(nearest.point, nearest.point));
      const Vector enough =
          state.radius_a + state.radius_b - Lanes::broadcast(lane_rounding<Scalar>);
      inside |= state.shallow & nearest.sound & Lanes::to_bits(Lanes::less(length, enough));
    }
  }
  alignas(64) Scalar counts[Lanes::width];
  std::memcpy(counts, &state.count, sizeof counts);
  for (unsigned open = state.ended(); open != 0; open &= open - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(open));
    const std::uint32_t place_of_pair = state.place[lane];
    if (((apart | inside) >> lane & 1) == 0) {
      table.left[left++] = place_of_pair;
      continue;
    }
    write_verdict((apart >> lane & 1) != 0, static_cast<std::int32_t>(counts[lane]),
                  table.outcomes[place_of_pair]);
  }
  state.apart = state.inside = state.shallow = state.doubtful = 0;
  return left;
}
