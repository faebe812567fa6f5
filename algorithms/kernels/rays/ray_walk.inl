// The loops of ray_walk.h. ray_walk.cpp includes this file once for each level of vector instructions,
// inside that level's namespace. A node and a leaf have eight lanes, so the widest level uses half
// of its lanes.

#if defined(__x86_64__)
using Lanes = std::conditional_t<(Simd<float>::width > 8), simd::avx2::Simd<float>, Simd<float>>;
#else
using Lanes = Simd<float>;
#endif
using Vector = Lanes::Vector;

// Lanes [part, part + width) of the eight.
constexpr std::size_t width = Lanes::width;

// What a node's boxes are met with.
struct Slabs {
  Vector near_x, near_y, near_z, far_x, far_y, far_z;  // origins of near and far planes
  Vector inverse_x, inverse_y, inverse_z;
  const LocalRay& ray;

  TOUCHSTONE_TARGET explicit Slabs(const LocalRay& r)
      : near_x(Lanes::broadcast(r.near_origin[0])),
        near_y(Lanes::broadcast(r.near_origin[1])),
        near_z(Lanes::broadcast(r.near_origin[2])),
        far_x(Lanes::broadcast(r.far_origin[0])),
        far_y(Lanes::broadcast(r.far_origin[1])),
        far_z(Lanes::broadcast(r.far_origin[2])),
        inverse_x(Lanes::broadcast(r.inverse[0])),
        inverse_y(Lanes::broadcast(r.inverse[1])),
        inverse_z(Lanes::broadcast(r.inverse[2])),
        ray(r) {}

  // The children that the ray meets before tau_end, as bits; `near` gets where. A NaN, of a plane at
  // the origin of a ray along it, is the first operand of min and max, which then give the second.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned meet(const WideNode& node, float tau_end,
                                                    float* near) const {
    // Both ends have four roundings (two of the inverse), so that they change places by less than
    // nine units.
    const Vector more = Lanes::broadcast(1 + 16 * static_cast<float>(float_unit));
    const auto& planes = node.planes;
    unsigned bits = 0;
    for (std::size_t part = 0; part < 8; part += width) {
      const Vector begin_x = (Lanes::load(&planes[ray.near[0]][part]) - near_x) * inverse_x;
      const Vector begin_y = (Lanes::load(&planes[ray.near[1]][part]) - near_y) * inverse_y;
      const Vector begin_z = (Lanes::load(&planes[ray.near[2]][part]) - near_z) * inverse_z;
      const Vector end_x = (Lanes::load(&planes[ray.far[0]][part]) - far_x) * inverse_x;
      const Vector end_y = (Lanes::load(&planes[ray.far[1]][part]) - far_y) * inverse_y;
      const Vector end_z = (Lanes::load(&planes[ray.far[2]][part]) - far_z) * inverse_z;
      const Vector begin =
          Lanes::max(begin_x, Lanes::max(begin_y, Lanes::max(begin_z, Lanes::broadcast(0))));
      const Vector end =
          Lanes::min(end_x, Lanes::min(end_y, Lanes::min(end_z, Lanes::broadcast(tau_end))));
      Lanes::store(near + part, begin);
      bits |= Lanes::to_bits(Lanes::less_equal(begin, end * more)) << part;
    }
    return bits;
  }
};

// Vertex k of each triangle from the ray's origin, on one of the ray's axes.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector seen(const Leaf& leaf, const LocalRay& ray,
                                                std::size_t k, std::size_t axis, std::size_t part) {
  return Lanes::load(&leaf.corners[3 * k + ray.axes[axis]][part]) -
         Lanes::broadcast(ray.origin[axis]);
}

