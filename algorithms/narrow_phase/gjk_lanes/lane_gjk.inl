// Part of gjk-lanes: the loops of lane_gjk.h. lane_gjk.cpp includes this file once for each level
// of vector instructions, inside that level's namespace.
#include "algorithms/narrow_phase/gjk_lanes/lane_step.inl"

// The bodies of one pair per lane, and the state of its GJK search. Lengths are in the unit of each
// pair, relative to the centre of a.
template <class Scalar>
struct Walkers {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  static constexpr std::size_t width = Lanes::width;

  // The loaded data, one quad per lane: numbers of the poses (see load_pair), sizes, and pointers
  // to vertices.
  Quad<Scalar> poses[6][width], sizes[width], extents_a[width], extents_b[width];
  const hull_scan::VertexBlock<Scalar>*corners_a[width], *corners_b[width];
  std::uint32_t blocks_a[width], blocks_b[width];
  double unit[width];  // metres
  std::uint32_t place[width];

  // Vertices, for b with its centre; or the half edges of a box or a segment; or the columns of a
  // matrix if vertices are scanned.
  Vectors<Scalar> a[most_turned_vertices], b[most_turned_vertices];
  Vectors<Scalar> centre_b;
  Real radius_a, radius_b;

  LaneSimplex<Scalar> simplex;
  Vectors<Scalar> way;  // from the origin through the nearest point, of any length; the search
                        // direction is opposite
  Real length;          // of `way`
  Real along;           // the nearest point's component along `way`, times its length
  Real plane;           // the newest support plane's, likewise
  Real count;           // number of iterations
  // The tetrahedron of lanes that have the origin inside, and of `piercing` lanes, which search for
  // a point behind the face that they came through.
  Tetrahedron<Scalar> around;

  // Lanes that iterate, and those that have ended, by their end; as bits.
  unsigned active = 0, apart = 0, inside = 0, shallow = 0, doubtful = 0;
  unsigned piercing = 0;  // a part of `active`

  unsigned ended() const { return apart | inside | shallow | doubtful; }
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void write_walked(bool apart, std::int32_t iterations,
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
                                                    Walkers<Scalar>& walkers, unsigned lanes) {
  if (goal.starts == nullptr) {
    walkers.inside |= lanes;
  } else if (lanes != 0) {
    note_starts<Scalar>(walkers, lanes, *goal.starts);
  }
}

// Takes one step of every active lane.
template <class Scalar, bool points, bool scans>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void walk_on(const LaneGoal<Scalar>& goal,
                                                 Walkers<Scalar>& walkers) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const Real zero = Lanes::broadcast(0), margin = Lanes::broadcast(lane_rounding<Scalar>);
  const Vectors<Scalar> way = walkers.way;
  const Corner<Scalar> corner = find_corner<Scalar, scans>(goal, walkers, way, walkers.active);

  const Real radius = walkers.radius_a + walkers.radius_b;
  const Real plane = dot<Scalar>(way, corner.point);
  unsigned stop = Lanes::bits(Lanes::less((radius + margin) * walkers.length, plane));
  unsigned shallow = 0;
  if constexpr (points) {
    const Real open = walkers.along - plane, tolerance = goal.tolerance * walkers.length;
    if (goal.starts == nullptr) {
      stop &= ~Lanes::bits(Lanes::less(tolerance, open)) & ~walkers.piercing;
    } else if (goal.round) {
      // The depth of the radii in each other is known here.
      shallow =
          walkers.active & ~walkers.piercing &
          Lanes::bits(both(Lanes::less(open, tolerance),
                           Lanes::less(walkers.along, (radius - 2 * margin) * walkers.length)));
    }
  }
  const auto active = Lanes::mask(walkers.active);
  walkers.plane = Lanes::select(active, plane, walkers.plane);
  walkers.count = walkers.count + Lanes::select(active, Lanes::broadcast(1), zero);
  stop &= walkers.active;
  walkers.apart |= stop;
  walkers.shallow |= shallow;
  walkers.active &= ~(stop | shallow);
  const unsigned pierced = walkers.piercing & walkers.active;
  walkers.piercing = 0;
  if (pierced != 0) {
    const unsigned between =
        surely_between<Scalar>(walkers.around, corner.point, goal.corner_error, pierced);
    end_inside<Scalar>(goal, walkers, between);
    walkers.doubtful |= pierced & ~between;
    walkers.active &= ~pierced;
  }
  if (walkers.active == 0) return;

