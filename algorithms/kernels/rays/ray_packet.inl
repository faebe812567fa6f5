// The walk of a block of rays that go about the same way, together. ray_walk.cpp includes this file once
// for each level of vector instructions, inside that level's namespace.

// What the rays have found. tau_end is -1 for a ray that is done.
struct alignas(64) PacketHits {
  RayBlock::Each<float> first, last, tau_end;
  unsigned active = 0;
  unsigned doubtful = 0;  // the rays for which floats do not tell, as bits
  float last_end = 0;     // the greatest tau_end
};

// Tests one triangle against all rays. It is `meet` of a leaf, with rays in the lanes.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void meet_all(const RayBlock& block,
                                                  const std::array<float, 9>& corners,
                                                  FoundHit triangle, unsigned rays, RayTask task,
                                                  std::span<FoundHit> found, PacketHits& hits) {
  const Narrow zero = Floats::broadcast(0);
  for (std::size_t part = 0; part < RayBlock::most; part += Floats::width) {
    const Narrow sign = Floats::load(&block.sign_z[part]);
    const Narrow off = Floats::load(&block.off[part]);
    const Narrow tau_off = Floats::load(&block.tau_off[part]);
    Narrow x[3], y[3], tau[3], side[3];
    for (std::size_t k = 0; k < 3; ++k) {
      tau[k] =
          (Floats::broadcast(corners[3 * k + 2]) - Floats::load(&block.origin[2][part])) * sign;
      x[k] = Floats::broadcast(corners[3 * k]) - Floats::load(&block.origin[0][part]) -
             Floats::load(&block.shear_x[part]) * tau[k];
      y[k] = Floats::broadcast(corners[3 * k + 1]) - Floats::load(&block.origin[1][part]) -
             Floats::load(&block.shear_y[part]) * tau[k];
      side[k] = Floats::abs(x[k]) + Floats::abs(y[k]);
    }
    const Narrow a = x[2] * y[1] - y[2] * x[1];
    const Narrow b = x[0] * y[2] - y[0] * x[2];
    const Narrow c = x[1] * y[0] - y[1] * x[0];
    const Narrow reach = Floats::max(Floats::max(side[0], side[1]), side[2]);
    const Narrow error = Floats::broadcast(2.02F) * off * (reach + off) +
                         Floats::broadcast(4 * static_cast<float>(float_unit)) * reach * reach +
                         Floats::broadcast(0x1p-120F);
    const Narrow least = Floats::min(Floats::min(a, b), c);
    const Narrow most = Floats::max(Floats::max(a, b), c);
    const unsigned missed = Floats::to_bits(Floats::less(least + error, zero)) &
                            Floats::to_bits(Floats::less(error, most));
    unsigned possible = ~missed & (rays & hits.active) >> part & ((1U << Floats::width) - 1);
    if (possible == 0) continue;
    const Narrow nearest = Floats::min(Floats::min(tau[0], tau[1]), tau[2]);
    const Narrow furthest = Floats::max(Floats::max(tau[0], tau[1]), tau[2]);
    const Narrow end = Floats::load(&hits.tau_end[part]);
    possible &= Floats::to_bits(Floats::less_equal(nearest, end + tau_off)) &
                Floats::to_bits(Floats::less_equal(zero - tau_off, furthest));
    if (possible == 0) continue;
    const Narrow sum = a + b + c;
    const Narrow mean = (a * tau[0] + b * tau[1] + c * tau[2]) / sum;
    const Narrow tau_error =
        Floats::broadcast(3.05F) * error * (furthest - nearest) / Floats::abs(sum) +
        Floats::broadcast(10 * static_cast<float>(float_unit)) *
            Floats::max(Floats::abs(nearest), Floats::abs(furthest)) +
        tau_off;
    const Narrow first = mean - tau_error, last = mean + tau_error;
    const unsigned certain =
        possible &
        (Floats::to_bits(Floats::less(error, least)) |
         Floats::to_bits(Floats::less(most, zero - error))) &
        Floats::to_bits(Floats::less(Floats::load(&block.sure_begin[part]), first)) &
        Floats::to_bits(Floats::less(last, Floats::load(&block.sure_end[part])));
    const Narrow old_first = Floats::load(&hits.first[part]),
                 old_last = Floats::load(&hits.last[part]);
    const unsigned better = certain & Floats::to_bits(Floats::less(last, old_first));
    const unsigned beaten = certain & Floats::to_bits(Floats::less(old_last, first));
    const unsigned doubtful = possible & ~better & ~beaten;
    const auto mask = Floats::from_bits(better);
    Floats::store(&hits.first[part], Floats::select(mask, first, old_first));
    Floats::store(&hits.last[part], Floats::select(mask, last, old_last));
    const unsigned done = doubtful | (task == RayTask::any ? better : 0);
    // A box's near end has four roundings.
    const Narrow lower = last * Floats::broadcast(1 + 16 * static_cast<float>(float_unit));
    const Narrow now = Floats::select(mask, Floats::min(lower, end), end);
    Floats::store(&hits.tau_end[part],
                  Floats::select(Floats::from_bits(done), Floats::broadcast(-1), now));
    hits.active &= ~(done << part);
    hits.doubtful |= doubtful << part;
    for (unsigned bits = better; bits != 0; bits &= bits - 1) {
      found[part + static_cast<std::size_t>(std::countr_zero(bits))] = triangle;
    }
  }
}

