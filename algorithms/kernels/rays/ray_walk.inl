// The walk of one ray through the tree. ray_walk.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.

// A ray at a node's boxes.
struct Slabs {
  const RayBlock& block;
  const std::size_t ray;
  std::array<std::size_t, 3> near, far;  // which of a node's planes is met first on each axis

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Slabs(const RayBlock& b, std::size_t r) : block(b), ray(r) {
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = k + 3 * std::size_t{block.backward[k] >> ray & 1};
      far[k] = 2 * k + 3 - near[k];
    }
  }

  // The times at which the ray meets planes on an axis.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector at(const WideNode& node, std::size_t plane,
                                                const RayBlock::Each<float>& origin,
                                                std::size_t axis, std::size_t part) const {
    return (Lanes::load(&node.planes[plane][part]) - all(origin[ray])) *
           all(block.inverse[axis][ray]);
  }

  // The children that the ray meets before tau_end, as bits; `begin` gets where.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned meet(const WideNode& node, float tau_end,
                                                    Vector* begin) const {
    // Both ends have four roundings (two of the inverse), so that they change places by less than
    // nine units.
    const Vector more = all(1 + 16 * static_cast<float>(float_unit));
    unsigned bits = 0;
    for (std::size_t part = 0; part < 8; part += width) {
      Vector first = all(0), last = all(tau_end);
      for (std::size_t k = 0; k < 3; ++k) {
        first = Lanes::max(at(node, near[k], block.near_origin[k], k, part), first);
        last = Lanes::min(at(node, far[k], block.far_origin[k], k, part), last);
      }
      begin[part / width] = first;
      bits |= Lanes::to_bits(Lanes::less_equal(first, last * more)) << part;
    }
    return bits;
  }
};

// A ray at a leaf's triangles.
struct Shear {
  const RayBlock& block;
  const std::size_t ray;
  const std::array<std::size_t, 3> axes;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Shear(const RayBlock& b, std::size_t r)
      : block(b), ray(r), axes(b.axes(r)) {}

  // A vertex of each triangle from the ray's origin, on one of the ray's axes.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector seen(const Leaf& leaf, std::size_t vertex,
                                                  std::size_t axis, std::size_t part) const {
    return Lanes::load(&leaf.corners[3 * vertex + axes[axis]][part]) - all(block.origin[axis][ray]);
  }
};

// The triangles of a leaf that a ray may hit before tau_end, and those of them whose inside it meets for
// certain, as bits; for the latter, tau is from first to last.
struct LeafHits {
  unsigned possible = 0, certain = 0;
  alignas(32) std::array<float, 8> first, last;
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void meet(const Leaf& leaf, const Shear& ray, float tau_end,
                                              LeafHits& hits) {
  hits.possible = hits.certain = 0;
  const Vector zero = all(0), sign = all(ray.block.sign_z[ray.ray]);
  const Vector shear_x = all(ray.block.shear_x[ray.ray]), shear_y = all(ray.block.shear_y[ray.ray]);
  const Vector off = all(ray.block.off[ray.ray]), tau_off = all(ray.block.tau_off[ray.ray]);
  for (std::size_t part = 0; part < 8; part += width) {
    Vector x[3], y[3], tau[3], side[3];
    for (std::size_t k = 0; k < 3; ++k) {
      tau[k] = ray.seen(leaf, k, 2, part) * sign;
      x[k] = ray.seen(leaf, k, 0, part) - shear_x * tau[k];
      y[k] = ray.seen(leaf, k, 1, part) - shear_y * tau[k];
      side[k] = Lanes::abs(x[k]) + Lanes::abs(y[k]);
    }
    const Vector a = x[2] * y[1] - y[2] * x[1];
    const Vector b = x[0] * y[2] - y[0] * x[2];
    const Vector c = x[1] * y[0] - y[1] * x[0];
    // As in RayQuery: the errors of the coordinates, and the roundings of the weights and of this.
    const Vector reach = Lanes::max(Lanes::max(side[0], side[1]), side[2]);
    const Vector error = all(2.02F) * off * (reach + off) +
                         all(4 * static_cast<float>(float_unit)) * reach * reach + all(0x1p-120F);
    const Vector least = Lanes::min(Lanes::min(a, b), c);
    const Vector most = Lanes::max(Lanes::max(a, b), c);
    const Vector nearest = Lanes::min(Lanes::min(tau[0], tau[1]), tau[2]);
    const Vector furthest = Lanes::max(Lanes::max(tau[0], tau[1]), tau[2]);
    const unsigned missed =
        Lanes::to_bits(Lanes::less(least + error, zero)) & Lanes::to_bits(Lanes::less(error, most));
    const unsigned within = Lanes::to_bits(Lanes::less_equal(nearest, all(tau_end) + tau_off)) &
                            Lanes::to_bits(Lanes::less_equal(zero - tau_off, furthest));
    const unsigned possible = within & ~missed;
    if (possible == 0) continue;
    hits.possible |= possible << part;
    const unsigned certain = possible & (Lanes::to_bits(Lanes::less(error, least)) |
                                         Lanes::to_bits(Lanes::less(most, zero - error)));
    hits.certain |= certain << part;
    // The weights' errors move the mean of the vertices' tau by at most their part of its spread, as
    // in RayQuery; the mean itself has up to eight roundings.
    const Vector sum = Lanes::abs(a + b + c);
    const Vector mean = (a * tau[0] + b * tau[1] + c * tau[2]) / (a + b + c);
    const Vector far = Lanes::max(Lanes::abs(nearest), Lanes::abs(furthest));
    const Vector tau_error = all(3.05F) * error * (furthest - nearest) / sum +
                             all(10 * static_cast<float>(float_unit)) * far + tau_off;
    Lanes::store(&hits.first[part], mean - tau_error);
    Lanes::store(&hits.last[part], mean + tau_error);
  }
}

// The walk of a ray from a child on. It calls visit(leaf number, tau_end) for the leaves that the ray meets,
// about from near to far; the visitor may lower tau_end, and returns true to end the walk.
template <class Visitor>
struct Walk {
  const WideNode* const nodes;
  const Slabs slabs;
  Visitor visitor;
  float tau_end;
  std::int32_t now;
  std::size_t open = 0;
  std::array<std::uint64_t, WideBvh::most_open + WideNode::fan> stack;