  const auto on = Lanes::mask(walkers.active);
  LaneStep<Scalar> step;
  const bool solid = Lanes::bits(both(on, walkers.simplex.has_d)) != 0;
  if (solid) {
    step = take_step<Scalar, points, true>(walkers.simplex, corner, on, goal.corner_error,
                                           walkers.around);
  } else {
    step = take_step<Scalar, points, false>(walkers.simplex, corner, on, goal.corner_error,
                                            walkers.around);
  }
  const Real square = dot<Scalar>(step.way, step.way);
  Real length = Lanes::sqrt(square);
  Real along = dot<Scalar>(step.way, corner.point);
  // This form of the comparison ends the search for NaN.
  const auto nearer = Lanes::less(along * walkers.length, walkers.along * length);
  const unsigned in_time =
      Lanes::bits(Lanes::less(walkers.count, Lanes::broadcast(goal.most_iterations)));
  const unsigned going =
      in_time & step.found &
      Lanes::bits(both(nearer, Lanes::less(Lanes::broadcast(shortest_square<Scalar>), square)));
  walkers.way = select<Scalar>(on, step.way, way);
  // The origin is too near the face that the search came through: a point behind that face decides.
  walkers.piercing = walkers.active & step.unsure & in_time;
  if (walkers.piercing != 0) {
    const auto turns = Lanes::mask(walkers.piercing);
    walkers.way = select<Scalar>(turns, {-way.x, -way.y, -way.z}, walkers.way);
    length = Lanes::select(turns, walkers.length, length);
    along = Lanes::select(turns, walkers.along, along);
  }
  walkers.length = Lanes::select(on, length, walkers.length);
  walkers.along = Lanes::select(on, along, walkers.along);
  const unsigned inside = walkers.active & step.inside;
  shallow = 0;
  if (goal.round && goal.starts == nullptr) {
    shallow = walkers.active & step.found & ~inside &
              Lanes::bits(Lanes::less(along, (radius - 2 * margin) * length));
  }
  end_inside<Scalar>(goal, walkers, inside);
  walkers.shallow |= shallow;
  const unsigned stays = (going | walkers.piercing) & ~inside & ~shallow;
  walkers.doubtful |= walkers.active & ~stays & ~inside & ~shallow;
  walkers.active &= stays;
}

template <class Scalar, bool points, bool scans>
TOUCHSTONE_TARGET std::size_t walk_lanes(const PairTable<Scalar>& table,
                                         const LaneGoal<Scalar>& goal,
                                         std::span<const std::uint32_t> queue, std::size_t left) {
  constexpr std::size_t width = RealLanes<Scalar>::width;
  // Lanes without a pair need valid numbers too.
  Walkers<Scalar> walkers{};
  std::ranges::fill(walkers.corners_a, goal.some_vertices);
  std::ranges::fill(walkers.corners_b, goal.some_vertices);
  std::size_t next = 0;
  while (next < queue.size() || walkers.active != 0) {
    left = start_lanes<Scalar, scans>(table, goal, queue, next, walkers, left);
    // Lanes are filled together, which costs about the same for a few as for all.
    const int enough = next < queue.size() ? static_cast<int>(width * 3 / 8) : 1;
    do {
      walk_on<Scalar, points, scans>(goal, walkers);
    } while (std::popcount(walkers.active) >= enough && walkers.active != 0);
    left = answer_lanes<Scalar, points>(table, goal, walkers, left);
  }
  return left;
}

// Computes depths for one part of the queue after the other, so that the stored tetrahedra stay in
// the cache.
template <class Scalar, bool scans>
TOUCHSTONE_TARGET std::size_t find_depths(const PairTable<Scalar>& table,
                                          const LaneGoal<Scalar>& goal,
                                          std::span<const std::uint32_t> queue, std::size_t left) {
  while (!queue.empty()) {
    const std::size_t count = std::min(queue.size(), goal.starts->all.size());
    goal.starts->count = 0;
    left = walk_lanes<Scalar, true, scans>(table, goal, queue.first(count), left);
    if (goal.starts->count != 0) left = expand_lanes<Scalar, scans>(table, goal, left);
    queue = queue.subspan(count);
  }
  return left;
}

template <class Scalar, bool scans>
TOUCHSTONE_TARGET std::size_t walk_and_answer(const PairTable<Scalar>& table,
                                              const LaneGoal<Scalar>& goal,
                                              std::span<const std::uint32_t> queue,
                                              std::size_t left) {
  if (goal.starts != nullptr) return find_depths<Scalar, scans>(table, goal, queue, left);
  return goal.distances ? walk_lanes<Scalar, true, scans>(table, goal, queue, left)
                        : walk_lanes<Scalar, false, scans>(table, goal, queue, left);
}

template <class Scalar>
TOUCHSTONE_TARGET std::size_t walk_all(const PairTable<Scalar>& table, const LaneGoal<Scalar>& goal,
                                       std::span<const std::uint32_t> queue, std::size_t left) {
  return goal.scans_a || goal.scans_b ? walk_and_answer<Scalar, true>(table, goal, queue, left)
                                      : walk_and_answer<Scalar, false>(table, goal, queue, left);
}
