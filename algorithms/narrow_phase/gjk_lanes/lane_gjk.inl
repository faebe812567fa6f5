// Part of gjk-lanes: the loops of lane_gjk.h. lane_gjk.cpp includes this file once for each level
// of vector instructions, inside that level's namespace.
#include "algorithms/narrow_phase/gjk_lanes/lane_step.inl"

// The bodies of one pair per lane, and the state of its GJK search. Lengths are in the unit of each
// pair, relative to the centre of a.
template <class Scalar>
struct LaneState {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  static constexpr std::size_t width = Lanes::width;

  // The loaded data, one quad per lane: numbers of the poses (see load_pair), sizes, and pointers
  // to vertices.
  Quad<Scalar> poses[6][width], sizes[width], directions[width], extents_a[width], extents_b[width];
  const hull_scan::VertexBlock<Scalar>*corners_a[width], *corners_b[width];
  hull_scan::ScannedHull<Scalar> hulls_a[width], hulls_b[width];
  double unit[width];  // metres
  std::uint32_t place[width];

  // Vertices, for b with its centre; or the half edges of a box or a segment; or the columns of a
  // matrix if vertices are scanned.
  Vector3<Scalar> a[most_turned_vertices], b[most_turned_vertices];
  Vector3<Scalar> centre_b;
  Vector radius_a, radius_b;

  LaneSimplex<Scalar> simplex;
  Vector3<Scalar> search;  // from the origin through the nearest point, of any length; the search
                           // direction is opposite
  Vector length;           // of `search`
  Vector along;            // the nearest point's component along `search`, times its length
  Vector plane;            // the newest support plane's, likewise
  Vector count;            // number of iterations
  // The tetrahedron of lanes that have the origin inside, and of `piercing` lanes, which search for
  // a point behind the face that they came through.
  Tetrahedron<Scalar> around;

  // Lanes that iterate, and those that have ended, by their end; as bits.
  unsigned active = 0, apart = 0, inside = 0, shallow = 0, doubtful = 0;
  unsigned piercing = 0;  // a part of `active`

  unsigned ended() const { return apart | inside | shallow | doubtful; }
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void write_verdict(bool apart, std::int32_t iterations,
                                                       Outcome& outcome) {
  outcome.answer = apart ? Answer::separated : Answer::overlapping;
  outcome.status = Status::ok;
  outcome.iterations = outcome.support_calls = iterations;
}

#include "algorithms/narrow_phase/gjk_lanes/lane_answer.inl"
#include "algorithms/narrow_phase/gjk_lanes/lane_depths.inl"

// Ends lanes whose bodies are known to overlap.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void end_inside(const LaneGoal<Scalar>& goal,
                                                    LaneState<Scalar>& state, unsigned lanes) {
  if (goal.starts == nullptr) {
    state.inside |= lanes;
  } else if (lanes != 0) {
    note_starts<Scalar>(state, lanes, *goal.starts);
  }
}

