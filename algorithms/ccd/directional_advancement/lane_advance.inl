// Part of directional-advancement: its loops. directional_advancement.cpp includes this file once for
// each level of vector instructions, inside that level's namespace.
#include "algorithms/kernels/simd/vector3.inl"

using LaneVector = Simd<double>::Vector;
using LaneMask = Simd<double>::Mask;
using LanePoint = Vector3<double>;

// The nearest points so far: what leads from the first feature's to the second's, and a direction
// like it, of any length, that is square to the parts on which they lie.
struct Nearest {
  LanePoint between, direction;
  LaneVector square;
};

// Takes other points in the lanes where they are nearer. `along` is the edge on which one lies: the
// direction loses what the rounding of `between` has put along it.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void take_nearer(Nearest& nearest, const LanePoint& between,
                                                     const LanePoint& along, LaneVector inverse) {
  using Lanes = Simd<double>;
  const LaneVector square = dot<double>(between, between);
  const LaneMask nearer = Lanes::less(square, nearest.square);
  nearest.square = Lanes::min(square, nearest.square);
  nearest.between = select<double>(nearer, between, nearest.between);
  const LaneVector part = -dot<double>(between, along) * inverse;
  nearest.direction =
      select<double>(nearer, moved<double>(between, part, along), nearest.direction);
}

// The inverse of a square; zero if there is hardly any.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LaneVector inverse_of(LaneVector square) {
  using Lanes = Simd<double>;
  const LaneVector zero = Lanes::broadcast(0), least = Lanes::broadcast(1e-200);
  return Lanes::select(Lanes::less(least, square), Lanes::broadcast(1) / Lanes::max(square, least),
                       zero);
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE LaneVector within_unit(LaneVector x) {
  using Lanes = Simd<double>;
  return Lanes::min(Lanes::max(x, Lanes::broadcast(0)), Lanes::broadcast(1));
}

// From the point p to a segment that begins at `from`. In lanes where `inside` is the segment's
// inside the direction is made square to it; at its ends the direction is the connection itself.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void try_segment(Nearest& nearest, const LanePoint& p,
                                                     const LanePoint& from, const LanePoint& edge,
                                                     LaneVector inverse, double sign) {
  using Lanes = Simd<double>;
  const LanePoint w = difference<double>(from, p);
  const LaneVector place = -dot<double>(w, edge) * inverse;
  const LaneVector on = within_unit(place);
  const LaneMask inside = both(Lanes::less_equal(on, place), Lanes::less_equal(place, on));
  const LanePoint between = scaled<double>(Lanes::broadcast(sign), moved<double>(w, on, edge));
  take_nearer(nearest, between, edge, Lanes::select(inside, inverse, Lanes::broadcast(0)));
}

// Where both features' insides are nearest, the plane's normal is the direction.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void try_plane(Nearest& nearest, LaneMask inside,
                                                   const LanePoint& between,
                                                   const LanePoint& normal, LaneVector height) {
  using Lanes = Simd<double>;
  const LaneVector zero = Lanes::broadcast(0);
  const LaneMask up = Lanes::less(zero, height);
  const LanePoint outward =
      select<double>(up, normal, scaled<double>(Lanes::broadcast(-1), normal));
  nearest.between = select<double>(inside, between, nearest.between);
  nearest.direction = select<double>(inside, outward, nearest.direction);
}

