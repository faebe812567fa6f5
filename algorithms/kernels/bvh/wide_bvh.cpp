// The wide tree's build.
//
// Steps: 1. A node's range of boxes is split in two, then always that part of it that has the
//           greatest surface (less if its own node would be full), until there are eight parts or
//           each is a leaf.
//        2. A split is the cheapest of 45 (15 places on each axis) by the surface area heuristic,
//           moved to the next multiple of eight boxes: so all leaves are full.
//        3. Deep down, which only unusual boxes reach, splits halve the number of boxes.
#include "algorithms/kernels/bvh/wide_bvh.h"

#include <algorithm>
#include <bit>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using Floats = simd::Quad<float>;
using Integers = std::int32_t __attribute__((vector_size(16)));

constexpr std::size_t bins = 16;
// A tree of splits by surface is that deep at most; below it splits are by number, which adds at
// most eleven levels of eight children to 2^32 boxes.
constexpr std::size_t halved_from_depth = 24;
static_assert(halved_from_depth + 12 <= WideBvh::greatest_depth);

// A box with its number, which travels through the sorting as a whole.
struct Item {
  Floats low, high;  // the fourth lane of `high` holds the bits of the box's number
};
std::uint32_t number_of(const Item& item) { return std::bit_cast<std::uint32_t>(item.high[3]); }

Floats min(Floats a, Floats b) { return a < b ? a : b; }
Floats max(Floats a, Floats b) { return a > b ? a : b; }

struct Bounds {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  Floats low = {inf, inf, inf, inf}, high = {-inf, -inf, -inf, -inf};

  void add(Floats other_low, Floats other_high) {
    low = min(low, other_low);
    high = max(high, other_high);
  }
  // Half of the surface; 0 of an empty box.
  float area() const {
    const Floats d = high - low;
    if (!(d[0] >= 0)) return 0;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

// The centre of a box, and zero where it has none (of an empty or boundless box).
Floats centre(const Item& item) {
  constexpr Integers three = {-1, -1, -1, 0};  // the fourth lane's bits are no number
  const Floats high = std::bit_cast<Floats>(std::bit_cast<Integers>(item.high) & three);
  const Floats at = item.low * 0.5F + high * 0.5F;
  return at == at ? at : Floats{};
}

struct Range {
  std::size_t first, last;
  Bounds box, centres;
  float area = 0;
  std::size_t size() const { return last - first; }
};

// The boxes of a range, counted into bins by their centres.
struct Bins {
  std::array<std::array<Bounds, bins>, 3> box;
  std::array<std::array<std::uint32_t, bins>, 3> count;
};

// The cut of a range: its first `left` boxes by the bins of one axis.
struct Split {
  int axis = -1;  // none
  std::size_t left = 0;
};

class Builder {
 public:
  explicit Builder(std::span<const Aabb> boxes) : items_(boxes.size()) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const auto& [low, high] = boxes[i];
      const auto number = std::bit_cast<float>(static_cast<std::uint32_t>(i));
      items_[i].low = Floats{low[0], low[1], low[2], 0};
      items_[i].high = Floats{high[0], high[1], high[2], number};
    }
  }

