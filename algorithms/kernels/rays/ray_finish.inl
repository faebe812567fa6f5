// The numbers of hits that are certain, in lanes of doubles. ray_walk.cpp includes this file once for each
// level of vector instructions, inside that level's namespace.

// The vertices of what rays hit, on their turned axes.
struct HitCorners {
  std::array<RayBlock::Each<double>, 9> at;
  double size = 1;  // mesh units
};

// Gathers them; returns the rays with a hit, as bits. Other lanes have numbers that are not used.
inline unsigned gather(const RayMesh& mesh, const RayBlock& block, std::span<const FoundHit> found,
                       HitCorners& corners) {
  const bool of_leaves = mesh.is_exact() && mesh.frame().centre.isZero(0);
  if (of_leaves) corners.size = 1 / mesh.frame().scale;
  unsigned hits = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].is_found()) continue;
    hits |= 1U << i;
    const auto [number, lane] = found[i];
    const Leaf& leaf = mesh.leaves()[number];
    const auto axes = block.axes(i);
    if (of_leaves) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          corners.at[3 * k + axis][i] = static_cast<double>(leaf.corners[3 * k + axes[axis]][lane]);
        }
      }
      continue;
    }
    const RayMesh::Corners vertices = mesh.corners(leaf, lane);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners.at[3 * k + axis][i] = vertices[k][static_cast<Eigen::Index>(axes[axis])];
      }
    }
  }
  return hits;
}

// t, u and v of the lanes from `part` on. Returns the lanes whose numbers are as near as RayQuery's, as
// bits.
TOUCHSTONE_TARGET inline unsigned finish_part(const HitCorners& corners, const RayBlock& block,
                                              std::size_t part, HitNumbers& to) {
  const Wide size = Doubles::broadcast(corners.size), zero = Doubles::broadcast(0);
  const Wide inverse = Doubles::broadcast(1) / load_at(block.turned_direction[2], part);
  const Wide shear_x = load_at(block.turned_direction[0], part) * inverse;
  const Wide shear_y = load_at(block.turned_direction[1], part) * inverse;
  Wide x[3], y[3], z[3];
  Wide reach = zero, side = zero;
  for (std::size_t k = 0; k < 3; ++k) {
    Wide seen[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      seen[axis] =
          load_at(corners.at[3 * k + axis], part) * size - load_at(block.turned_from[axis], part);
      reach = Doubles::max(reach, Doubles::abs(seen[axis]));
    }
    z[k] = seen[2];
    x[k] = seen[0] - shear_x * z[k];
    y[k] = seen[1] - shear_y * z[k];
    side = Doubles::max(side, Doubles::abs(x[k]) + Doubles::abs(y[k]));
  }
  const Wide a = x[2] * y[1] - y[2] * x[1];
  const Wide b = x[0] * y[2] - y[0] * x[2];
  const Wide c = x[1] * y[0] - y[1] * x[0];
  // The bounds are RayQuery's.
  const Wide off = Doubles::broadcast(8 * unit) * reach;
  const Wide error = Doubles::broadcast(2) * off * side + Doubles::broadcast(2) * off * off +
                     Doubles::broadcast(3 * unit) * side * side +
                     Doubles::broadcast(4 * std::numeric_limits<double>::min());
  const Wide sum = a + b + c, magnitude = Doubles::abs(sum);
  const Wide near = Doubles::min(Doubles::min(z[0], z[1]), z[2]);
  const Wide furthest = Doubles::max(Doubles::max(z[0], z[1]), z[2]);
  const Wide far = Doubles::max_abs(near, furthest);
  const Wide per_z = Doubles::abs(inverse);
  const Wide t_error = Doubles::broadcast(1.01) *
                       (Doubles::broadcast(3) * error * (furthest - near) / magnitude +
                        Doubles::broadcast(16 * unit) * far) *
                       per_z;
  const Wide t = (a * z[0] + b * z[1] + c * z[2]) / sum * inverse;
  const Wide least = Doubles::min(Doubles::min(a, b), c),
             most = Doubles::max(Doubles::max(a, b), c);
  auto sure = Doubles::less(error, Doubles::max(least, zero - most));
  sure = Doubles::less_equal(sure, Doubles::broadcast(3) * error,
                             Doubles::broadcast(0x1p-24) * magnitude);
  sure = Doubles::less_equal(sure, t_error, Doubles::broadcast(0x1p-40) * far * per_z);
  sure = Doubles::less_equal(sure, Doubles::broadcast(std::numeric_limits<double>::min()), t_error);
  sure = Doubles::less_equal(sure, zero, t - t_error);
  sure = Doubles::less_equal(sure, t + t_error, load_at(block.t_max, part));
  store_at(to.t, part, t);
  store_at(to.u, part, b / sum);
  store_at(to.v, part, c / sum);
  return Doubles::to_bits(sure) << part;
}

// The numbers of the hits that are found: those that are sure, as bits.
TOUCHSTONE_TARGET inline unsigned finish(const RayMesh& mesh, const RayBlock& block,
                                         std::span<const FoundHit> found, HitNumbers& to) {
  HitCorners corners;
  const unsigned hits = gather(mesh, block, found, corners);
  unsigned sure = 0;
  constexpr unsigned lanes = (1U << Doubles::width) - 1;
  for (std::size_t part = 0; part < found.size(); part += Doubles::width) {
    if ((hits >> part & lanes) != 0) sure |= finish_part(corners, block, part, to);
  }
  return sure & hits;
}
