// Part of gjk-lanes, included by lane_gjk.inl: EPA in lanes, from the tetrahedra around the origin
// that GJK ends with. The bounds are those of expanding_polytope.h. Pairs that do not converge are
// left to the serial EPA.
#include "algorithms/narrow_phase/gjk_lanes/lane_expand.inl"
#include "algorithms/narrow_phase/gjk_lanes/lane_support.inl"

// Stores the tetrahedra of these lanes, which contain the origin.
template <class Scalar>
TOUCHSTONE_TARGET void note_starts(const LaneState<Scalar>& state, unsigned lanes,
                                   DepthStarts<Scalar>& starts) {
  using Lanes = Simd<Scalar>;
  const auto& [a, b, c, d] = state.around;
  const Corner<Scalar>* const corners[4] = {&a, &b, &c, &d};
  alignas(64) Quad<Scalar> points[4][Lanes::width], on_a[4][Lanes::width];
  for (std::size_t k = 0; k < 4; ++k) {
    to_quads<Scalar>(corners[k]->point, points[k]);
    to_quads<Scalar>(corners[k]->on_a, on_a[k]);
  }
  alignas(64) Scalar counts[Lanes::width];
  std::memcpy(counts, &state.count, sizeof counts);
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    DepthStart<Scalar>& start = starts.all[starts.count++];
    start.place = state.place[lane];
    start.iterations = static_cast<std::int32_t>(counts[lane]);
    for (std::size_t k = 0; k < 4; ++k) {
      start.points[k] = points[k][place<Lanes>(lane)];
      start.on_a[k] = on_a[k][place<Lanes>(lane)];
    }
  }
}

// Gives the next tetrahedra to free lanes, and writes the places of pairs with unusable tetrahedra
// to `left`. Returns the new number of places in `left`.
template <class Scalar>
TOUCHSTONE_TARGET std::size_t start_expanders(const PairTable<Scalar>& table,
                                              const LaneGoal<Scalar>& goal, std::size_t& next,
                                              LaneState<Scalar>& state,
                                              Expanders<Scalar>& expanders, std::size_t left) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const DepthStarts<Scalar>& starts = *goal.starts;
  unsigned fresh = 0;
  for (std::size_t lane = 0; lane < Lanes::width && next < starts.count; ++lane) {
    if ((expanders.active >> lane & 1) != 0) continue;
    const DepthStart<Scalar>& start = starts.all[next++];
    // The pair was loaded before, so it loads again.
    load_pair<Scalar>(table, goal, start.place, lane, state);
    for (std::size_t k = 0; k < 4; ++k) {
      expanders.points[k][lane] = start.points[k];
      expanders.on_a[k][lane] = start.on_a[k];
    }
    expanders.iterations[lane] = start.iterations;
    expanders.surfaces[lane].start();
    fresh |= 1u << lane;
  }
  turn_lanes<Scalar>(goal, state);

  Vector3<Scalar> corners[4];
  for (std::size_t k = 0; k < 4; ++k) corners[k] = from_quads<Scalar>(expanders.points[k]);
  const Vector3<Scalar> to[3] = {difference<Scalar>(corners[1], corners[0]),
                                 difference<Scalar>(corners[2], corners[0]),
                                 difference<Scalar>(corners[3], corners[0])};
  const Vector volume = dot<Scalar>(to[2], cross<Scalar>(to[0], to[1]));
  const auto inside_out = Lanes::less(volume, Lanes::broadcast(0));
  for (unsigned turned = Lanes::to_bits(inside_out) & fresh; turned != 0; turned &= turned - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(turned));
    std::swap(expanders.points[0][lane], expanders.points[1][lane]);
    std::swap(expanders.on_a[0][lane], expanders.on_a[1][lane]);
  }
  const Vector3<Scalar> first = select<Scalar>(inside_out, corners[1], corners[0]);
  corners[1] = select<Scalar>(inside_out, corners[0], corners[1]);
  corners[0] = first;

  const auto set = Lanes::from_bits(fresh);
  const Vector outside = Lanes::broadcast(-2 * lane_rounding<Scalar>);
  unsigned usable = fresh;
  for (std::size_t face = 0; face < 4; ++face) {
    const auto [a, b, c] = BitsetHull::tetrahedron[face];
    const TrianglePlanes<Scalar> plane =
        triangle_planes<Scalar>(corners[a], corners[b], corners[c]);
    usable &= Lanes::to_bits(Lanes::less(outside, plane.distance));
    expanders.normal[face] = select<Scalar>(set, plane.normal, expanders.normal[face]);
    expanders.distance[face] = Lanes::select(set, plane.distance, expanders.distance[face]);
  }
  expanders.faces = 4;
  for (unsigned open = expanders.active; open != 0; open &= open - 1) {
    expanders.faces = std::max(expanders.faces, expanders.surfaces[std::countr_zero(open)].faces());
  }
  const Vector nowhere = Lanes::broadcast(std::numeric_limits<Scalar>::infinity());
  for (std::size_t face = 4; face < expanders.faces; ++face) {
    expanders.distance[face] = Lanes::select(set, nowhere, expanders.distance[face]);
  }
  expanders.active |= usable;
  for (unsigned flat = fresh & ~usable; flat != 0; flat &= flat - 1) {
    table.left[left++] = state.place[std::countr_zero(flat)];
  }
  return left;
}

