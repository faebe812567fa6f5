// Part of mpr-ray-cast-lanes, included by portal_lanes.cpp for each level of vector instructions: the steps of searches.
#include "algorithms/cast/mpr_ray_cast/portal_state.inl"

// A portal in registers: the corners relative to the path, and their indices.
struct LanePortal {
  Vector3<double> places[3];
  typename Simd<double>::Vector corners_a[3], corners_b[3];
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void set_corner(LanePortal& portal, std::size_t k,
                                                    typename Simd<double>::Mask mask,
                                                    const Vector3<double>& place,
                                                    typename Simd<double>::Vector corner_a,
                                                    typename Simd<double>::Vector corner_b) {
  using Lanes = Simd<double>;
  portal.places[k] = select<double>(mask, place, portal.places[k]);
  portal.corners_a[k] = Lanes::select(mask, corner_a, portal.corners_a[k]);
  portal.corners_b[k] = Lanes::select(mask, corner_b, portal.corners_b[k]);
}

// Copies corners to the places that the mask's lanes give them.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void permute(LanePortal& portal,
                                                 typename Simd<double>::Mask mask,
                                                 const LanePortal& from, std::size_t first,
                                                 std::size_t second, std::size_t third) {
  const std::size_t order[3] = {first, second, third};
  for (std::size_t k = 0; k < 3; ++k) {
    set_corner(portal, k, mask, from.places[order[k]], from.corners_a[order[k]],
               from.corners_b[order[k]]);
  }
}

// Positive if the line passes on the left of the way from p to q, seen against the path.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<double>::Vector side(
    const Vector3<double>& p, const Vector3<double>& q, const Vector3<double>& along) {
  return dot<double>(cross<double>(q, p), along);
}

// The new point of each lane.
struct NewCorners {
  Vector3<double> place;
  typename Simd<double>::Vector corner_a, corner_b;
};

// The lanes whose support planes part the bodies to the end. In the others time grows to where they close. As in
// part_by_plane, but for the direction's length, which has one more rounding: 8 u of the 15 u that
// MovingPair::rounding has to spare.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned take_corners(PortalLanes& lanes, NewCorners& found) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  const Vector one = Lanes::broadcast(1), rounding = Lanes::broadcast(MovingPair::rounding);
  const Vector3<double> direction = three_rows(lanes.direction);
  const Vector3<double> start = three_rows(lanes.start), velocity = three_rows(lanes.velocity);
  const FurthestVertices a =
      furthest_vertices(lanes.shapes_a, lanes.matrix_a, direction, lanes.active);
  const FurthestVertices b = furthest_vertices(
      lanes.shapes_b, lanes.matrix_b, {-direction.x, -direction.y, -direction.z}, lanes.active);
  found = {difference<double>(difference<double>(a.of, b.of), start), a.index, b.index};

  const Vector time = Lanes::load(lanes.time);
  const Vector3<double> offset = moved<double>(start, time, velocity);
  const Vector3<double> apart = {a.of.x - (b.of.x + offset.x), a.of.y - (b.of.y + offset.y),
                                 a.of.z - (b.of.z + offset.z)};
  const Vector gap = -dot<double>(direction, apart), speed = dot<double>(direction, velocity);
  const Mask open = both(Lanes::less(rounding, gap), Lanes::from_bits(lanes.active));
  const Mask miss = both(open, Lanes::less(rounding, gap + (one - time) * speed));
  // The order keeps NaN, which then is not later.
  const Vector closes = Lanes::min(one, time + (gap - rounding) / -speed);
  const Mask grows = both(without(open, miss), Lanes::less(time, closes));
  Lanes::store(lanes.time, Lanes::select(grows, closes, time));
  store_three(select<double>(grows, direction, three_rows(lanes.plane)), lanes.plane);
  return Lanes::to_bits(miss);
}

// What a step decides: sets of lanes whose search ends.
struct LaneEnds {
  unsigned closed = 0, open = 0;
};