// The triangle a, b, c from the origin.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Nearest nearest_of_face(const LanePoint& a, const LanePoint& b,
                                                            const LanePoint& c) {
  using Lanes = Simd<double>;
  const LaneVector zero = Lanes::broadcast(0);
  const LanePoint origin{zero, zero, zero};
  const LanePoint ab = difference<double>(b, a), bc = difference<double>(c, b),
                  ca = difference<double>(a, c);
  Nearest nearest{origin, origin, Lanes::broadcast(std::numeric_limits<double>::infinity())};
  try_segment(nearest, origin, a, ab, inverse_of(dot<double>(ab, ab)), 1);
  try_segment(nearest, origin, b, bc, inverse_of(dot<double>(bc, bc)), 1);
  try_segment(nearest, origin, c, ca, inverse_of(dot<double>(ca, ca)), 1);
  const LanePoint normal = cross<double>(bc, ca);
  const LaneVector wa = dot<double>(normal, cross<double>(b, c)),
                   wb = dot<double>(normal, cross<double>(c, a)),
                   wc = dot<double>(normal, cross<double>(a, b));
  const LaneVector sum = wa + wb + wc, least = Lanes::min(wa, Lanes::min(wb, wc));
  const LaneMask inside =
      both(Lanes::less_equal(zero, least), Lanes::less(Lanes::broadcast(1e-200), sum));
  const LaneVector inverse = inverse_of(sum);
  LanePoint between = scaled<double>(wa * inverse, a);
  between = moved<double>(between, wb * inverse, b);
  between = moved<double>(between, wc * inverse, c);
  try_plane(nearest, inside, between, normal, dot<double>(normal, a));
  return nearest;
}

// The edge from the origin to b, and the edge from c to d.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Nearest nearest_of_edges(const LanePoint& b, const LanePoint& c,
                                                             const LanePoint& d) {
  using Lanes = Simd<double>;
  const LaneVector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const LanePoint origin{zero, zero, zero};
  const LanePoint cd = difference<double>(d, c);
  const LaneVector inverse_b = inverse_of(dot<double>(b, b)),
                   inverse_cd = inverse_of(dot<double>(cd, cd));
  Nearest nearest{origin, origin, Lanes::broadcast(std::numeric_limits<double>::infinity())};
  try_segment(nearest, origin, c, cd, inverse_cd, 1);
  try_segment(nearest, b, c, cd, inverse_cd, 1);
  try_segment(nearest, c, origin, b, inverse_b, -1);
  try_segment(nearest, d, origin, b, inverse_b, -1);
  const LanePoint normal = cross<double>(b, cd);
  const LaneVector square = dot<double>(normal, normal), inverse = inverse_of(square);
  const LaneVector s = dot<double>(cross<double>(c, cd), normal) * inverse,
                   t = dot<double>(cross<double>(c, b), normal) * inverse;
  const LaneMask inside = both(
      both(Lanes::less_equal(zero, Lanes::min(s, t)), Lanes::less_equal(Lanes::max(s, t), one)),
      Lanes::less(Lanes::broadcast(1e-200), square));
  const LanePoint between = moved<double>(moved<double>(c, t, cd), -s, b);
  try_plane(nearest, inside, between, normal, dot<double>(normal, c));
  return nearest;
}