  WideBvh build() {
    WideBvh tree;
    if (items_.empty()) return tree;
    struct Open {
      Range range;
      std::size_t depth, parent, lane;
    };
    std::vector<Open> open = {{measured(0, items_.size()), 0, 0, 0}};
    tree.nodes.reserve(items_.size() / 40 + 1);
    while (!open.empty()) {
      const Open now = open.back();
      open.pop_back();
      const std::size_t number = tree.nodes.size();
      if (number > 0) tree.nodes[now.parent].child[now.lane] = static_cast<std::int32_t>(number);
      const std::size_t count = divide(now.range, now.depth);
      WideNode& node = tree.nodes.emplace_back();
      for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
        write(node, lane, lane < count ? parts_[lane].box : Bounds{});
        node.child[lane] =
            lane < count ? -1 - static_cast<std::int32_t>(parts_[lane].first / WideBvh::leaf_size)
                         : WideNode::no_child;
      }
      for (std::size_t lane = count; lane-- > 0;) {
        if (parts_[lane].size() > WideBvh::leaf_size) {
          open.push_back({parts_[lane], now.depth + 1, number, lane});
        }
      }
    }
    tree.order.resize(items_.size());
    for (std::size_t i = 0; i < items_.size(); ++i) tree.order[i] = number_of(items_[i]);
    return tree;
  }

 private:
  static void write(WideNode& node, std::size_t lane, const Bounds& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.planes[axis][lane] = box.low[axis];
      node.planes[3 + axis][lane] = box.high[axis];
    }
  }

  Range measured(std::size_t first, std::size_t last) const {
    Range range{first, last, {}, {}};
    for (std::size_t i = first; i < last; ++i) {
      range.box.add(items_[i].low, items_[i].high);
      const Floats at = centre(items_[i]);
      range.centres.add(at, at);
    }
    range.area = range.box.area();
    return range;
  }

  // How much is gained by opening a part: its surface, and more if its node would have lanes to
  // spare. It is a tenth fewer nodes for a ray to visit than the surface alone.
  static float worth(const Range& part) {
    return part.area * static_cast<float>(WideNode::fan) /
           static_cast<float>(std::min(blocks(part.size()), WideNode::fan));
  }

  // Divides the range into at most eight parts, in parts_, and returns their number.
  std::size_t divide(const Range& range, std::size_t depth) {
    parts_[0] = range;
    std::size_t count = 1;
    const bool halve = depth >= halved_from_depth;
    while (count < WideNode::fan) {
      std::size_t widest = count;
      for (std::size_t k = 0; k < count; ++k) {
        if (parts_[k].size() <= WideBvh::leaf_size) continue;
        if (widest == count || (halve ? parts_[k].size() > parts_[widest].size()
                                      : worth(parts_[k]) > worth(parts_[widest]))) {
          widest = k;
        }
      }
      if (widest == count) break;
      const Range whole = parts_[widest];
      const std::size_t middle = cut(whole, halve);
      std::copy_backward(parts_.begin() + static_cast<std::ptrdiff_t>(widest) + 1,
                         parts_.begin() + static_cast<std::ptrdiff_t>(count),
                         parts_.begin() + static_cast<std::ptrdiff_t>(count) + 1);
      parts_[widest] = measured(whole.first, middle);
      parts_[widest + 1] = measured(middle, whole.last);
      ++count;
    }
    return count;
  }

  // Sorts the range into two parts and returns where the second begins.
  std::size_t cut(const Range& range, bool halve) {
    const Floats extent = range.centres.high - range.centres.low;
    Floats scale{};
    for (int axis = 0; axis < 3; ++axis) {
      const float s = static_cast<float>(bins) / extent[axis];
      if (extent[axis] > 0 && s < Bounds::inf && s > 0) scale[axis] = s;
    }
    Split split;
    if (!halve) {
      fill(range, scale);
      split = cheapest(range, scale);
    }
    if (split.axis < 0) return cut_in_half(range);
    return sort_by_bins(range, split, scale);
  }

  // The bin of a centre on each axis; scale is 0 on an axis without bins. NaN has bin 0.
  static Floats bin_of(const Item& item, const Range& range, Floats scale) {
    constexpr float end = static_cast<float>(bins - 1);
    const Floats at = (centre(item) - range.centres.low) * scale;
    return min(max(at, Floats{}), Floats{end, end, end, end});
  }

  void fill(const Range& range, Floats scale) {
    bins_ = {};
    for (std::size_t i = range.first; i < range.last; ++i) {
      const Item& item = items_[i];
      const Integers bin = __builtin_convertvector(bin_of(item, range, scale), Integers);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto b = static_cast<std::size_t>(bin[axis]);
        bins_.box[axis][b].add(item.low, item.high);
        ++bins_.count[axis][b];
      }
    }
  }

  static std::size_t blocks(std::size_t boxes) {
    return (boxes + WideBvh::leaf_size - 1) / WideBvh::leaf_size;
  }
  // The multiple of eight next to `left` that leaves boxes on both sides; size > 8.
  static std::size_t snapped(std::size_t left, std::size_t size) {
    const std::size_t most = (size - 1) / WideBvh::leaf_size;
    const std::size_t near = (left + WideBvh::leaf_size / 2) / WideBvh::leaf_size;
    return std::clamp<std::size_t>(near, 1, most) * WideBvh::leaf_size;
  }

  Split cheapest(const Range& range, Floats scale) const {
    Split best;
    float least = Bounds::inf;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(scale[axis] > 0)) continue;
      const auto& box = bins_.box[static_cast<std::size_t>(axis)];
      const auto& count = bins_.count[static_cast<std::size_t>(axis)];
      std::array<float, bins> behind;  // the surface of what lies in this bin and after it
      Bounds sum;
      for (std::size_t b = bins; b-- > 1;) {
        sum.add(box[b].low, box[b].high);
        behind[b] = sum.area();
      }
      sum = {};
      std::size_t left = 0;
      for (std::size_t b = 1; b < bins; ++b) {
        sum.add(box[b - 1].low, box[b - 1].high);
        left += count[b - 1];
        if (left == 0 || left == range.size()) continue;
        const std::size_t cut = snapped(left, range.size());
        const float cost = sum.area() * static_cast<float>(blocks(cut)) +
                           behind[b] * static_cast<float>(blocks(range.size() - cut));
        if (cost < least) {
          least = cost;
          best = {axis, cut};
        }
      }
    }
    return best;
  }

  // Sorts by the bin in which the cut lies: what is before it, in it and behind it; then within it.
  std::size_t sort_by_bins(const Range& range, Split split, Floats scale) {
    const auto& count = bins_.count[static_cast<std::size_t>(split.axis)];
    std::size_t bin = 0, before = 0;
    while (before + count[bin] <= split.left) before += count[bin++];
    const auto place = static_cast<float>(bin);
    const auto item = [&](std::size_t i) {
      return items_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto at = [&](const Item& i) { return bin_of(i, range, scale)[split.axis]; };
    const std::size_t middle = range.first + split.left;
    std::partition(item(range.first), item(range.last),
                   [&](const Item& i) { return at(i) < place; });
    if (before == split.left) return middle;
    const auto begin = item(range.first + before);
    const auto end =
        std::partition(begin, item(range.last), [&](const Item& i) { return at(i) < place + 1; });
    select(begin, item(middle), end, split.axis);
    return middle;
  }

  std::size_t cut_in_half(const Range& range) {
    const std::size_t middle = range.first + snapped(range.size() / 2, range.size());
    const Floats extent = range.centres.high - range.centres.low;
    int widest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (extent[axis] > extent[widest]) widest = axis;
    }
    const auto item = [&](std::size_t i) {
      return items_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    select(item(range.first), item(middle), item(range.last), widest);
    return middle;
  }

  using Iterator = std::vector<Item>::iterator;
  static void select(Iterator first, Iterator middle, Iterator last, int axis) {
    std::nth_element(first, middle, last, [axis](const Item& a, const Item& b) {
      const float x = centre(a)[axis], y = centre(b)[axis];
      return x != y ? x < y : number_of(a) < number_of(b);
    });
  }

  std::vector<Item> items_;
  std::array<Range, WideNode::fan> parts_;
  Bins bins_;
};

}  // namespace

WideBvh build_wide_bvh(std::span<const Aabb> boxes) { return Builder(boxes).build(); }

}  // namespace touchstone
