// The loops of walk.h. walk.cpp includes this file once for each level of vector instructions,
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

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector axis_near(const WideNode& node, const LocalRay& ray,
                                                     std::size_t axis, std::size_t part) {
  return (Lanes::load(&node.planes[ray.near[axis]][part]) -
          Lanes::broadcast(ray.near_origin[axis])) *
         Lanes::broadcast(ray.inverse[axis]);
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector axis_far(const WideNode& node, const LocalRay& ray,
                                                    std::size_t axis, std::size_t part) {
  return (Lanes::load(&node.planes[ray.far[axis]][part]) -
          Lanes::broadcast(ray.far_origin[axis])) *
         Lanes::broadcast(ray.inverse[axis]);
}

// The children that the ray meets before tau_end, as bits; `near` gets where. A NaN, of a plane at
// the origin of a ray along it, is the first operand of min and max, which then give the second.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned meet(const WideNode& node, const LocalRay& ray,
                                                  float tau_end, float* near) {
  // Both ends have three roundings, so that an end that is met before its beginning is met after it
  // by less than eight units.
  const Vector more = Lanes::broadcast(1 + 16 * static_cast<float>(float_unit));
  unsigned bits = 0;
  for (std::size_t part = 0; part < 8; part += width) {
    Vector begin = Lanes::broadcast(0), end = Lanes::broadcast(tau_end);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      begin = Lanes::max(axis_near(node, ray, axis, part), begin);
      end = Lanes::min(axis_far(node, ray, axis, part), end);
    }
    Lanes::store(near + part, begin);
    bits |= Lanes::to_bits(Lanes::less_equal(begin, end * more)) << part;
  }
  return bits;
}

// Vertex k of each triangle from the ray's origin, on one of the ray's axes.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector seen(const Leaf& leaf, const LocalRay& ray,
                                                std::size_t k, std::size_t axis,
                                                std::size_t part) {
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

TOUCHSTONE_TARGET void walk_tree(const RayMesh& mesh, const LocalRay& ray, RayTask task,
                                 RayQuery& query) {
  const WideNode* const nodes = mesh.tree().nodes.data();
  std::array<Met, WideBvh::most_open> stack;
  std::size_t open = 1;
  stack[0] = {0, 0};
  float tau_end = ray.tau_end(query.t_end());
  alignas(64) float near[8];
  while (open > 0) {
    const Met now = stack[--open];
    if (now.near > tau_end) continue;
    if (WideNode::is_leaf(now.child)) {
      const Leaf& leaf = mesh.leaves()[WideNode::leaf(now.child)];
      for (unsigned bits = possible_hits(leaf, ray, tau_end); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        const auto [a, b, c] = mesh.corners(leaf, lane);
        if (!query.offer(leaf.triangle[lane], a, b, c)) continue;
        if (task == RayTask::any) return;
        tau_end = ray.tau_end(query.t_end());
      }
      continue;
    }
    const WideNode& node = nodes[now.child];
    const std::size_t first = open;
    for (unsigned bits = meet(node, ray, tau_end, near); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const Met met = {node.child[lane], near[lane]};
      if (met.child == WideNode::no_child) break;
      // The nearest ends on top.
      std::size_t at = open++;
      for (; at > first && stack[at - 1].near < met.near; --at) stack[at] = stack[at - 1];
      stack[at] = met;
    }
  }
}
