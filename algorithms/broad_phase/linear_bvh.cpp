// Linear BVH: sort the boxes along a space-filling curve; the bits of their keys define a binary
// tree, built and bounded in one pass from the leaves up; each leaf queries the tree.
// Paper:   Lauterbach et al., "Fast BVH Construction on GPUs", Eurographics 2009; Karras,
//          "Maximizing Parallelism in the Construction of BVHs, Octrees, and k-d Trees", HPG 2012;
//          Apetrei, "Fast and Simple Agglomerative LBVH Construction", CGVC 2014 (one pass).
// Steps:   1. Sort the boxes by size class and then along a Hilbert curve
//             (kernels/bvh/hilbert_sort.h).
//          2. Make a leaf of every 16 boxes; its key is its first box's, followed by its number.
//          3. Climb from each leaf: join the neighbour whose key shares more leading bits. Of the
//             two children, the first to arrive at a node stops and the second continues with both
//             bounds.
//          4. In an update keep the order and repeat step 3; start at step 1 when the leaves' sides
//             have grown by a quarter, or bodies come or go.
//          5. For each leaf, traverse the tree for the leaves after it whose bounds overlap its
//             own.
//          6. Test the leaf's 16 boxes against theirs and each other (kernels/boxes/group_scan.h).
// Departs: a leaf has 16 boxes, so that vectors of them are tested, and the key of its first. The
//          curve is Hilbert's, and the size class precedes the place on it, so that large boxes
//          have their own subtrees. A leaf visits only leaves after it, so each pair is met once.
//          While bodies move a little the order is kept, and the tree over it gets new bounds.
// Fails:   long thin boxes in all directions: leaves overlap in any order.
// Cost:    O(n) time for keys and tree, O(n log n + k) expected for the search; k = pairs that
//          overlap. About 70 bytes a body.
#include <atomic>
#include <bit>
#include <functional>

#include "algorithms/broad_phase.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_measure.h"
#include "algorithms/kernels/boxes/group_scan.h"
#include "algorithms/kernels/bvh/hilbert_sort.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

class LinearBvh final : public BroadPhase {
 public:
  explicit LinearBvh(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    order_.make(executor_, boxes);
    fit(boxes);
    spread_at_build_ = spread();
  }

  void update(const FrameChange& change) override {
    if (!change.inserted.empty() || !change.removed.empty()) return build(change.boxes);
    if (change.moved.empty()) return;
    fit(change.boxes);
    // The negation makes a NaN, from bounds that overflow, rebuild the order.
    if (!(spread() <= 1.25 * spread_at_build_)) build(change.boxes);
  }

  Status find_pairs(PairSink& sink) override {
    search_groups(executor_, leaves_.size(), leaves_a_task, scratch_, sink,
                  std::bind_front(&LinearBvh::pair_leaf, this));
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    Scratch scratch;
    count_groups(leaves_.size(), scratch, std::bind_front(&LinearBvh::pair_leaf, this));
    scratch.group.work.bytes = sum_held_bytes(order_, boxes_, leaves_, nodes_, arrivals_);
    return scratch.group.work;
  }

  // The nodes with their depths, leaves among them.
  std::vector<StructureBox> structure() const override {
    std::vector<StructureBox> nodes;
    if (!leaves_.empty()) show(root_, {bounds_of(boxes_, {0, boxes_.size()}), 0}, nodes);
    return nodes;
  }

 private:
  static constexpr std::size_t leaves_a_task = 32;
  static constexpr std::uint32_t leaf_bit = 0x80000000;
  static constexpr std::uint32_t nobody = 0xffffffff;
  // The key of a leaf, followed by its number, differs from the next leaf's in some bit. Of two
  // splits of a node the one at the higher bit is above the other, so the split bit falls on the
  // way down and the depth of a leaf is at most the number of bits.
  static constexpr int leaf_number_bits = 28;
  static constexpr std::size_t most_levels = HilbertSort::key_bits + leaf_number_bits;

  using Lanes = simd::baseline::Simd<float>;
  using Corner = std::array<float, 4>;  // three coordinates and one unused: a vector's worth

  // Node i splits between leaves i and i + 1.
  struct Node {
    std::array<Corner, 2> low, high;     // bounds of the two children
    std::array<std::uint32_t, 2> child;  // a node, or a leaf with leaf_bit set
    std::array<std::uint32_t, 2> last;   // the last leaf below each child
  };
  struct Scratch {
    std::vector<IndexRange> partners;
    GroupScratch group;
  };

