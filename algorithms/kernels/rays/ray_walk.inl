// The walk of one ray through the tree. ray_walk.cpp includes this file once for each level of vector
// instructions, inside that level's namespace. A node and a leaf have eight lanes, so the widest level
// uses half of its lanes.

#if defined(__x86_64__)
using Lanes = std::conditional_t<(Simd<float>::width > 8), simd::avx2::Simd<float>, Simd<float>>;
#else
using Lanes = Simd<float>;
#endif
using Vector = Lanes::Vector;

// Lanes [part, part + width) of the eight.
constexpr std::size_t width = Lanes::width;

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector all(float x) { return Lanes::broadcast(x); }

// What a node's boxes are met with.
struct Slabs {
  Vector near_x, near_y, near_z, far_x, far_y, far_z;  // origins of near and far planes
  Vector inverse_x, inverse_y, inverse_z;
  std::array<std::size_t, 3> near, far;  // which of a node's planes is met first on each axis

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Slabs(const RayBlock& block, std::size_t ray)
      : near_x(all(block.near_origin[0][ray])),
        near_y(all(block.near_origin[1][ray])),
        near_z(all(block.near_origin[2][ray])),
        far_x(all(block.far_origin[0][ray])),
        far_y(all(block.far_origin[1][ray])),
        far_z(all(block.far_origin[2][ray])),
        inverse_x(all(block.inverse[0][ray])),
        inverse_y(all(block.inverse[1][ray])),
        inverse_z(all(block.inverse[2][ray])) {
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = k + 3 * std::size_t{block.backward[k] >> ray & 1};
      far[k] = 2 * k + 3 - near[k];
    }
  }

  // The children that the ray meets before tau_end, as bits; `begin` gets where.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned meet(const WideNode& node, float tau_end,
                                                    Vector* begin) const {
    // Both ends have four roundings (two of the inverse), so that they change places by less than
    // nine units.
    const Vector more = all(1 + 16 * static_cast<float>(float_unit));
    const auto& planes = node.planes;
    unsigned bits = 0;
    for (std::size_t part = 0; part < 8; part += width) {
      const Vector begin_x = (Lanes::load(&planes[near[0]][part]) - near_x) * inverse_x;
      const Vector begin_y = (Lanes::load(&planes[near[1]][part]) - near_y) * inverse_y;
      const Vector begin_z = (Lanes::load(&planes[near[2]][part]) - near_z) * inverse_z;
      const Vector end_x = (Lanes::load(&planes[far[0]][part]) - far_x) * inverse_x;
      const Vector end_y = (Lanes::load(&planes[far[1]][part]) - far_y) * inverse_y;
      const Vector end_z = (Lanes::load(&planes[far[2]][part]) - far_z) * inverse_z;
      const Vector first = Lanes::max(begin_x, Lanes::max(begin_y, Lanes::max(begin_z, all(0))));
      const Vector last = Lanes::min(end_x, Lanes::min(end_y, Lanes::min(end_z, all(tau_end))));
      begin[part / width] = first;
      bits |= Lanes::to_bits(Lanes::less_equal(first, last * more)) << part;
    }
    return bits;
  }
};

// What a leaf's eight triangles are sheared with.
struct Shear {
  std::array<std::size_t, 3> axes;
  Vector origin[3], x, y, sign, off, tau_off;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Shear(const RayBlock& block, std::size_t ray)
      : axes(block.axes(ray)),
        origin{all(block.origin[0][ray]), all(block.origin[1][ray]), all(block.origin[2][ray])},
        x(all(block.shear_x[ray])),
        y(all(block.shear_y[ray])),
        sign(all(block.sign_z[ray])),
        off(all(block.off[ray])),
        tau_off(all(block.tau_off[ray])) {}
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
  const Vector zero = all(0);
  for (std::size_t part = 0; part < 8; part += width) {
    Vector x[3], y[3], tau[3], side[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector z =
          Lanes::load(&leaf.corners[3 * k + ray.axes[2]][part]) - ray.origin[2];
      tau[k] = z * ray.sign;
      x[k] = Lanes::load(&leaf.corners[3 * k + ray.axes[0]][part]) - ray.origin[0] - ray.x * tau[k];
      y[k] = Lanes::load(&leaf.corners[3 * k + ray.axes[1]][part]) - ray.origin[1] - ray.y * tau[k];
      side[k] = Lanes::abs(x[k]) + Lanes::abs(y[k]);
    }
    const Vector a = x[2] * y[1] - y[2] * x[1];
    const Vector b = x[0] * y[2] - y[0] * x[2];
    const Vector c = x[1] * y[0] - y[1] * x[0];
    // As in RayQuery: the errors of the coordinates, and the roundings of the weights and of this.
    const Vector reach = Lanes::max(Lanes::max(side[0], side[1]), side[2]);
    const Vector error = all(2.02F) * ray.off * (reach + ray.off) +
                         all(4 * static_cast<float>(float_unit)) * reach * reach + all(0x1p-120F);
    const Vector least = Lanes::min(Lanes::min(a, b), c);
    const Vector most = Lanes::max(Lanes::max(a, b), c);
    const Vector nearest = Lanes::min(Lanes::min(tau[0], tau[1]), tau[2]);
    const Vector furthest = Lanes::max(Lanes::max(tau[0], tau[1]), tau[2]);
    const unsigned missed =
        Lanes::to_bits(Lanes::less(least + error, zero)) & Lanes::to_bits(Lanes::less(error, most));
    const unsigned within = Lanes::to_bits(Lanes::less_equal(nearest, all(tau_end) + ray.tau_off)) &
                            Lanes::to_bits(Lanes::less_equal(zero - ray.tau_off, furthest));
    const unsigned possible = within & ~missed;
    if (possible == 0) continue;
    hits.possible |= possible << part;
    const unsigned certain =
        possible & (Lanes::to_bits(Lanes::less(error, least)) |
                    Lanes::to_bits(Lanes::less(most, zero - error)));
    hits.certain |= certain << part;
    // The weights' errors move the mean of the vertices' tau by at most their part of its spread, as
    // in RayQuery; the mean itself has up to eight roundings.
    const Vector sum = Lanes::abs(a + b + c);
    const Vector mean = (a * tau[0] + b * tau[1] + c * tau[2]) / (a + b + c);
    const Vector far = Lanes::max(Lanes::abs(nearest), Lanes::abs(furthest));
    const Vector tau_error = all(3.05F) * error * (furthest - nearest) / sum +
                             all(10 * static_cast<float>(float_unit)) * far + ray.tau_off;
    Lanes::store(&hits.first[part], mean - tau_error);
    Lanes::store(&hits.last[part], mean + tau_error);
  }
}