// Lanes that look for a portal: each puts its new corner in place, and closes a portal or turns to the edge that
// the line is outside of. Later corners replace the third.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void discover(PortalLanes& lanes, unsigned searching,
                                                  const NewCorners& found, LanePortal& portal,
                                                  LaneEnds& ends) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const Vector3<double> along = three_rows(lanes.along), across = three_rows(lanes.across);
  // Where the corner is not beyond the line, the next direction is straight across.
  const unsigned beyond = lanes.first | lanes.straight |
                          Lanes::to_bits(Lanes::less(zero, dot<double>(found.place, across)));
  const unsigned again = searching & ~beyond;
  searching &= beyond;
  const unsigned firsts = lanes.first & searching, laters = lanes.later & searching;
  const auto place = [&](std::size_t k, unsigned bits) TOUCHSTONE_TARGET {
    set_corner(portal, k, Lanes::from_bits(bits), found.place, found.corner_a, found.corner_b);
  };
  place(0, firsts);
  place(1, lanes.second & searching);
  place(2, laters);

  const Vector3<double>* const p = portal.places;
  const Vector edges[3] = {side(p[1], p[2], along), side(p[2], p[0], along),
                           side(p[0], p[1], along)};
  const Vector area = edges[0] + edges[1] + edges[2];
  const Mask backward = Lanes::less(area, zero);
  const unsigned has_area = Lanes::to_bits(either(backward, Lanes::less(zero, area)));
  const Vector sense = Lanes::select(backward, -one, one);
  Vector least = sense * edges[0];
  const Vector second = sense * edges[1], third = sense * edges[2];
  const Mask is_second = Lanes::less(second, least);
  least = Lanes::select(is_second, second, least);
  const Mask is_third = Lanes::less(third, least);
  least = Lanes::select(is_third, third, least);
  ends.open |= laters & ~has_area;
  const unsigned closes = laters & has_area & Lanes::to_bits(Lanes::less_equal(zero, least));
  const unsigned turns = laters & has_area & ~closes;
  const LanePortal before = portal;
  permute(portal, both(Lanes::from_bits(closes), backward), before, 0, 2, 1);
  const unsigned drops_third = Lanes::to_bits(is_third),
                 drops_second = Lanes::to_bits(is_second) & ~drops_third;
  permute(portal, Lanes::from_bits(turns & ~drops_third & ~drops_second), before, 1, 2, 0);
  permute(portal, Lanes::from_bits(turns & drops_second), before, 2, 0, 1);

  // Away from the first corner alone, or from the edge of two.
  const Vector3<double> from_corner =
      difference<double>(scaled<double>(dot<double>(p[0], along), along), p[0]);
  const Vector3<double> from_edge = cross<double>(difference<double>(p[1], p[0]), along);
  const Vector3<double> away = select<double>(Lanes::from_bits(firsts), from_corner, from_edge);
  Vector length = length_of(away);
  const unsigned has_length = Lanes::to_bits(Lanes::less(zero, length));
  const Mask inward = Lanes::less(zero, dot<double>(away, p[0]));
  length = Lanes::select(without(inward, Lanes::from_bits(firsts)), -length, length);
  const unsigned goes_on = searching & ~closes & ~ends.open;
  ends.open |= goes_on & ~has_length;
  const Vector3<double> unit = scaled<double>(one / length, away);
  const Mask new_across = Lanes::from_bits(goes_on);
  store_three(select<double>(new_across, unit, across), lanes.across);
  const Vector3<double> leaning =
      moved<double>(unit, Lanes::load(lanes.lean), three_rows(lanes.entry));
  const Vector3<double> direction = select<double>(
      new_across, scaled<double>(one / length_of(leaning), leaning), three_rows(lanes.direction));
  store_three(select<double>(Lanes::from_bits(again), across, direction), lanes.direction);

  lanes.later = (lanes.later & ~closes) | (lanes.second & searching);
  lanes.second = (lanes.second & ~searching) | firsts;
  lanes.first &= ~firsts;
  lanes.straight = (lanes.straight & ~searching) | again;
  lanes.refining |= closes;
}

// Lanes with a portal: each ends at a face, or keeps one of the three portals that the new corner makes.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void refine(PortalLanes& lanes, unsigned refining,
                                                const NewCorners& found, LanePortal& portal,
                                                LaneEnds& ends) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  const Vector3<double> along = three_rows(lanes.along), normal = three_rows(lanes.direction);
  const Vector3<double>* const p = portal.places;
  const Vector speed = -dot<double>(normal, along);
  const Vector beyond = dot<double>(normal, difference<double>(found.place, p[0]));
  const Mask far = both(Lanes::less(Lanes::load(lanes.tolerance) * speed, beyond),
                        Lanes::less(Lanes::broadcast(MovingPair::rounding / 16), beyond));
  const unsigned arrived = refining & ~Lanes::to_bits(far);
  const unsigned against = Lanes::to_bits(Lanes::less(Lanes::broadcast(0), speed));
  ends.closed |= arrived & against;
  ends.open |= arrived & ~against;
  // Of the three new portals the line passes one most clearly.
  const Vector of_p = side(found.place, p[0], along), of_q = side(found.place, p[1], along),
               of_r = side(found.place, p[2], along);
  const Vector over_p = Lanes::min(of_q, -of_r), over_q = Lanes::min(of_r, -of_p),
               over_r = Lanes::min(of_p, -of_q);
  const unsigned second = Lanes::to_bits(Lanes::less(over_p, over_q));
  const unsigned third = Lanes::to_bits(Lanes::less(Lanes::max(over_p, over_q), over_r));
  const unsigned going = refining & ~arrived;
  const unsigned drops[3] = {~second & ~third, second & ~third, third};
  for (std::size_t k = 0; k < 3; ++k) {
    set_corner(portal, k, Lanes::from_bits(going & drops[k]), found.place, found.corner_a,
               found.corner_b);
  }
}

