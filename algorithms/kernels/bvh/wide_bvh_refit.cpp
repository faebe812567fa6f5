// The wide tree's refit: the nodes from the last to the first, so that children come before parents.
#include <cstring>

#include "algorithms/kernels/bvh/wide_bvh.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using Floats = simd::Quad<float>;

Floats min_of(Floats a, Floats b) { return a < b ? a : b; }
Floats max_of(Floats a, Floats b) { return a > b ? a : b; }
Floats loaded(const float* from) {
  Floats x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

}  // namespace

void refit(WideBvh& tree, std::span<const Aabb> boxes) {
  static_assert(sizeof(Aabb) == 6 * sizeof(float));
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    WideNode& node = tree.nodes[n];
    for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
      const std::int32_t child = node.child[lane];
      if (child == WideNode::no_child) break;
      if (!WideNode::is_leaf(child)) {
        const WideNode& below = tree.nodes[static_cast<std::size_t>(child)];
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& low = below.planes[k];
          const auto& high = below.planes[3 + k];
          node.planes[k][lane] = simd::reduce_min4(min_of(loaded(&low[0]), loaded(&low[4])));
          node.planes[3 + k][lane] = simd::reduce_max4(max_of(loaded(&high[0]), loaded(&high[4])));
        }
        continue;
      }
      // The lanes are min x, y, z, max x and min z, max x, y, z.
      const float* first = boxes[tree.leaf(WideNode::leaf(child))[0]].min.data();
      Floats low = loaded(first), high = loaded(first + 2);
      for (const std::uint32_t number : tree.leaf(WideNode::leaf(child)).subspan(1)) {
        const float* box = boxes[number].min.data();
        low = min_of(low, loaded(box));
        high = max_of(high, loaded(box + 2));
      }
      for (int axis = 0; axis < 3; ++axis) {
        node.planes[static_cast<std::size_t>(axis)][lane] = low[axis];
        node.planes[static_cast<std::size_t>(3 + axis)][lane] = high[axis + 1];
      }
    }
  }
}

}  // namespace touchstone