  template <class... Arguments>
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Walk(const RayMesh& mesh, const RayBlock& block,
                                           std::size_t ray, std::int32_t start, float end,
                                           Arguments&&... arguments)
      : nodes(mesh.tree().nodes.data()),
        slabs(block, ray),
        visitor(mesh, block, ray, arguments...),
        tau_end(end),
        now(start) {}

  // One node or leaf. Returns false at the walk's end.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool step() {
    if (WideNode::is_leaf(now)) {
      if (visitor.visit(WideNode::leaf(now), tau_end)) return false;
    } else {
      // Lanes without a child have empty boxes, which no ray meets.
      const WideNode& node = nodes[now];
      Vector begin[8 / width];
      const unsigned bits = slabs.meet(node, tau_end, begin);
      if (bits != 0) {
        // The nearest is next, and the others are on the stack, the nearer the higher.
        now = push(bits, node, begin, &stack[open]);
        open += static_cast<std::size_t>(std::popcount(bits)) - 1;
        return true;
      }
    }
    std::uint64_t top;
    do {
      if (open == 0) return false;
      top = stack[--open];
    } while (near_of(top) > tau_end);
    now = child_of(top);
    return true;
  }
};

// The first hit of a ray, or any. A hit that is certain in floats stays, without a look in doubles, until
// another is before it for certain. Where floats do not tell, `doubt` does.
template <class Doubt>
struct HitVisitor {
  const RayMesh& mesh;
  const RayBlock& block;
  const std::size_t ray;
  const RayTask task;
  FoundHit& found;
  Doubt& doubt;
  Shear shear;
  LeafHits hits;
  float first, last;  // the tau of what was found

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE HitVisitor(const RayMesh& m, const RayBlock& b, std::size_t r,
                                                 RayTask t, FoundHit& f, Doubt& d)
      : mesh(m), block(b), ray(r), task(t), found(f), doubt(d), shear(b, r), first(0), last(0) {}

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool visit(std::uint32_t number, float& tau_end) {
    const Leaf& leaf = mesh.leaves()[number];
    meet(leaf, shear, tau_end, hits);
    for (unsigned bits = hits.possible; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if ((hits.certain >> lane & 1) != 0 && hits.first[lane] > block.sure_begin[ray] &&
          hits.last[lane] < block.sure_end[ray]) {
        if (!found.is_found() || hits.last[lane] < first) {
          first = hits.first[lane];
          last = hits.last[lane];
          found = {number, static_cast<std::uint32_t>(lane)};
          if (task == RayTask::any) return true;
          // A box's near end has four roundings.
          tau_end = std::min(tau_end, last * (1 + 16 * static_cast<float>(float_unit)));
          continue;
        }
        if (hits.first[lane] > last) continue;
      }
      if (doubt.offer(found, {number, static_cast<std::uint32_t>(lane)}, task, tau_end))
        return true;
    }
    return false;
  }
};