  void fit(std::span<const Aabb> boxes) {
    boxes_.gather(executor_, boxes, order_.size(), [&](std::size_t i) { return order_.id(i); });
    const std::size_t count = block_count(order_.size(), group_size);
    leaves_.resize(count);
    if (count > arrivals_.size()) arrivals_ = std::vector<std::atomic<std::uint32_t>>(2 * count);
    nodes_.resize(count > 0 ? count - 1 : 0);
    for_each_block(executor_, count, 2048, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        arrivals_[i].store(nobody, std::memory_order_relaxed);
      }
    });
    for_each_block(executor_, count, 512, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t leaf = first; leaf < last; ++leaf) climb(leaf);
    });
  }

  IndexRange places_of(std::size_t leaf) const {
    return {leaf * group_size, std::min((leaf + 1) * group_size, boxes_.size())};
  }

  // The bits in which the keys of a leaf and the next one differ.
  std::uint64_t difference(std::size_t leaf) const {
    const auto key = [&](std::size_t i) {
      return order_.key(i * group_size) << leaf_number_bits | i;
    };
    return key(leaf) ^ key(leaf + 1);
  }

  // Climbs from a leaf while the other child of each node has arrived before. The order of arrival
  // does not change the tree.
  void climb(std::size_t leaf) {
    Aabb bounds = bounds_of(boxes_, places_of(leaf));
    leaves_[leaf] = bounds;
    std::uint32_t node = static_cast<std::uint32_t>(leaf) | leaf_bit;
    std::size_t first = leaf;
    std::size_t last = leaf;
    const std::size_t end = leaves_.size() - 1;
    while (first != 0 || last != end) {
      // The node belongs with the neighbour whose key differs in lower bits.
      const bool is_left = first == 0 || (last != end && difference(last) < difference(first - 1));
      const std::size_t parent = is_left ? last : first - 1;
      Node& into = nodes_[parent];
      const std::size_t side = is_left ? 0 : 1;
      std::copy_n(bounds.min.begin(), 3, into.low[side].begin());
      std::copy_n(bounds.max.begin(), 3, into.high[side].begin());
      into.child[side] = node;
      into.last[side] = static_cast<std::uint32_t>(last);
      const std::uint32_t other = arrivals_[parent].exchange(
          static_cast<std::uint32_t>(is_left ? first : last), std::memory_order_acq_rel);
      if (other == nobody) return;
      (is_left ? last : first) = other;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds.min[axis] = std::min(into.low[0][axis], into.low[1][axis]);
        bounds.max[axis] = std::max(into.high[0][axis], into.high[1][axis]);
      }
      node = static_cast<std::uint32_t>(parent);
    }
    root_ = node;
  }

  double spread() const {
    double sum = 0;
    for (const Aabb& leaf : leaves_) sum += sum_of_sides(leaf);
    return sum;
  }

  void pair_leaf(std::size_t leaf, Scratch& scratch, PairBuffer& out) const {
    scratch.partners.clear();
    if (leaves_.size() > 1) find_partners(leaf, scratch);
    scan_group(boxes_, places_of(leaf), leaves_[leaf], scratch.partners, scratch.group, out);
  }

  // Collects the leaves after this one whose bounds overlap its own.
  void find_partners(std::size_t leaf, Scratch& scratch) const {
    Corner low{}, high{};
    std::copy_n(leaves_[leaf].min.begin(), 3, low.begin());
    std::copy_n(leaves_[leaf].max.begin(), 3, high.begin());
    const Lanes::Vector own_low = Lanes::load(low.data());
    const Lanes::Vector own_high = Lanes::load(high.data());
    // The traversal replaces a node by its two children.
    std::array<std::uint32_t, most_levels + 1> open;
    std::size_t count = 0;
    open[count++] = root_;
    while (count > 0) {
      const Node& node = nodes_[open[--count]];
      ++scratch.group.work.node_visits;
      for (std::size_t side = 2; side-- > 0;) {
        if (node.last[side] <= leaf) continue;
        ++scratch.group.work.box_tests;
        const auto within = Lanes::less_equal(Lanes::load(node.low[side].data()), own_high);
        const auto near = Lanes::less_equal(within, own_low, Lanes::load(node.high[side].data()));
        if ((Lanes::to_bits(near) & 7) != 7) continue;
        const std::uint32_t child = node.child[side];
        if ((child & leaf_bit) != 0) {
          scratch.partners.push_back(places_of(child & ~leaf_bit));
        } else {
          open[count++] = child;
        }
      }
    }
  }

  // Lists the node, whose own box is with its parent, and all nodes below it.
  void show(std::uint32_t node, const StructureBox& own, std::vector<StructureBox>& nodes) const {
    nodes.push_back(own);
    if ((node & leaf_bit) != 0) return;
    for (std::size_t side = 0; side < 2; ++side) {
      StructureBox child{.box = {}, .level = own.level + 1};
      std::copy_n(nodes_[node].low[side].begin(), 3, child.box.min.begin());
      std::copy_n(nodes_[node].high[side].begin(), 3, child.box.max.begin());
      show(nodes_[node].child[side], child, nodes);
    }
  }

  Executor& executor_;
  std::vector<Scratch> scratch_;
  HilbertSort order_;
  AabbSoA boxes_;             // sorted along the curve
  std::vector<Aabb> leaves_;  // bounds of the leaves
  std::vector<Node> nodes_;
  std::uint32_t root_ = 0;
  // The far end of the child that arrived first, by node.
  std::vector<std::atomic<std::uint32_t>> arrivals_;
  double spread_at_build_ = 0;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_linear_bvh() {
  return {{.info = {.name = "linear-bvh",
                    .citation = "Karras, HPG 2012; Apetrei, \"Fast and Simple Agglomerative LBVH "
                                "Construction\", CGVC 2014; Hilbert order, leaves of 16"},
           .make = [](Executor& executor) { return std::make_unique<LinearBvh>(executor); }}};
}

}  // namespace touchstone::entries
