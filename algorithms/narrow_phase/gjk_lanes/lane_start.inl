// Part of gjk-lanes, included by lane_answer.inl: loads new pairs into free lanes.

// The centre of a hull that is near its origin, relative to the origin: metres, world axes. The
// first of the four numbers is unused.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> turned_centre(const LaneShape<Scalar>& shape,
                                                               const Pose& pose) {
  const Quad<double> last = pose_quad(pose, 5);
  const Quad<double> sum = pose_quad(pose, 0) * shape.centre[0] +
                           pose_quad(pose, 3) * shape.centre[1] +
                           __builtin_shufflevector(last, last, 1, 2, 3, 3) * shape.centre[2];
  return __builtin_shufflevector(sum, sum, 0, 0, 1, 2);
}

// Returns true if balls around the bodies are apart. `offset` is between their centres. A matrix
// lengthens a vector by at most its Frobenius norm, which is sqrt(3) for a rotation. Matrices far
// from that, and numbers whose squares may overflow or underflow, are left to the search.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool balls_apart(const Quad<double>& offset, double reach_a,
                                                     const Pose& pose_a, double reach_b,
                                                     const Pose& pose_b) {
  const Quad<double> squares = offset * offset;
  const double square = squares[1] + squares[2] + squares[3];
  // The square of a sum is at most twice the sum of the squares.
  if (!(square > 6.11 * (reach_a * reach_a + reach_b * reach_b))) [[likely]]
    return false;
  const double stretch_a = pose_a.rotation.squaredNorm();
  const double stretch_b = pose_b.rotation.squaredNorm();
  return stretch_a < 3.05 && stretch_b < 3.05 && square > 1e-280 &&
         square < std::numeric_limits<double>::infinity();
}

enum class Loaded : std::uint8_t { iterates, apart, left };

// Stores the pair's numbers in the lane, scaled by a unit as in SupportPair.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Loaded load_pair(const PairTable<Scalar>& table,
                                                     const LaneGoal<Scalar>& goal,
                                                     std::uint32_t place, std::size_t lane,
                                                     LaneState<Scalar>& state) {
  const BodyPairs& pairs = table.pairs;
  const std::uint32_t first = pairs.first[place], second = pairs.second[place];
  const LaneShape<Scalar>& a = goal.shapes[pairs.shape_of[first]];
  const LaneShape<Scalar>& b = goal.shapes[pairs.shape_of[second]];
  const Pose &pose_a = pairs.poses[first], &pose_b = pairs.poses[second];
  const Quad<double> end_a = pose_quad(pose_a, 8), end_b = pose_quad(pose_b, 8);
  Quad<double> offset = end_b - end_a;
  if (!goal.centred) offset = (turned_centre(b, pose_b) - turned_centre(a, pose_a)) + offset;
  const double reach_a = a.numbers[2], reach_b = b.numbers[2];
  if (!goal.distances && balls_apart<Scalar>(offset, reach_a, pose_a, reach_b, pose_b)) {
    return Loaded::apart;
  }
  const double furthest =
      std::max(std::max(std::abs(offset[1]), std::abs(offset[2])), std::abs(offset[3]));
  const double greatest = std::max(furthest, std::max(reach_a, reach_b));
  // The power of two above it, and its inverse, from the bits.
  const auto field = std::bit_cast<std::uint64_t>(greatest) >> 52;
  if (field < 64 || field > 1980) return Loaded::left;
  const double unit = std::bit_cast<double>((field + 1) << 52);
  const double scale = std::bit_cast<double>((2045 - field) << 52);
  state.unit[lane] = unit;
  state.place[lane] = place;

  if (goal.directions != nullptr) {
    Quad<float> direction;
    std::memcpy(&direction, &goal.directions[place], sizeof direction);
    state.directions[lane] = __builtin_convertvector(direction, Quad<Scalar>);
  }
  Quad<double> numbers_a, numbers_b;
  std::memcpy(&numbers_a, a.numbers, sizeof numbers_a);
  std::memcpy(&numbers_b, b.numbers, sizeof numbers_b);
  state.sizes[lane] =
      convert<Scalar>(__builtin_shufflevector(numbers_a, numbers_b, 0, 1, 4, 5) * scale);
  state.poses[0][lane] = convert<Scalar>(pose_quad(pose_a, 0));
  state.poses[1][lane] = convert<Scalar>(pose_quad(pose_a, 4));
  state.poses[2][lane] = convert<Scalar>(pose_quad(pose_b, 0));
  state.poses[3][lane] = convert<Scalar>(pose_quad(pose_b, 4));
  state.poses[4][lane] = convert<Scalar>(offset * scale);
  state.poses[5][lane] = convert<Scalar>(__builtin_shufflevector(end_a, end_b, 0, 4, 0, 4));
  std::memcpy(&state.extents_a[lane], a.extents, sizeof(Quad<Scalar>));
  std::memcpy(&state.extents_b[lane], b.extents, sizeof(Quad<Scalar>));
  state.corners_a[lane] = a.vertices;
  state.corners_b[lane] = b.vertices;
  // The vertices are used after the other lanes are loaded.
  if (goal.scans_a) prefetch_hull(a.scanned_hull());
  if (goal.scans_b) prefetch_hull(b.scanned_hull());
  state.hulls_a[lane] = a.scanned_hull();
  state.hulls_b[lane] = b.scanned_hull();
  return Loaded::iterates;
}