// The times at which all lines from `start` at 0 to `end` at 1 are at least the threshold.
struct FreeTimes {
  LaneVector begin, end;
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void cut(FreeTimes& times, LaneVector start, LaneVector end,
                                             LaneVector threshold) {
  using Lanes = Simd<double>;
  const LaneVector never = Lanes::broadcast(2);
  const LaneVector crossing = (start - threshold) / (start - end);
  // Written so that NaN is never free.
  const LaneMask from_start = Lanes::less_equal(threshold, start);
  const LaneMask to_end = Lanes::less_equal(threshold, end);
  const LaneVector stop = Lanes::select(to_end, never, crossing);
  const LaneVector go = Lanes::select(to_end, crossing, never);
  times.end = Lanes::select(from_start, Lanes::min(stop, times.end), times.end);
  times.begin = Lanes::select(from_start, times.begin, Lanes::max(go, times.begin));
}

struct LaneGroup {
  static constexpr std::size_t width = Simd<double>::width;
  alignas(64) double edges[18][width];
  alignas(64) double threshold[width], near[width], time[width];
  std::size_t query[width];
  std::int32_t steps[width];
  unsigned active = 0;
};

struct StepEnds {
  unsigned hit, miss, stuck;
};

template <bool is_face>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE StepEnds step(LaneGroup& group) {
  using Lanes = Simd<double>;
  const LaneVector time = Lanes::load(group.time);
  LanePoint start[3], end[3], now[3];
  for (std::size_t i = 0; i < 3; ++i) {
    start[i] = {Lanes::load(group.edges[3 * i]), Lanes::load(group.edges[3 * i + 1]),
                Lanes::load(group.edges[3 * i + 2])};
    end[i] = {Lanes::load(group.edges[3 * i + 9]), Lanes::load(group.edges[3 * i + 10]),
              Lanes::load(group.edges[3 * i + 11])};
    now[i] = moved<double>(start[i], time, difference<double>(end[i], start[i]));
  }
  Nearest nearest;
  if constexpr (is_face) {
    nearest = nearest_of_face(now[0], now[1], now[2]);
  } else {
    nearest = nearest_of_edges(now[0], now[1], now[2]);
  }
  const LaneVector length = Lanes::sqrt(dot<double>(nearest.between, nearest.between));
  const LaneVector inverse =
      Lanes::broadcast(1) /
      Lanes::max(Lanes::sqrt(dot<double>(nearest.direction, nearest.direction)),
                 Lanes::broadcast(1e-200));
  const LanePoint direction = scaled<double>(inverse, nearest.direction);
  const LaneVector threshold = Lanes::load(group.threshold);
  LaneVector a[3], b[3];
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = dot<double>(direction, start[i]);
    b[i] = dot<double>(direction, end[i]);
  }
  FreeTimes times{Lanes::broadcast(0), Lanes::broadcast(2)};
  if constexpr (is_face) {
    for (std::size_t i = 0; i < 3; ++i) cut(times, a[i], b[i], threshold);
  } else {
    for (std::size_t i = 1; i < 3; ++i) {
      cut(times, a[i], b[i], threshold);
      cut(times, a[i] - a[0], b[i] - b[0], threshold);
    }
  }
  const LaneMask hit = Lanes::less_equal(length, Lanes::load(group.near));
  // Written so that a lane with NaN is stuck.
  const LaneMask moves = both(Lanes::less_equal(times.begin, time), Lanes::less(time, times.end));
  const LaneMask ends = both(moves, Lanes::less_equal(Lanes::broadcast(1), times.end));
  Lanes::store(group.time, Lanes::select(without(moves, hit), times.end, time));
  StepEnds bits{Lanes::to_bits(hit) & group.active, 0, 0};
  bits.miss = Lanes::to_bits(ends) & group.active & ~bits.hit;
  bits.stuck = ~Lanes::to_bits(moves) & group.active & ~bits.hit;
  return bits;
}

// The next queries, one after another.
struct LaneFeed {
  const LaneBatch& batch;
  std::size_t next = 0;
};

// Three coordinates, and a fourth that is 0.
using Row = simd::Quad<double>;
using Rows = QuadLanes<double>;

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Row row_of(const Vec3d& v) { return Row{v[0], v[1], v[2], 0}; }

// A query as ScaledEdges has it, with a vertex in each row.
struct LaneQuery {
  Row edges[6];
  // In the unit of the edges:
  double threshold;  // a gap of this length along a direction is free of contact
  double near;       // witness points nearer than this are a hit
};

// Returns true if along one of the axes all vertices of the first feature are further than the threshold from all of
// the second, on the same side at time 0 and at time 1. An axis has no rounding of its own, so that the threshold
// has room.
template <bool is_face>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool an_axis_parts(const LaneQuery& lane) {
  const Row zero = {};
  // The second feature's extent from the first's.
  Row least = Rows::broadcast(4), greatest = Rows::broadcast(-4);
  for (const Row* at : {lane.edges, lane.edges + 3}) {
    Row low = Rows::min(at[1], at[2]), high = Rows::max(at[1], at[2]);
    if constexpr (is_face) {
      low = Rows::min(low, at[0]);
      high = Rows::max(high, at[0]);
    } else {
      low = low - Rows::max(at[0], zero);
      high = high - Rows::min(at[0], zero);
    }
    least = Rows::min(least, low);
    greatest = Rows::max(greatest, high);
  }
  // The fourth is 0, and the threshold is greater.
  const Row apart = Rows::max(least, zero - greatest);
  return Rows::reduce_max(apart) >= lane.threshold;
}

