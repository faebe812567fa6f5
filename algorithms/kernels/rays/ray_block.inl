// Rays into the frame of a tree, in lanes. ray_walk.cpp includes this file once for each level of
// vector instructions, inside that level's namespace.

using Doubles = Simd<double>;
using Wide = Doubles::Vector;

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Wide load_at(const RayBlock::Each<double>& from,
                                                 std::size_t at) {
  return Doubles::load(&from[at]);
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void store_at(RayBlock::Each<double>& to, std::size_t at,
                                                  Wide x) {
  Doubles::store(&to[at], x);
}

// Doubles on their way to floats.
struct Unrounded {
  std::array<RayBlock::Each<double>, 3> along, near, far, origin;
  RayBlock::Each<double> shear_x, shear_y, off, tau_off, tau_end, sure_begin, sure_end, z;
};

// The way to where a ray that begins far away comes near the mesh, which lies within 1 of the frame's
// centre on each axis; the margin is far more than the rounding. A ray that comes near after a long way
// misses the mesh, or comes nearer on another axis.
inline double way_to_mesh(const std::array<double, 3>& from, const std::array<double, 3>& along) {
  double enter = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::abs(from[axis]) - 1;
    if (gap > 0 && from[axis] * along[axis] < 0)
      enter = std::max(enter, gap / std::abs(along[axis]));
  }
  return enter < 0x1p31 ? std::max(0.0, enter * (1 - 0x1p-40) - 0x1p-10) : 0.0;
}