// Loads one coordinate of a vertex of each lane and of the three after it. `offset` is the
// coordinate's position in the block.
template <class Scalar, std::size_t... lane>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void four_vertices(
    const hull_scan::VertexBlock<Scalar>* const* blocks, std::size_t offset,
    typename Simd<Scalar>::Vector four[4], std::index_sequence<lane...>) {
  Quad<Scalar> quads[sizeof...(lane)];
  (std::memcpy(&quads[lane], reinterpret_cast<const char*>(blocks[lane]) + offset,
               sizeof quads[lane]),
   ...);
  columns_of<Scalar>(quads, four);
}

// Rotates the core of a body and scales it to the pair's unit. Vertices are relative to `centre`,
// or to the body's centre if it is null.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void turn_core(
    const Vector3<Scalar> columns[3], const Quad<Scalar>* extents, int halves,
    const hull_scan::VertexBlock<Scalar>* const* blocks, std::uint32_t vertices,
    const Vector3<Scalar>* centre, Vector3<Scalar>* core) {
  using Vector = typename Simd<Scalar>::Vector;
  using Block = hull_scan::VertexBlock<Scalar>;
  constexpr auto lanes = std::make_index_sequence<Simd<Scalar>::width>{};
  if (halves != 0) {
    Vector sizes[4];
    columns_of<Scalar>(extents, sizes);
    for (int k = 3 - halves; k < 3; ++k) *core++ = scaled<Scalar>(sizes[k], columns[k]);
  }
  for (std::size_t k = 0; k < vertices; k += 4) {
    Vector x[4], y[4], z[4];
    four_vertices<Scalar>(blocks, offsetof(Block, x) + k * sizeof(Scalar), x, lanes);
    four_vertices<Scalar>(blocks, offsetof(Block, y) + k * sizeof(Scalar), y, lanes);
    four_vertices<Scalar>(blocks, offsetof(Block, z) + k * sizeof(Scalar), z, lanes);
    for (int i = 0; i < 4; ++i) {
      Vector3<Scalar> turned = scaled<Scalar>(x[i], columns[0]);
      turned = moved<Scalar>(moved<Scalar>(turned, y[i], columns[1]), z[i], columns[2]);
      if (centre != nullptr) {
        turned = {turned.x + centre->x, turned.y + centre->y, turned.z + centre->z};
      }
      *core++ = turned;
    }
  }
}

// Scales the columns of a matrix. Returns the lanes whose greatest entry is about that of a
// rotation, as bits: then the unit is above the size of the body, and near it.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned scale_columns(Vector3<Scalar> columns[3],
                                                           typename Simd<Scalar>::Vector scale) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  Vector greatest = Lanes::broadcast(0);
  for (int k = 0; k < 3; ++k) {
    Vector3<Scalar>& column = columns[k];
    greatest = Lanes::max(
        greatest,
        Lanes::max(Lanes::max(Lanes::abs(column.x), Lanes::abs(column.y)), Lanes::abs(column.z)));
    column = scaled<Scalar>(scale, column);
  }
  return Lanes::to_bits(both(Lanes::less(Lanes::broadcast(Scalar(0.5)), greatest),
                             Lanes::less(greatest, Lanes::broadcast(Scalar(1.001)))));
}

// Prefetches the data of a later pair.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void prefetch_bodies(const PairTable<Scalar>& table,
                                                         const LaneGoal<Scalar>& goal,
                                                         std::uint32_t pair) {
  for (const std::uint32_t body : {table.pairs.first[pair], table.pairs.second[pair]}) {
    prefetch(&table.pairs.poses[body], sizeof(Pose));
    prefetch(&goal.shapes[table.pairs.shape_of[body]], sizeof(LaneShape<Scalar>));
  }
}

