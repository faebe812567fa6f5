// Bounds on the rays of a block that go about the same way, and eight boxes that they may meet.
// ray_walk.cpp includes this file once for each level of vector instructions, inside that level's
// namespace.
// Paper: Reshetov, Soupikov, Hurley, "Multi-level ray tracing algorithm", SIGGRAPH 2005 (intervals of
//        origins and inverse directions stand for the rays at a box).

// What is met with a box by any of the rays: bounds on their numbers. Differences and products round
// the same way as their operands order, so that no box is lost that one of the rays meets alone.
struct Interval {
  std::array<float, 3> near_origin, far_origin, least_inverse, most_inverse;
  std::array<std::size_t, 3> near, far;
};

// The least and the greatest of the block's numbers.
struct Extremes {
  float least, most;
};
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Extremes extremes(const RayBlock::Each<float>& of) {
  return {Floats::reduce_min16(of.data()), Floats::reduce_max16(of.data())};
}

// How far rays may be apart, in the frame where they begin, and in slope, to be worth a walk together.
constexpr float most_spread = 0.25F;

// Returns false if the rays are not worth it. Lanes behind the last ray have its numbers.
TOUCHSTONE_TARGET inline bool bound(const RayMesh& mesh, const RayBlock& block,
                                    Interval& interval) {
  const unsigned every = (1U << block.count) - 1;
  if (block.count < RayBlock::most / 2 || block.usable != every) return false;
  for (const unsigned backward : block.backward) {
    if (backward != 0 && (backward & every) != every) return false;
  }
  for (std::size_t i = 1; i < block.count; ++i) {
    if (block.greatest[i] != block.greatest[0]) return false;
  }
  const Extremes x = extremes(block.shear_x), y = extremes(block.shear_y);
  float spread = std::max(x.most - x.least, y.most - y.least);
  for (const auto& origin : block.origin) {
    const Extremes of = extremes(origin);
    spread = std::max(spread, of.most - of.least);
  }
  if (!(spread <= most_spread)) return false;
  // Leaves whose floats are rounded have corners that are off by that.
  const float margin = mesh.is_exact() ? 0 : 2 * static_cast<float>(float_unit);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool backward = block.backward[k] != 0;
    const Extremes near = extremes(block.near_origin[k]), far = extremes(block.far_origin[k]);
    const Extremes inverse = extremes(block.inverse[k]);
    interval.near_origin[k] = backward ? near.least - margin : near.most + margin;
    interval.far_origin[k] = backward ? far.most + margin : far.least - margin;
    interval.least_inverse[k] = inverse.least;
    interval.most_inverse[k] = inverse.most;
    interval.near[k] = backward ? 1 : 0;
    interval.far[k] = backward ? 0 : 1;
  }
  return true;
}

// Eight boxes: the lower ends on the axes, and the upper ones.
struct Boxes {
  Vector ends[2][3];
};

// The boxes that the rays may meet before tau_end, as bits; `begin` gets where at the soonest.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned meet(const Boxes& boxes, const Interval& rays,
                                                  float tau_end, Vector& begin) {
  Vector first = all(0), last = all(tau_end);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector least = all(rays.least_inverse[k]), most = all(rays.most_inverse[k]);
    const Vector near = boxes.ends[rays.near[k]][k] - all(rays.near_origin[k]);
    const Vector far = boxes.ends[rays.far[k]][k] - all(rays.far_origin[k]);
    first = Lanes::max(Lanes::min(near * least, near * most), first);
    last = Lanes::min(Lanes::max(far * least, far * most), last);
  }
  begin = first;
  return Lanes::to_bits(
      Lanes::less_equal(first, last * all(1 + 16 * static_cast<float>(float_unit))));
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load(const WideNode& node, std::size_t part,
                                              Boxes& boxes) {
  for (std::size_t k = 0; k < 3; ++k) {
    boxes.ends[0][k] = Lanes::load(&node.planes[k][part]);
    boxes.ends[1][k] = Lanes::load(&node.planes[k + 3][part]);
  }
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load(const Leaf& leaf, std::size_t part, Boxes& boxes) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector a = Lanes::load(&leaf.corners[k][part]);
    const Vector b = Lanes::load(&leaf.corners[3 + k][part]);
    const Vector c = Lanes::load(&leaf.corners[6 + k][part]);
    boxes.ends[0][k] = Lanes::min(Lanes::min(a, b), c);
    boxes.ends[1][k] = Lanes::max(Lanes::max(a, b), c);
  }
}