// Returns false if the query has its outcome: the edges overflow, or one of the axes parts the features at all
// times.
template <bool is_face>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool load_lane(const CcdQuery& query, const LaneBatch& batch,
                                                   LaneQuery& lane) {
  const Row first_start = row_of(query.start[0]), first_end = row_of(query.end[0]);
  Row reaches = {};
  for (std::size_t i = 0; i < 3; ++i) {
    lane.edges[i] = row_of(query.start[i + 1]) - first_start;
    lane.edges[i + 3] = row_of(query.end[i + 1]) - first_end;
    reaches = Rows::max(reaches, Rows::max_abs(lane.edges[i], lane.edges[i + 3]));
  }
  const double scale = scale_of_edges(Rows::reduce_max(reaches));
  if (scale == 0) {
    decide(query, batch, CcdAnswer::unknown, Status::degenerate, 0);
    return false;
  }
  for (Row& edge : lane.edges) edge = edge * Rows::broadcast(scale);
  const double separation = batch.separation * scale, tolerance = batch.tolerance * scale;
  constexpr double relative_error = 8 * 0x1p-53;
  lane.threshold = separation * (1 + relative_error) + std::max(0.25 * tolerance, scaled_error);
  lane.near = (separation + tolerance) * (1 - relative_error) - scaled_error;
  if (!an_axis_parts<is_face>(lane)) return true;
  decide(query, batch, CcdAnswer::miss, Status::ok, 1);
  return false;
}

template <bool is_face>
TOUCHSTONE_TARGET inline void refill(LaneGroup& group, std::size_t lane, LaneFeed& feed) {
  LaneQuery query;
  for (; feed.next < feed.batch.queries.size(); ++feed.next) {
    if (!load_lane<is_face>(feed.batch.queries[feed.next], feed.batch, query)) continue;
    double at[4];
    for (std::size_t i = 0; i < 6; ++i) {
      Rows::store(at, query.edges[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) group.edges[3 * i + axis][lane] = at[axis];
    }
    group.threshold[lane] = query.threshold;
    group.near[lane] = query.near;
    group.time[lane] = 0;
    group.steps[lane] = 0;
    group.query[lane] = feed.next++;
    group.active |= 1u << lane;
    return;
  }
  group.active &= ~(1u << lane);
}

template <bool is_face>
TOUCHSTONE_TARGET inline void advance_group(LaneGroup& group, LaneFeed& feed) {
  const StepEnds ends = step<is_face>(group);
  unsigned done = ends.hit | ends.miss | ends.stuck;
  for (std::size_t lane = 0; lane < LaneGroup::width; ++lane) {
    const bool is_spent = ++group.steps[lane] >= feed.batch.most_steps;
    if (is_spent) done |= 1u << lane & group.active;
  }
  for (; done != 0; done &= done - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(done));
    CcdOutcome& outcome = feed.batch.outcomes[group.query[lane]];
    outcome = {};
    outcome.iterations = group.steps[lane];
    outcome.status = Status::ok;
    outcome.free_before = group.time[lane];
    if (ends.hit >> lane & 1) {
      outcome.answer = CcdAnswer::hit;
      outcome.toi = outcome.contact_by = group.time[lane];
    } else if (ends.miss >> lane & 1) {
      outcome.answer = CcdAnswer::miss;
      outcome.free_before = 1;
    } else {
      outcome.status = Status::not_converged;
    }
    refill<is_face>(group, lane, feed);
  }
}

// Two groups in turn, so that one computes while the other waits for its divisions.
template <bool is_face>
TOUCHSTONE_TARGET inline void advance_all(const LaneBatch& batch) {
  LaneFeed feed{batch};
  LaneGroup groups[2] = {};
  for (LaneGroup& group : groups) {
    for (std::size_t lane = 0; lane < LaneGroup::width; ++lane) refill<is_face>(group, lane, feed);
  }
  while ((groups[0].active | groups[1].active) != 0) {
    for (LaneGroup& group : groups) {
      if (group.active != 0) advance_group<is_face>(group, feed);
    }
  }
}