// Writes the depth of a lane's pair. The witness points are at the origin's projection on the
// nearest face, or on another face in its plane.
template <class Scalar>
TOUCHSTONE_TARGET void write_depth(const PairTable<Scalar>& table, const LaneGoal<Scalar>& goal,
                                   const LaneState<Scalar>& state,
                                   const Expanders<Scalar>& expanders, std::size_t lane,
                                   std::size_t face, const Vec3<Scalar>& normal, Scalar height,
                                   Scalar least) {
  constexpr std::size_t width = Simd<Scalar>::width;
  const BitsetHull& surface = expanders.surfaces[lane];
  const auto point = [lane](const Quad<Scalar>(*quads)[width], int vertex) {
    const Quad<Scalar>& q = quads[vertex][lane];
    return Vec3<Scalar>(q[0], q[1], q[2]);
  };
  const auto vertices_of = [&](std::size_t other) {
    const BitsetHull::Corners& c = surface.corners(other);
    return std::array<int, 3>{c[0], c[1], c[2]};
  };
  const auto points_of = [&](const std::array<int, 3>& vertices) {
    return std::array{point(expanders.points, vertices[0]), point(expanders.points, vertices[1]),
                      point(expanders.points, vertices[2])};
  };
  const auto in_plane = [&](const Vec3<Scalar>& corner) {
    return std::abs(normal.dot(corner) - least) <= lane_rounding<Scalar>;
  };
  OriginProjection<Scalar> foot(vertices_of(face), points_of(vertices_of(face)));
  for (std::size_t i = 0; i < surface.faces() && !foot.is_inside(); ++i) {
    const Scalar away = reinterpret_cast<const Scalar*>(&expanders.distance[i])[lane];
    if (!(away < least + lane_rounding<Scalar>)) continue;
    const std::array<int, 3> vertices = vertices_of(i);
    const auto corners = points_of(vertices);
    if (std::ranges::all_of(corners, in_plane)) foot.consider(vertices, corners);
  }
  const std::array<Scalar, 3> weights = foot.weights();
  Vec3<Scalar> on_a = Vec3<Scalar>::Zero(), apart = Vec3<Scalar>::Zero();
  for (int i = 0; i < 3; ++i) {
    on_a += weights[i] * point(expanders.on_a, foot.vertices()[i]);
    apart += weights[i] * point(expanders.points, foot.vertices()[i]);
  }
  const auto of = [lane](const typename Simd<Scalar>::Vector& numbers) {
    return reinterpret_cast<const Scalar*>(&numbers)[lane];
  };
  const Scalar radius_a = of(state.radius_a), radius_b = of(state.radius_b);
  const double unit = state.unit[lane];
  const double depth = static_cast<double>(radius_a + radius_b + height);
  const double margin = static_cast<double>(lane_rounding<Scalar>);
  const std::uint32_t place_of_pair = state.place[lane];
  const std::uint32_t body = table.pairs.first[place_of_pair];
  const Pose& pose = table.pairs.poses[body];
  Vec3d origin = pose.translation;
  if (!goal.centred) {
    const Quad<double> centre = turned_centre(goal.shapes[table.pairs.shape_of[body]], pose);
    origin += Vec3d(centre[1], centre[2], centre[3]);
  }
  Outcome& outcome = table.outcomes[place_of_pair];
  write_verdict(false, expanders.iterations[lane], outcome);
  outcome.distance = -unit * depth;
  outcome.lower = -unit * (depth + margin);
  outcome.upper = -unit * (depth - static_cast<double>(height - std::min(least, height)) - margin);
  outcome.normal = normal.template cast<double>();
  const Vec3<Scalar> on_b = on_a - apart - radius_b * normal;
  outcome.witness_a = origin + unit * (on_a + radius_a * normal).template cast<double>();
  outcome.witness_b = origin + unit * on_b.template cast<double>();
}