// The lanes from `part` on.
TOUCHSTONE_TARGET inline void localise_part(const RayMesh& mesh, std::size_t part, RayBlock& block,
                                            Unrounded& to) {
  const Frame& frame = mesh.frame();
  const Wide scale = Doubles::broadcast(frame.scale), zero = Doubles::broadcast(0);
  Wide from[3], along[3], size[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide centre = Doubles::broadcast(frame.centre[static_cast<Eigen::Index>(k)]);
    from[k] = (load_at(block.from[k], part) - centre) * scale;
    along[k] = load_at(block.direction[k], part);
    size[k] = Doubles::abs(along[k]);
  }
  const Wide reach = Doubles::max(Doubles::max(Doubles::abs(from[0]), Doubles::abs(from[1])),
                                  Doubles::abs(from[2]));
  const Wide greatest = Doubles::max(Doubles::max(size[0], size[1]), size[2]);
  const Wide per_t = greatest * scale;
  const Wide t_max = load_at(block.t_max, part);
  // Each comparison is false for NaN.
  auto good = Doubles::less(Doubles::abs(from[0]), Doubles::broadcast(0x1p30));
  good = Doubles::less_equal(good, Doubles::abs(from[1]), Doubles::broadcast(0x1p30));
  good = Doubles::less_equal(good, Doubles::abs(from[2]), Doubles::broadcast(0x1p30));
  for (const Wide& s : size) good = Doubles::less_equal(good, s, Doubles::broadcast(0x1p900));
  good = Doubles::less_equal(good, Doubles::broadcast(0x1p-900), greatest);
  good = Doubles::less_equal(good, Doubles::broadcast(0x1p-900), per_t);
  good = Doubles::less_equal(good, per_t, Doubles::broadcast(0x1p900));
  good = Doubles::less_equal(good, zero, t_max);
  block.usable |= Doubles::to_bits(good) << part;
  store_at(block.per_t, part, per_t);

  const auto x_first = Doubles::less_equal(Doubles::less_equal(size[1], size[0]), size[2], size[0]);
  const auto y_first = Doubles::less_equal(size[2], size[1]);
  const unsigned x_bits = Doubles::to_bits(x_first), y_bits = Doubles::to_bits(y_first);
  for (std::size_t lane = 0; lane < Doubles::width; ++lane) {
    block.greatest[part + lane] = (x_bits >> lane & 1) != 0 ? 0U : 2U - (y_bits >> lane & 1);
  }
#define TOUCHSTONE_TURNED(v, k)                \
  Doubles::select(x_first, (v)[((k) + 1) % 3], \
                  Doubles::select(y_first, (v)[((k) + 2) % 3], (v)[(k)]))
  Wide given[3];
  for (std::size_t k = 0; k < 3; ++k) given[k] = load_at(block.from[k], part);
  for (std::size_t k = 0; k < 3; ++k) {
    store_at(block.turned_from[k], part, TOUCHSTONE_TURNED(given, k));
    store_at(block.turned_direction[k], part, TOUCHSTONE_TURNED(along, k));
  }

  // The direction is off by two units. What that moves the ray by is within the margins.
  const Wide per_greatest = Doubles::broadcast(1) / greatest;
  for (Wide& a : along) a = a * per_greatest;
  Wide moved = zero;
  if (Doubles::to_bits(Doubles::less(Doubles::broadcast(4), reach)) != 0) {
    alignas(64) std::array<double, Doubles::width> ways, from_at[3], along_at[3];
    for (std::size_t k = 0; k < 3; ++k) {
      Doubles::store(from_at[k].data(), from[k]);
      Doubles::store(along_at[k].data(), along[k]);
    }
    for (std::size_t lane = 0; lane < Doubles::width; ++lane) {
      ways[lane] = way_to_mesh({from_at[0][lane], from_at[1][lane], from_at[2][lane]},
                               {along_at[0][lane], along_at[1][lane], along_at[2][lane]});
    }
    moved = Doubles::load(ways.data());
    for (std::size_t k = 0; k < 3; ++k) from[k] = from[k] + moved * along[k];
  }
  store_at(block.moved, part, moved);
  // Of the origin in the frame: two roundings at first, and four of the way that it was moved.
  const Wide off = Doubles::broadcast(8 * unit) * (reach + Doubles::broadcast(2) * moved);
  // 2^-50 is more than the least component, and the direction's roundings, move the ray by
  // over the whole way.
  const Wide plane_off = off + Doubles::broadcast(0x1p-50);
  // A component that is zero, or nearly, becomes a small one, so that planes are not divided by zero.
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide kept =
        Doubles::select(Doubles::less(Doubles::abs(along[k]), Doubles::broadcast(0x1p-60)),
                        Doubles::broadcast(0x1p-60), along[k]);
    const auto backward = Doubles::less(kept, zero);
    const Wide ahead = from[k] + plane_off, behind = from[k] - plane_off;
    store_at(to.along[k], part, kept);
    store_at(to.near[k], part, Doubles::select(backward, behind, ahead));
    store_at(to.far[k], part, Doubles::select(backward, ahead, behind));
  }
  for (std::size_t k = 0; k < 3; ++k) store_at(to.origin[k], part, TOUCHSTONE_TURNED(from, k));
  store_at(to.z, part, TOUCHSTONE_TURNED(along, 2));
  store_at(to.shear_x, part, TOUCHSTONE_TURNED(along, 0));
  store_at(to.shear_y, part, TOUCHSTONE_TURNED(along, 1));
#undef TOUCHSTONE_TURNED

  // A vertex seen from the origin is up to `seen` long. Its coordinate is off by the vertex's own
  // rounding (none if the leaves are exact), the origin's in doubles and in floats, and one of the
  // difference. The sheared one has two such errors, the shear's rounding, a product's and a sum's.
  const Wide half = Doubles::broadcast(float_unit);
  const Wide origin_reach = Doubles::max(Doubles::max(Doubles::abs(from[0]), Doubles::abs(from[1])),
                                         Doubles::abs(from[2]));
  const Wide seen = Doubles::broadcast(1) + origin_reach;
  const Wide coordinate = Doubles::broadcast(mesh.is_exact() ? 0 : float_unit) + off +
                          half * origin_reach + half * seen;
  store_at(
      to.off, part,
      Doubles::broadcast(1.01) * (coordinate + coordinate + Doubles::broadcast(4) * half * seen));
  const Wide tau_off =
      Doubles::broadcast(1.01) * (coordinate + Doubles::broadcast(3) * half * seen);
  store_at(to.tau_off, part, tau_off);
  const Wide end = t_max * per_t, up = Doubles::broadcast(1 + 0x1p-40),
             down = Doubles::broadcast(1 - 0x1p-40);
  store_at(to.tau_end, part, end * up - moved * down + tau_off);
  store_at(to.sure_begin, part, zero - moved * down);
  store_at(to.sure_end, part, Doubles::min(end * down - moved * up, Doubles::broadcast(0x1p100)));
}