// Rotates the loaded bodies in all lanes; lanes that were active before get the same values again.
// Returns the lanes whose matrices are usable, as bits.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned turn_lanes(const LaneGoal<Scalar>& goal,
                                                        LaneState<Scalar>& state) {
  using Vector = typename Simd<Scalar>::Vector;
  Vector poses[6][4], sizes[4];
  for (int k = 0; k < 6; ++k) columns_of<Scalar>(state.poses[k], poses[k]);
  columns_of<Scalar>(state.sizes, sizes);
  Vector3<Scalar> columns_a[3] = {{poses[0][0], poses[0][1], poses[0][2]},
                                  {poses[0][3], poses[1][0], poses[1][1]},
                                  {poses[1][2], poses[1][3], poses[5][0]}};
  Vector3<Scalar> columns_b[3] = {{poses[2][0], poses[2][1], poses[2][2]},
                                  {poses[2][3], poses[3][0], poses[3][1]},
                                  {poses[3][2], poses[3][3], poses[5][1]}};
  unsigned usable = scale_columns<Scalar>(columns_a, sizes[0]);
  usable &= scale_columns<Scalar>(columns_b, sizes[2]);
  state.centre_b = {poses[4][1], poses[4][2], poses[4][3]};
  state.radius_a = sizes[1];
  state.radius_b = sizes[3];
  if (goal.scans_a) {
    std::ranges::copy(columns_a, state.a);
  } else {
    turn_core<Scalar>(columns_a, state.extents_a, goal.halves_a, state.corners_a, goal.vertices_a,
                      nullptr, state.a);
  }
  if (goal.scans_b) {
    std::ranges::copy(columns_b, state.b);
  } else {
    turn_core<Scalar>(columns_b, state.extents_b, goal.halves_b, state.corners_b, goal.vertices_b,
                      &state.centre_b, state.b);
  }
  return usable;
}

// Gives the next pairs of the queue to free lanes and writes the places of pairs that the lanes
// cannot take to `left`. Returns the new number of places in `left`.
template <class Scalar>
TOUCHSTONE_TARGET std::size_t start_lanes(const PairTable<Scalar>& table,
                                          const LaneGoal<Scalar>& goal,
                                          std::span<const std::uint32_t> queue, std::size_t& next,
                                          LaneState<Scalar>& state, std::size_t left) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t ahead = 8;  // pairs
  unsigned fresh = 0;
  for (std::size_t lane = 0; lane < Lanes::width && next < queue.size(); ++lane) {
    if ((state.active >> lane & 1) != 0) continue;
    while (next < queue.size()) {
      if (goal.scans() && next + ahead < queue.size())
        prefetch_bodies(table, goal, queue[next + ahead]);
      const std::uint32_t place = queue[next++];
      const Loaded loaded = load_pair<Scalar>(table, goal, place, lane, state);
      if (loaded == Loaded::iterates) {
        fresh |= 1u << lane;
        break;
      }
      if (loaded == Loaded::left) {
        table.left[left++] = place;
      } else {
        write_verdict(true, 0, table.outcomes[place]);
      }
    }
  }
  const unsigned usable = turn_lanes<Scalar>(goal, state);
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  state.doubtful |= fresh & ~usable;
  state.active |= fresh & usable;
  const auto set = Lanes::from_bits(fresh);
  Vector3<Scalar> search = scaled<Scalar>(-one, state.centre_b);
  if (goal.directions != nullptr) {
    Vector columns[4];
    columns_of<Scalar>(state.directions, columns);
    const Vector3<Scalar> known{-columns[0], -columns[1], -columns[2]};
    const auto is_known = Lanes::less(Lanes::broadcast(Scalar(0.1)), dot<Scalar>(known, known));
    search = select<Scalar>(is_known, known, search);
  }
  Vector square = dot<Scalar>(search, search);
  const auto some = Lanes::less(Lanes::broadcast(shortest_square<Scalar>), square);
  search = select<Scalar>(some, search, {one, zero, zero});
  square = Lanes::select(some, square, one);
  state.search = select<Scalar>(set, search, state.search);
  state.length = Lanes::select(set, Lanes::sqrt(square), state.length);
  state.along =
      Lanes::select(set, Lanes::broadcast(std::numeric_limits<Scalar>::infinity()), state.along);
  state.count = Lanes::select(set, zero, state.count);
  LaneSimplex<Scalar>& simplex = state.simplex;
  simplex.has_b = without(simplex.has_b, set);
  simplex.has_c = without(simplex.has_c, set);
  simplex.has_d = without(simplex.has_d, set);
  return left;
}