// The triangles of a leaf that the ray may hit at tau = 0 to tau_end, as bits.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned possible_hits(const Leaf& leaf, const LocalRay& ray,
                                                           float tau_end) {
  const Vector shear_x = Lanes::broadcast(ray.shear_x), shear_y = Lanes::broadcast(ray.shear_y);
  const Vector inverse = Lanes::broadcast(ray.inverse_z);
  const Vector off = Lanes::broadcast(ray.off);
  unsigned bits = 0;
  for (std::size_t part = 0; part < 8; part += width) {
    Vector x[3], y[3], tau[3], side[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector z = seen(leaf, ray, k, 2, part);
      x[k] = seen(leaf, ray, k, 0, part) - shear_x * z;
      y[k] = seen(leaf, ray, k, 1, part) - shear_y * z;
      tau[k] = z * inverse;
      side[k] = Lanes::abs(x[k]) + Lanes::abs(y[k]);
    }
    const Vector a = x[2] * y[1] - y[2] * x[1];
    const Vector b = x[0] * y[2] - y[0] * x[2];
    const Vector c = x[1] * y[0] - y[1] * x[0];
    // As in RayQuery: the errors of the coordinates, and the roundings of the weights and of this.
    const Vector reach = Lanes::max(Lanes::max(side[0], side[1]), side[2]);
    const Vector error = Lanes::broadcast(2.02F) * off * (reach + off) +
                         Lanes::broadcast(4 * static_cast<float>(float_unit)) * reach * reach +
                         Lanes::broadcast(0x1p-120F);
    const Vector least = Lanes::min(Lanes::min(a, b), c);
    const Vector most = Lanes::max(Lanes::max(a, b), c);
    const Vector first = Lanes::min(Lanes::min(tau[0], tau[1]), tau[2]);
    const Vector last = Lanes::max(Lanes::max(tau[0], tau[1]), tau[2]);
    const Vector tau_off = Lanes::broadcast(ray.tau_off);
    const unsigned missed = Lanes::to_bits(Lanes::less(least + error, Lanes::broadcast(0))) &
                            Lanes::to_bits(Lanes::less(error, most));
    const unsigned within =
        Lanes::to_bits(Lanes::less_equal(first, Lanes::broadcast(tau_end) + tau_off)) &
        Lanes::to_bits(Lanes::less_equal(Lanes::broadcast(0) - tau_off, last));
    bits |= (within & ~missed) << part;
  }
  return bits;
}

template <class Query>
TOUCHSTONE_TARGET void walk_tree(const RayMesh& mesh, const LocalRay& ray, RayTask task,
                                 Query& query) {
  const WideNode* const nodes = mesh.tree().nodes.data();
  const Slabs slabs(ray);
  std::array<Met, WideBvh::most_open> stack;
  std::size_t open = 0;
  Met now = {0, 0};
  float tau_end = ray.tau_end(query.t_end());
  alignas(64) float near[8];
  for (;;) {
    if (WideNode::is_leaf(now.child)) {
      const Leaf& leaf = mesh.leaves()[WideNode::leaf(now.child)];
      for (unsigned bits = possible_hits(leaf, ray, tau_end); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        const auto [a, b, c] = mesh.corners(leaf, lane);
        if (!query.offer(leaf.triangle[lane], a, b, c)) continue;
        if (task == RayTask::any) return;
        tau_end = ray.tau_end(query.t_end());
      }
    } else {
      // Lanes without a child have empty boxes, which no ray meets.
      const WideNode& node = nodes[now.child];
      unsigned bits = slabs.meet(node, tau_end, near);
      if (bits != 0) {
        const auto met = [&] {
          const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
          bits &= bits - 1;
          return Met{node.child[lane], near[lane]};
        };
        now = met();
        // The nearest is next, and the others are on the stack, the nearer the higher.
        const std::size_t first = open;
        while (bits != 0) {
          Met other = met();
          if (other.near < now.near) std::swap(other, now);
          std::size_t at = open++;
          for (; at > first && stack[at - 1].near < other.near; --at) stack[at] = stack[at - 1];
          stack[at] = other;
        }
        continue;
      }
    }
    do {
      if (open == 0) return;
      now = stack[--open];
    } while (now.near > tau_end);
  }
}