using Floats = Simd<float>;
using Narrow = Floats::Vector;

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Narrow rounded_at(const RayBlock::Each<double>& from,
                                                      std::size_t at) {
  using Loaded = double __attribute__((vector_size(2 * sizeof(Narrow))));
  using Rounded = float __attribute__((vector_size(sizeof(Narrow))));
  Loaded x;
  std::memcpy(&x, &from[at], sizeof x);
  return bit_cast<Narrow>(__builtin_convertvector(x, Rounded));
}
// Floats on that side of x to which `outward` (1 or -1) points; off by less than two of their digits.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Narrow widened_at(const RayBlock::Each<double>& from,
                                                      std::size_t at, Narrow outward) {
  const Narrow f = rounded_at(from, at);
  return f +
         outward * (Floats::abs(f) * Floats::broadcast(0x1p-23F) + Floats::broadcast(0x1p-100F));
}

TOUCHSTONE_TARGET inline void round_part(const Unrounded& to, std::size_t at, RayBlock& block) {
  const Narrow zero = Floats::broadcast(0), up = Floats::broadcast(1), down = Floats::broadcast(-1);
  for (std::size_t k = 0; k < 3; ++k) {
    const Narrow along = rounded_at(to.along[k], at);
    const auto backward = Floats::less(along, zero);
    const Narrow outward = Floats::select(backward, down, up);
    Floats::store(&block.inverse[k][at], up / Floats::abs(along) * outward);
    Floats::store(&block.near_origin[k][at], widened_at(to.near[k], at, outward));
    Floats::store(&block.far_origin[k][at], widened_at(to.far[k], at, zero - outward));
    Floats::store(&block.origin[k][at], rounded_at(to.origin[k], at));
    block.backward[k] |= Floats::to_bits(backward) << at;
  }
  Floats::store(&block.shear_x[at], rounded_at(to.shear_x, at));
  Floats::store(&block.shear_y[at], rounded_at(to.shear_y, at));
  const Narrow z = rounded_at(to.z, at);
  Floats::store(&block.sign_z[at], Floats::select(Floats::less(z, zero), down, up));
  Floats::store(&block.off[at], widened_at(to.off, at, up));
  Floats::store(&block.tau_off[at], widened_at(to.tau_off, at, up));
  Floats::store(&block.tau_end[at], widened_at(to.tau_end, at, up));
  // No box is met before 0, so what is sure is behind it too.
  Floats::store(&block.sure_begin[at],
                Floats::max(widened_at(to.sure_begin, at, up), Floats::broadcast(0x1p-100F)));
  Floats::store(&block.sure_end[at], widened_at(to.sure_end, at, down));
}

// The rays into the tree's frame.
TOUCHSTONE_TARGET inline void localise(const RayMesh& mesh, RayBlock& block) {
  Unrounded to;
  block.usable = 0;
  block.backward = {};
  const std::size_t lanes =
      (block.count + Simd<float>::width - 1) / Simd<float>::width * Simd<float>::width;
  for (std::size_t part = 0; part < lanes; part += Doubles::width) {
    localise_part(mesh, part, block, to);
  }
  block.usable &= (1U << block.count) - 1;
  for (std::size_t i = 0; i < lanes; i += Floats::width) round_part(to, i, block);
}