// Those of the rays that meet a node's child before their tau_end, as bits.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned rays_at(const WideNode& node, std::size_t lane,
                                                     const RayBlock& block, const Interval& way,
                                                     const PacketHits& hits) {
  unsigned bits = 0;
  for (std::size_t part = 0; part < RayBlock::most; part += Floats::width) {
    Narrow first = Floats::broadcast(0), last = Floats::load(&hits.tau_end[part]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Narrow inverse = Floats::load(&block.inverse[k][part]);
      const Narrow near = Floats::broadcast(node.planes[k + 3 * way.near[k]][lane]);
      const Narrow far = Floats::broadcast(node.planes[k + 3 * way.far[k]][lane]);
      first = Floats::max((near - Floats::load(&block.near_origin[k][part])) * inverse, first);
      last = Floats::min((far - Floats::load(&block.far_origin[k][part])) * inverse, last);
    }
    const Narrow more = Floats::broadcast(1 + 16 * static_cast<float>(float_unit));
    bits |= Floats::to_bits(Floats::less_equal(first, last * more)) << part;
  }
  return bits;
}

// One ray of the block for which floats do not tell.
struct Doubt {
  bool is_raised = false;
  bool offer(const FoundHit&, const FoundHit&, RayTask, float&) {
    is_raised = true;
    return true;
  }
};

// A child on the stack, with the rays that meet it.
struct PacketMet {
  float near;
  std::int32_t child;
  unsigned rays;
};

// The walk of a block.
struct PacketWalk {
  const RayMesh& mesh;
  const RayBlock& block;
  const Interval& way;
  const RayTask task;
  std::span<FoundHit> found;
  PacketHits& hits;

  // A ray by itself from a child on.
  TOUCHSTONE_TARGET void walk_alone(std::size_t ray, std::int32_t child) const {
    Doubt doubt;
    Walk<HitVisitor<Doubt>> alone(mesh, block, ray, child, hits.tau_end[ray], task, found[ray],
                                  doubt);
    alone.visitor.first = hits.first[ray];
    alone.visitor.last = hits.last[ray];
    const FoundHit before = found[ray];
    while (alone.step()) {
    }
    hits.tau_end[ray] = alone.tau_end;
    hits.first[ray] = alone.visitor.first;
    hits.last[ray] = alone.visitor.last;
    const bool is_done = task == RayTask::any && found[ray] != before;
    if (doubt.is_raised) hits.doubtful |= 1U << ray;
    if (doubt.is_raised || is_done) {
      hits.tau_end[ray] = -1;
      hits.active &= ~(1U << ray);
    }
  }