// Takes one step of every lane: writes the answer if the bounds meet, otherwise adds a vertex.
template <class Scalar>
TOUCHSTONE_TARGET std::size_t expand_on(const PairTable<Scalar>& table,
                                        const LaneGoal<Scalar>& goal, LaneState<Scalar>& state,
                                        Expanders<Scalar>& expanders, std::size_t left) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t width = Lanes::width;
  const unsigned active = expanders.active;
  const NearestFaces<Scalar> nearest = nearest_faces<Scalar>(expanders);
  const Vector3<Scalar>& normal = nearest.normal;
  const Corner<Scalar> corner = find_corner<Scalar>(goal, state, {-normal.x, -normal.y, -normal.z},
                                                    Lanes::broadcast(1), active);
  const Vector height = dot<Scalar>(normal, corner.point);
  const Vector open = height - nearest.distance, tolerance = Lanes::broadcast(goal.tolerance);
  unsigned going = active & Lanes::to_bits(Lanes::less(tolerance, open));
  const unsigned met = active & Lanes::to_bits(Lanes::less(open, tolerance));
  for (unsigned each = active; each != 0; each &= each - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(each));
    ++expanders.iterations[lane];
    if (expanders.surfaces[lane].vertices() == BitsetHull::most_vertices ||
        expanders.iterations[lane] >= goal.most_expansions) {
      going &= ~(1u << lane);
    }
  }
  unsigned ended = active & ~going;
  if (met != 0) {
    alignas(64) Scalar numbers[6][width];
    const Vector columns[6] = {normal.x, normal.y,         normal.z,
                               height,   nearest.distance, nearest.place};
    std::memcpy(numbers, columns, sizeof numbers);
    for (unsigned each = met; each != 0; each &= each - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(each));
      write_depth<Scalar>(table, goal, state, expanders, lane,
                          static_cast<std::size_t>(numbers[5][lane]),
                          {numbers[0][lane], numbers[1][lane], numbers[2][lane]}, numbers[3][lane],
                          numbers[4][lane]);
    }
  }
  if (going != 0) ended |= going & ~add_vertices<Scalar>(expanders, corner, going);
  for (unsigned each = ended & ~met; each != 0; each &= each - 1) {
    table.left[left++] = state.place[std::countr_zero(each)];
  }
  expanders.active &= ~ended;
  return left;
}

// Finds the depths of the stored pairs and writes the places of those that stay open to `left`.
// Returns the new number of places in `left`.
template <class Scalar>
TOUCHSTONE_TARGET std::size_t expand_lanes(const PairTable<Scalar>& table,
                                           const LaneGoal<Scalar>& goal, std::size_t left) {
  constexpr std::size_t width = Simd<Scalar>::width;
  LaneState<Scalar> state{};
  std::ranges::fill(state.corners_a, goal.some_vertices);
  std::ranges::fill(state.corners_b, goal.some_vertices);
  Expanders<Scalar> expanders;
  // Lanes without a pair need valid numbers too.
  std::memset(expanders.points, 0, 4 * sizeof expanders.points[0]);
  std::size_t next = 0;
  while (next < goal.starts->count || expanders.active != 0) {
    left = start_expanders<Scalar>(table, goal, next, state, expanders, left);
    const int enough = next < goal.starts->count ? static_cast<int>(width * 5 / 8) : 1;
    do {
      left = expand_on<Scalar>(table, goal, state, expanders, left);
    } while (std::popcount(expanders.active) >= enough && expanders.active != 0);
  }
  return left;
}
