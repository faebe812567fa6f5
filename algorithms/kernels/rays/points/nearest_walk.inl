// The walk to the nearest triangle. nearest_walk.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.
#include "algorithms/kernels/rays/node_lanes.inl"

struct Across {
  Vector x, y, z;
};
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Across operator-(const Across& a, const Across& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector dot(const Across& a, const Across& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Across cross(const Across& a, const Across& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The children within the limit, as bits; `square` gets the squared distances of their boxes.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned near_children(const WideNode& node,
                                                           const std::array<float, 3>& at,
                                                           float limit, Vector* square) {
  unsigned bits = 0;
  for (std::size_t part = 0; part < 8; part += width) {
    Vector sum = all(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vector below = Lanes::load(&node.planes[axis][part]) - all(at[axis]);
      const Vector above = all(at[axis]) - Lanes::load(&node.planes[axis + 3][part]);
      const Vector away = Lanes::max(Lanes::max(below, above), all(0));
      sum = sum + away * away;
    }
    square[part / width] = sum;
    bits |= Lanes::to_bits(Lanes::less_equal(sum, all(limit * limit))) << part;
  }
  return bits;
}

// Some point of each triangle, about the nearest, as seen from the point that is asked.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Across about_nearest(const Across* seen) {
  const Vector zero = all(0), one = all(1);
  const Across edge[3] = {seen[1] - seen[0], seen[2] - seen[1], seen[0] - seen[2]};
  Across best = seen[0];
  Vector least = dot(best, best);
  for (std::size_t k = 0; k < 3; ++k) {
    // An edge without length has 0 / 0, for which `max` takes its second argument.
    const Vector along = (zero - dot(seen[k], edge[k])) / dot(edge[k], edge[k]);
    const Vector t = Lanes::min(Lanes::max(along, zero), one);
    const Across point = {seen[k].x + t * edge[k].x, seen[k].y + t * edge[k].y,
                          seen[k].z + t * edge[k].z};
    const Vector square = dot(point, point);
    const auto is_less = Lanes::less(square, least);
    best = {Lanes::select(is_less, point.x, best.x), Lanes::select(is_less, point.y, best.y),
            Lanes::select(is_less, point.z, best.z)};
    least = Lanes::min(square, least);
  }
  const Across normal = cross(edge[2], edge[0]);
  const Vector side = Lanes::min(
      Lanes::min(dot(normal, cross(seen[0], seen[1])), dot(normal, cross(seen[1], seen[2]))),
      dot(normal, cross(seen[2], seen[0])));
  const Vector height = dot(normal, seen[0]) / dot(normal, normal);
  const auto is_over = Lanes::less(zero, side);
  return {Lanes::select(is_over, height * normal.x, best.x),
          Lanes::select(is_over, height * normal.y, best.y),
          Lanes::select(is_over, height * normal.z, best.z)};
}

// Offers the triangles that may be within the limit. A triangle is as far as its nearest vertex in any
// direction; that to its nearest point, however inexact, is a good one.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void offer_leaf(const Leaf& leaf, NearestSearch& search) {
  const std::array<float, 3>& at = search.at();
  alignas(32) std::array<float, 8> least;
  unsigned bits = 0;
  for (std::size_t part = 0; part < 8; part += width) {
    const auto corner = [&](std::size_t k) TOUCHSTONE_TARGET {
      const auto axis = [&](std::size_t i) TOUCHSTONE_TARGET {
        return Lanes::load(&leaf.corners[3 * k + i][part]) - all(at[i]);
      };
      return Across{axis(0), axis(1), axis(2)};
    };
    const Across seen[3] = {corner(0), corner(1), corner(2)};
    const Across towards = about_nearest(seen);
    const Vector length = Lanes::sqrt(dot(towards, towards));
    const Vector proven =
        Lanes::min(Lanes::min(dot(towards, seen[0]), dot(towards, seen[1])), dot(towards, seen[2]));
    // Where the length is zero or no number, nothing is proven.
    const Vector bound = Lanes::max(proven / length, all(0));
    Lanes::store(&least[part], bound);
    // Lanes without a triangle have NaN.
    bits |= (Lanes::to_bits(Lanes::less_equal(bound, all(search.limit()))) &
             Lanes::to_bits(Lanes::less_equal(seen[0].x, seen[0].x)))
            << part;
  }
  while (bits != 0) {
    auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    for (unsigned rest = bits & (bits - 1); rest != 0; rest &= rest - 1) {
      const auto other = static_cast<std::size_t>(std::countr_zero(rest));
      if (least[other] < least[lane]) lane = other;
    }
    if (least[lane] > search.limit()) break;
    bits &= ~(1U << lane);
    search.offer(leaf, lane);
  }
}

TOUCHSTONE_TARGET void find_nearest(const RayMesh& mesh, NearestSearch& search) {
  const WideNode* const nodes = mesh.tree().nodes.data();
  std::array<std::uint64_t, WideBvh::most_open + WideNode::fan> stack;
  std::size_t open = 0;
  std::int32_t now = 0;
  for (;;) {
    if (WideNode::is_leaf(now)) {
      offer_leaf(mesh.leaves()[WideNode::leaf(now)], search);
    } else {
      const WideNode& node = nodes[static_cast<std::size_t>(now)];
      Vector square[8 / width];
      const unsigned bits = near_children(node, search.at(), search.limit(), square);
      if (bits != 0) {
        now = push(bits, node, square, &stack[open]);
        open += static_cast<std::size_t>(std::popcount(bits)) - 1;
        continue;
      }
    }
    const float limit = search.limit();
    do {
      if (open == 0) return;
      --open;
    } while (near_of(stack[open]) > limit * limit);
    now = child_of(stack[open]);
  }
}