// Takes one step of every active lane.
template <class Scalar, bool points>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void iterate(const LaneGoal<Scalar>& goal,
                                                 LaneState<Scalar>& state) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), margin = Lanes::broadcast(lane_rounding<Scalar>);
  const Vector3<Scalar> search = state.search;
  const Corner<Scalar> corner =
      find_corner<Scalar>(goal, state, search, state.length, state.active);

  const Vector radius = state.radius_a + state.radius_b;
  const Vector plane = dot<Scalar>(search, corner.point);
  unsigned stop = Lanes::to_bits(Lanes::less((radius + margin) * state.length, plane));
  unsigned shallow = 0;
  if constexpr (points) {
    const Vector open = state.along - plane, tolerance = goal.tolerance * state.length;
    if (goal.starts == nullptr) {
      stop &= ~Lanes::to_bits(Lanes::less(tolerance, open)) & ~state.piercing;
    } else if (goal.round) {
      // The depth of the radii in each other is known here.
      shallow =
          state.active & ~state.piercing &
          Lanes::to_bits(both(Lanes::less(open, tolerance),
                              Lanes::less(state.along, (radius - 2 * margin) * state.length)));
    }
  }
  const auto active = Lanes::from_bits(state.active);
  state.plane = Lanes::select(active, plane, state.plane);
  state.count = state.count + Lanes::select(active, Lanes::broadcast(1), zero);
  stop &= state.active;
  state.apart |= stop;
  state.shallow |= shallow;
  state.active &= ~(stop | shallow);
  const unsigned pierced = state.piercing & state.active;
  state.piercing = 0;
  if (pierced != 0) {
    const unsigned between =
        surely_between<Scalar>(state.around, corner.point, goal.corner_error, pierced);
    end_inside<Scalar>(goal, state, between);
    state.doubtful |= pierced & ~between;
    state.active &= ~pierced;
  }
  if (state.active == 0) return;

  const auto on = Lanes::from_bits(state.active);
  LaneStep<Scalar> step;
  const bool solid = Lanes::to_bits(both(on, state.simplex.has_d)) != 0;
  if (solid) {
    step =
        take_step<Scalar, points, true>(state.simplex, corner, on, goal.corner_error, state.around);
  } else {
    step = take_step<Scalar, points, false>(state.simplex, corner, on, goal.corner_error,
                                            state.around);
  }
  const Vector square = dot<Scalar>(step.search, step.search);
  Vector length = Lanes::sqrt(square);
  Vector along = dot<Scalar>(step.search, corner.point);
  // This form of the comparison ends the search for NaN.
  const auto nearer = Lanes::less(along * state.length, state.along * length);
  const unsigned in_time =
      Lanes::to_bits(Lanes::less(state.count, Lanes::broadcast(goal.most_iterations)));
  const unsigned going =
      in_time & step.found &
      Lanes::to_bits(both(nearer, Lanes::less(Lanes::broadcast(shortest_square<Scalar>), square)));
  state.search = select<Scalar>(on, step.search, search);
  // The origin is too near the face that the search came through: a point behind that face decides.
  state.piercing = state.active & step.unsure & in_time;
  if (state.piercing != 0) {
    const auto turns = Lanes::from_bits(state.piercing);
    state.search = select<Scalar>(turns, {-search.x, -search.y, -search.z}, state.search);
    length = Lanes::select(turns, state.length, length);
    along = Lanes::select(turns, state.along, along);
  }
  state.length = Lanes::select(on, length, state.length);
  state.along = Lanes::select(on, along, state.along);
  const unsigned inside = state.active & step.inside;
  shallow = 0;
  if (goal.round && goal.starts == nullptr) {
    shallow = state.active & step.found & ~inside &
              Lanes::to_bits(Lanes::less(along, (radius - 2 * margin) * length));
  }
  end_inside<Scalar>(goal, state, inside);
  state.shallow |= shallow;
  const unsigned stays = (going | state.piercing) & ~inside & ~shallow;
  state.doubtful |= state.active & ~stays & ~inside & ~shallow;
  state.active &= stays;
}

template <class Scalar, bool points>
TOUCHSTONE_TARGET std::size_t run_lanes(const PairTable<Scalar>& table,
                                        const LaneGoal<Scalar>& goal,
                                        std::span<const std::uint32_t> queue, std::size_t left) {
  constexpr std::size_t width = Simd<Scalar>::width;
  // Lanes without a pair need valid numbers too.
  LaneState<Scalar> state{};
  std::ranges::fill(state.corners_a, goal.some_vertices);
  std::ranges::fill(state.corners_b, goal.some_vertices);
  std::size_t next = 0;
  while (next < queue.size() || state.active != 0) {
    left = start_lanes<Scalar>(table, goal, queue, next, state, left);
    // Lanes are filled together, which costs about the same for a few as for all.
    const int enough = next < queue.size() ? static_cast<int>(width * 3 / 8) : 1;
    do {
      iterate<Scalar, points>(goal, state);
    } while (std::popcount(state.active) >= enough && state.active != 0);
    left = answer_lanes<Scalar, points>(table, goal, state, left);
  }
  return left;
}

// Computes depths for one part of the queue after the other, so that the stored tetrahedra stay in
// the cache.
template <class Scalar>
TOUCHSTONE_TARGET std::size_t find_depths(const PairTable<Scalar>& table,
                                          const LaneGoal<Scalar>& goal,
                                          std::span<const std::uint32_t> queue, std::size_t left) {
  while (!queue.empty()) {
    const std::size_t count = std::min(queue.size(), goal.starts->all.size());
    goal.starts->count = 0;
    left = run_lanes<Scalar, true>(table, goal, queue.first(count), left);
    if (goal.starts->count != 0) left = expand_lanes<Scalar>(table, goal, left);
    queue = queue.subspan(count);
  }
  return left;
}

template <class Scalar>
TOUCHSTONE_TARGET std::size_t run_all_lanes(const PairTable<Scalar>& table,
                                            const LaneGoal<Scalar>& goal,
                                            std::span<const std::uint32_t> queue,
                                            std::size_t left) {
  if (goal.starts != nullptr) return find_depths<Scalar>(table, goal, queue, left);
  return goal.distances ? run_lanes<Scalar, true>(table, goal, queue, left)
                        : run_lanes<Scalar, false>(table, goal, queue, left);
}