// Writes the keys of the children that are met but for the nearest, from far to near, and returns that one.
// `to` has room for eight. One child is taken without a look at where it is met, since what comes next
// would wait for that.
template <class Near>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE std::int32_t push(unsigned bits, const WideNode& node,
                                                      const Near* begin, std::uint64_t* to) {
  const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
  unsigned others = bits & (bits - 1);
  if (others == 0) return node.child[lane];
  alignas(32) std::array<float, 8> near;
  for (std::size_t part = 0; part < 8; part += width) {
    Lanes::store(&near[part], begin[part / width]);
  }
  const auto next = static_cast<std::size_t>(std::countr_zero(others));
  if ((others & (others - 1)) == 0) {
    const std::uint64_t one = key_of(node.child[lane], near[lane]);
    const std::uint64_t other = key_of(node.child[next], near[next]);
    to[0] = std::max(one, other);
    return one < other ? node.child[lane] : node.child[next];
  }
#if defined(__x86_64__)
  if constexpr (Simd<float>::width > 8 && sizeof(Near) == 32) {
    return child_of(push_sorted(bits, node.child.data(), begin[0], to));
  }
#endif
  std::size_t count = 0;
  for (; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    const std::uint64_t key = key_of(node.child[k], near[k]);
    std::size_t at = count++;
    for (; at > 0 && to[at - 1] < key; --at) to[at] = to[at - 1];
    to[at] = key;
  }
  return child_of(to[count - 1]);
}

// Calls visit(leaf number, tau_end) for the leaves from `start` on that the ray meets, about from near to
// far; it may lower tau_end, and returns true to end the walk.
template <class Visitor>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void walk(const RayMesh& mesh, const RayBlock& block,
                                              std::size_t ray, std::int32_t start,
                                              float& tau_end, Visitor& visitor) {
  const WideNode* const nodes = mesh.tree().nodes.data();
  const Slabs slabs(block, ray);
  std::array<std::uint64_t, WideBvh::most_open + WideNode::fan> stack;
  std::size_t open = 0;
  std::int32_t now = start;
  Vector near[8 / width];
  for (;;) {
    if (WideNode::is_leaf(now)) {
      if (visitor.visit(WideNode::leaf(now), tau_end)) return;
    } else {
      // Lanes without a child have empty boxes, which no ray meets.
      const WideNode& node = nodes[now];
      const unsigned bits = slabs.meet(node, tau_end, near);
      if (bits != 0) {
        // The nearest is next, and the others are on the stack, the nearer the higher.
        now = push(bits, node, near, &stack[open]);
        open += static_cast<std::size_t>(std::popcount(bits)) - 1;
        continue;
      }
    }
    std::uint64_t top;
    do {
      if (open == 0) return;
      top = stack[--open];
    } while (near_of(top) > tau_end);
    now = child_of(top);
  }
}

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
      if (doubt.offer(found, {number, static_cast<std::uint32_t>(lane)}, task, tau_end)) return true;
    }
    return false;
  }
};

// Offers a query every triangle that the ray may hit.
template <class Query>
struct OfferingVisitor {
  const RayMesh& mesh;
  Query& query;
  Shear shear;
  LeafHits hits;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE OfferingVisitor(const RayMesh& m, const RayBlock& block, std::size_t ray, Query& q)
      : mesh(m), query(q), shear(block, ray) {}

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool visit(std::uint32_t number, float& tau_end) {
    const Leaf& leaf = mesh.leaves()[number];
    meet(leaf, shear, tau_end, hits);
    for (unsigned bits = hits.possible; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const auto [a, b, c] = mesh.corners(leaf, lane);
      if (query.offer(leaf.triangle[lane], a, b, c)) return true;
    }
    return false;
  }
};
