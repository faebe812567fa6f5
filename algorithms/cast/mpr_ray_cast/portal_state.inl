// Part of mpr-ray-cast-lanes, included by portal_lanes.inl: what lanes know of their searches, and their support
// points.
#include "algorithms/kernels/simd/lane_rows.inl"

// The lanes' numbers are in memory, since lanes take new queries one at a time. Unused lanes have zeros.
struct PortalLanes {
  static constexpr std::size_t width = Simd<double>::width;
  using Row = double[width];

  // Of the query: its matrices by columns.
  alignas(64) Row matrix_a[9]{}, matrix_b[9]{}, start[3]{}, velocity[3]{}, along[3]{}, entry[3]{};
  alignas(64) Row lean{}, tolerance{};
  // Of the search: the direction across the path is the part of the next one that does not lean.
  alignas(64) Row time{}, plane[3]{}, direction[3]{}, across[3]{};
  // The corners of the portal, relative to the path, and their indices, which doubles hold exactly.
  alignas(64) Row places[3][3]{}, corners_a[3]{}, corners_b[3]{};
  const SupportShape<double>*shapes_a[width]{}, *shapes_b[width]{};
  std::size_t query[width]{};
  int iterations[width]{};
  // Sets of lanes, a bit each: those that look for the first, second or a later corner, those with a portal, and
  // those whose direction does not lean.
  unsigned active = 0, first = 0, second = 0, later = 0, refining = 0, straight = 0;
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void store_three(const Vector3<double>& v,
                                                     double (*rows)[Simd<double>::width]) {
  Simd<double>::store(rows[0], v.x);
  Simd<double>::store(rows[1], v.y);
  Simd<double>::store(rows[2], v.z);
}

// The path of as many queries as there are lanes, or fewer: its direction, and the normal at which it enters a ball
// that holds the difference, or passes it.
struct LanePaths {
  alignas(64) double along[3][Simd<double>::width], entry[3][Simd<double>::width];
  unsigned usable;  // a bit for each query whose path is long enough
};

TOUCHSTONE_TARGET inline void find_paths(std::span<const PortalQuery> queries, LanePaths& paths) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  alignas(64) double starts[3][Lanes::width]{}, velocities[3][Lanes::width]{},
      reaches[Lanes::width]{};
  for (std::size_t lane = 0; lane < queries.size(); ++lane) {
    const MovingPair& pair = *queries[lane].pair;
    for (std::size_t k = 0; k < 3; ++k) {
      starts[k][lane] = pair.start().data()[k];
      velocities[k][lane] = pair.velocity().data()[k];
    }
    reaches[lane] = pair.reach();
  }
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const Vector3<double> start = three_rows(starts), velocity = three_rows(velocities);
  const Vector length = length_of(velocity), reach = Lanes::load(reaches);
  paths.usable = Lanes::to_bits(Lanes::less(Lanes::broadcast(least_path), length));
  const Vector3<double> along = scaled<double>(one / length, velocity);
  const Vector3<double> nearest = moved<double>(start, -dot<double>(start, along), along);
  const Vector back = Lanes::max(reach * reach - dot<double>(nearest, nearest), zero);
  const Vector3<double> entry = moved<double>(nearest, -Lanes::sqrt(back), along);
  store_three(along, paths.along);
  store_three(scaled<double>(one / length_of(entry), entry), paths.entry);
}

TOUCHSTONE_TARGET inline void load_query(const PortalQuery& from, const LanePaths& paths,
                                         std::size_t place, std::size_t lane, PortalLanes& to) {
  const MovingPair& pair = *from.pair;
  for (std::size_t k = 0; k < 9; ++k) {
    to.matrix_a[k][lane] = pair.matrix_a().data()[k];
    to.matrix_b[k][lane] = pair.matrix_b().data()[k];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    to.start[k][lane] = pair.start().data()[k];
    to.velocity[k][lane] = pair.velocity().data()[k];
    to.along[k][lane] = paths.along[k][place];
    to.entry[k][lane] = to.direction[k][lane] = paths.entry[k][place];
    to.plane[k][lane] = 0;
  }
  to.lean[lane] = from.lean;
  to.tolerance[lane] = from.tolerance;
  to.time[lane] = 0;
  to.shapes_a[lane] = &pair.shape_a();
  to.shapes_b[lane] = &pair.shape_b();
  to.iterations[lane] = 0;
  to.active |= 1u << lane;
  to.first |= 1u << lane;
}

TOUCHSTONE_TARGET inline void store_answer(const PortalLanes& from, std::size_t lane, PortalEnd end,
                                           PortalAnswer& answer) {
  answer.end = end;
  answer.along = {from.along[0][lane], from.along[1][lane], from.along[2][lane]};
  answer.time = from.time[lane];
  answer.plane = {from.plane[0][lane], from.plane[1][lane], from.plane[2][lane]};
  answer.iterations = from.iterations[lane];
  for (std::size_t k = 0; k < 3; ++k) {
    answer.corners[k] = {static_cast<std::uint32_t>(from.corners_a[k][lane]),
                         static_cast<std::uint32_t>(from.corners_b[k][lane])};
    answer.places[k] = {from.places[k][0][lane], from.places[k][1][lane], from.places[k][2][lane]};
  }
}

// A vertex of each lane's hull, and its index.
struct FurthestVertices {
  Vector3<double> of;  // in the world's axes
  typename Simd<double>::Vector index;
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE FurthestVertices furthest_vertices(
    const SupportShape<double>* const* shapes, const double (*matrix)[Simd<double>::width],
    const Vector3<double>& direction, unsigned active) {
  constexpr std::size_t width = Simd<double>::width;
  constexpr std::uint32_t size = hull_scan::VertexBlock<double>::size;
  const Vector3<double> columns[3] = {three_rows(matrix), three_rows(matrix + 3),
                                      three_rows(matrix + 6)};
  alignas(64) double towards[3][width], vertices[3][width]{}, indices[width]{};
  for (std::size_t k = 0; k < 3; ++k)
    Simd<double>::store(towards[k], dot<double>(columns[k], direction));
  for (; active != 0; active &= active - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(active));
    const SupportShape<double>& shape = *shapes[lane];
    const double x = towards[0][lane], y = towards[1][lane], z = towards[2][lane];
    if (shape.cells.empty()) {
      const std::uint32_t i = furthest_index(shape.scanned_hull(), x, y, z);
      const hull_scan::VertexBlock<double>& block = shape.vertices[i / size];
      vertices[0][lane] = block.x[i % size];
      vertices[1][lane] = block.y[i % size];
      vertices[2][lane] = block.z[i % size];
      indices[lane] = i;
    } else {
      const std::uint32_t i = shape.furthest({x, y, z});
      const auto& corner = shape.corners[i];
      vertices[0][lane] = corner.x;
      vertices[1][lane] = corner.y;
      vertices[2][lane] = corner.z;
      indices[lane] = i;
    }
  }
  const Vector3<double> v = three_rows(vertices);
  return {moved<double>(moved<double>(scaled<double>(v.x, columns[0]), v.y, columns[1]), v.z,
                        columns[2]),
          Simd<double>::load(indices)};
}