// Lanes with a portal look along its normal next.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void look_through(PortalLanes& lanes, const LanePortal& portal,
                                                      LaneEnds& ends) {
  using Lanes = Simd<double>;
  const Vector3<double>* const p = portal.places;
  const Vector3<double> normal =
      cross<double>(difference<double>(p[1], p[0]), difference<double>(p[2], p[0]));
  const auto length = length_of(normal);
  const unsigned has_length = Lanes::to_bits(Lanes::less(Lanes::broadcast(least_area), length));
  ends.open |= lanes.refining & ~ends.closed & ~has_length;
  store_three(select<double>(Lanes::from_bits(lanes.refining),
                             scaled<double>(Lanes::broadcast(1) / length, normal),
                             three_rows(lanes.direction)),
              lanes.direction);
}

// A step of all lanes. Returns the lanes that are parted to the end.
TOUCHSTONE_TARGET inline unsigned step_lanes(PortalLanes& lanes, int most_iterations,
                                             LaneEnds& ends) {
  using Lanes = Simd<double>;
  constexpr int most_corners = 26;  // support points without a portal; few searches need ten
  NewCorners found;
  const unsigned misses = take_corners(lanes, found);
  LanePortal portal;
  for (std::size_t k = 0; k < 3; ++k) {
    portal.places[k] = three_rows(lanes.places[k]);
    portal.corners_a[k] = Lanes::load(lanes.corners_a[k]);
    portal.corners_b[k] = Lanes::load(lanes.corners_b[k]);
  }
  const unsigned going = lanes.active & ~misses, refining = going & lanes.refining;
  if (refining != 0) refine(lanes, refining, found, portal, ends);
  if (going != refining) discover(lanes, going & ~refining, found, portal, ends);
  look_through(lanes, portal, ends);
  for (std::size_t k = 0; k < 3; ++k) {
    store_three(portal.places[k], lanes.places[k]);
    Lanes::store(lanes.corners_a[k], portal.corners_a[k]);
    Lanes::store(lanes.corners_b[k], portal.corners_b[k]);
  }
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
    const int most = (lanes.refining >> lane & 1) != 0 ? most_iterations
                                                       : std::min(most_corners, most_iterations);
    ends.open |= unsigned{++lanes.iterations[lane] >= most} << lane;
  }
  ends.closed &= going;
  ends.open &= going & ~ends.closed;
  return misses;
}

#include "algorithms/cast/mpr_ray_cast/portal_contacts.inl"

TOUCHSTONE_TARGET inline void search_all(std::span<const PortalQuery> queries, int most_iterations,
                                         std::span<PortalAnswer> answers) {
  PortalLanes lanes;
  std::size_t next = 0;
  LanePaths paths;
  const auto load = [&](std::size_t lane) TOUCHSTONE_TARGET {
    for (; next < queries.size(); ++next) {
      const std::size_t place = next % PortalLanes::width;
      if (place == 0) {
        const std::size_t count = std::min(PortalLanes::width, queries.size() - next);
        find_paths(queries.subspan(next, count), paths);
      }
      answers[next] = {};
      if ((paths.usable >> place & 1) == 0) continue;
      lanes.query[lane] = next;
      load_query(queries[next], paths, place, lane, lanes);
      ++next;
      return;
    }
  };
  for (std::size_t lane = 0; lane < PortalLanes::width; ++lane) load(lane);
  while (lanes.active != 0) {
    LaneEnds ends;
    const unsigned misses = step_lanes(lanes, most_iterations, ends);
    unsigned ended = misses | ends.closed | ends.open;
    lanes.active &= ~ended;
    for (unsigned* set :
         {&lanes.first, &lanes.second, &lanes.later, &lanes.refining, &lanes.straight})
      *set &= ~ended;
    for (; ended != 0; ended &= ended - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(ended));
      const PortalEnd end = (misses >> lane & 1) != 0        ? PortalEnd::miss
                            : (ends.closed >> lane & 1) != 0 ? PortalEnd::closed
                                                             : PortalEnd::open;
      store_answer(lanes, lane, end, answers[lanes.query[lane]]);
      load(lane);
    }
  }
  prove_contacts(queries, answers);
}