  TOUCHSTONE_TARGET void visit(std::uint32_t number, unsigned rays) const {
    const Leaf& leaf = mesh.leaves()[number];
    unsigned triangles = 0;
    Boxes boxes;
    Vector begin;
    for (std::size_t part = 0; part < 8; part += width) {
      load(leaf, part, boxes);
      triangles |= meet(boxes, way, hits.last_end, begin) << part;
    }
    if (std::popcount(rays) < std::popcount(triangles)) {
      for (; rays != 0; rays &= rays - 1) {
        walk_alone(static_cast<std::size_t>(std::countr_zero(rays)),
                   -1 - static_cast<std::int32_t>(number));
      }
      return;
    }
    const auto axes = block.axes(0);
    for (; triangles != 0; triangles &= triangles - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(triangles));
      std::array<float, 9> corners;
      for (std::size_t k = 0; k < 9; ++k) corners[k] = leaf.corners[k / 3 * 3 + axes[k % 3]][lane];
      meet_all(block, corners, {number, static_cast<std::uint32_t>(lane)}, rays, task, found, hits);
    }
  }

  // Pushes the children that rays meet, the nearest last.
  TOUCHSTONE_TARGET void open_node(const WideNode& node, unsigned rays, PacketMet* stack,
                                   std::size_t& open) const {
    alignas(32) std::array<float, 8> near;
    Boxes boxes;
    unsigned bits = 0;
    for (std::size_t part = 0; part < 8; part += width) {
      Vector begin;
      load(node, part, boxes);
      bits |= meet(boxes, way, hits.last_end, begin) << part;
      Lanes::store(&near[part], begin);
    }
    const std::size_t first = open;
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const unsigned at = rays_at(node, lane, block, way, hits) & rays & hits.active;
      if (at == 0) continue;
      std::size_t place = open++;
      for (; place > first && stack[place - 1].near < near[lane]; --place) {
        stack[place] = stack[place - 1];
      }
      stack[place] = {near[lane], node.child[lane], at};
    }
  }
};

// So few rays go on each by itself.
constexpr int few_rays = 3;

// Finds the hits of all rays. What is found of those that it leaves in doubt does not count.
TOUCHSTONE_TARGET inline void walk_packet(const RayMesh& mesh, const RayBlock& block,
                                          const Interval& way, RayTask task,
                                          std::span<FoundHit> found, PacketHits& hits) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  hits.first.fill(inf);
  hits.last.fill(inf);
  hits.active = (1U << block.count) - 1;
  for (std::size_t i = 0; i < RayBlock::most; ++i) {
    hits.tau_end[i] = i < block.count ? block.tau_end[i] : -1;
  }
  hits.last_end = Floats::reduce_max16(hits.tau_end.data());
  const PacketWalk packet{mesh, block, way, task, found, hits};
  std::array<PacketMet, WideBvh::most_open> stack;
  std::size_t open = 1;
  stack[0] = {0, 0, hits.active};
  while (open > 0) {
    const PacketMet now = stack[--open];
    unsigned rays = now.rays & hits.active;
    if (now.near > hits.last_end || rays == 0) continue;
    if (std::popcount(rays) <= few_rays) {
      for (; rays != 0; rays &= rays - 1) {
        packet.walk_alone(static_cast<std::size_t>(std::countr_zero(rays)), now.child);
      }
    } else if (WideNode::is_leaf(now.child)) {
      packet.visit(WideNode::leaf(now.child), rays);
    } else {
      packet.open_node(mesh.tree().nodes[static_cast<std::size_t>(now.child)], rays, stack.data(),
                       open);
      continue;
    }
    if (hits.active == 0) return;
    hits.last_end = Floats::reduce_max16(hits.tau_end.data());
  }
}
