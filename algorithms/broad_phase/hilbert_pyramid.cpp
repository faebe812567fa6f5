// Hilbert pyramid: boxes of about one size in the order of a Hilbert curve, in blocks of 16 under a
// tree of bounds without pointers; groups of 256 boxes look for their partners together.
// Paper:   Kamel, Faloutsos, "On Packing R-trees", CIKM 1993 (Hilbert order, full nodes); Wald,
//          Benthin, Boulos, "Getting rid of packets", 2008 (wide nodes for wide vectors).
// Departs: one tree a size class, each class four times the one below, so that large boxes do not
//          blow up the bounds of small ones. A tree against itself meets each pair of blocks once,
//          by their order. What is to be tested next is listed first and then gone through, so that
//          hardly a branch has to be guessed. While bodies move a little the order is kept, and
//          made anew when the bounds of the blocks have grown by a quarter.
// Fails:   long thin boxes in all directions: their blocks overlap whatever their order is.
// Cost:    O(n) time for the order and the tree, O(n + k) to be expected for the search; k = pairs
//          that overlap. About 46 bytes a body.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_pyramid.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/hilbert.h"
#include "algorithms/kernels/radix_sort.h"

namespace touchstone {
namespace {

class HilbertPyramid final : public BroadPhase {
 public:
  explicit HilbertPyramid(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    sort(boxes);
    fit(boxes);
    spread_ = spread();
  }

  void update(const FrameChange& change) override {
    if (!change.inserted.empty() || !change.removed.empty()) return build(change.boxes);
    if (change.moved.empty()) return;
    fit(change.boxes);
    // Written so that a NaN, of bounds that overflow, makes a new order.
    if (!(spread() <= 1.25 * spread_)) build(change.boxes);
  }

  Status find_pairs(PairSink& sink) override {
    std::size_t blocks = 0;
    std::size_t groups = 0;
    for (const SizeClass& c : classes()) {
      blocks = std::max(blocks, c.pyramid.levels()[0].size());
      groups += c.pyramid.groups();
    }
    for (PyramidScratch& scratch : scratch_) scratch.make_room(blocks);
    sink.start(groups);
    executor_.run(groups, [&](std::size_t task, int worker) {
      PyramidScratch& scratch = scratch_[static_cast<std::size_t>(worker)];
      std::size_t at = 0;
      std::size_t group = task;
      while (group >= classes_[at].pyramid.groups()) group -= classes_[at++].pyramid.groups();
      search(at, group, scratch, sink.chunk(task));
    });
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    PyramidScratch scratch;
    PairBuffer pairs;
    for (const SizeClass& c : classes()) scratch.make_room(c.pyramid.levels()[0].size());
    std::int64_t bytes = sum_held_bytes(ids_, order_, radix_sort_, ranges_);
    for (const SizeClass& c : classes_) bytes += sum_held_bytes(c.boxes, c.pyramid);
    for (std::size_t at = 0; at < used_; ++at) {
      for (std::size_t group = 0; group < classes_[at].pyramid.groups(); ++group) {
        pairs.clear();
        search(at, group, scratch, pairs);
      }
    }
    scratch.work.bytes = bytes;
    return scratch.work;
  }

 private:
  static constexpr std::size_t block_size = 8192;
  static constexpr std::size_t most_classes = 16;
  // A class of fewer goes into the next larger one.
  static constexpr std::size_t least_members = 64;

  struct SizeClass {
    BoxArrays boxes;
    BoxPyramid pyramid;
  };
  std::span<const SizeClass> classes() const { return {classes_.data(), used_}; }

  // Powers of four that a float can have.
  static constexpr std::size_t magnitudes = 128;
  static constexpr float inf = std::numeric_limits<float>::infinity();

  // Of a block of bodies: where their doubled centres lie, and how many have which magnitude.
  struct Range {
    std::array<float, 3> low{inf, inf, inf}, high{-inf, -inf, -inf};
    std::array<std::uint32_t, magnitudes> members{};

    void add(const Aabb& box) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float centre = box.min[axis] + box.max[axis];
        low[axis] = std::min(low[axis], centre);
        high[axis] = std::max(high[axis], centre);
      }
      ++members[magnitude(box)];
    }
    void add(const Range& other) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], other.low[axis]);
        high[axis] = std::max(high[axis], other.high[axis]);
      }
      for (std::size_t i = 0; i < magnitudes; ++i) members[i] += other.members[i];
    }
  };

  static int bits_of(std::size_t x) { return static_cast<int>(std::bit_width(x)); }
  // By the exponent of the longest side.
  static std::size_t magnitude(const Aabb& box) {
    const float side =
        std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
    return std::bit_cast<std::uint32_t>(side) >> 24 & (magnitudes - 1);
  }

  void search(std::size_t at, std::size_t group, PyramidScratch& scratch, PairBuffer& out) const {
    // Smaller ones look among larger ones, and among their own.
    for (std::size_t other = at; other < used_; ++other) {
      pair_group(classes_[at].pyramid, group, classes_[other].pyramid, scratch, out);
    }
  }

  Range measure(std::span<const Aabb> boxes);
  std::array<std::uint8_t, magnitudes> make_classes(const Range& range);
  void sort(std::span<const Aabb> boxes);
  void fit(std::span<const Aabb> boxes);
  double spread() const {
    double sum = 0;
    for (const SizeClass& c : classes()) sum += c.pyramid.spread();
    return sum;
  }

  Executor& executor_;
  std::vector<PyramidScratch> scratch_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint64_t> order_;  // class and place on the curve above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<Range> ranges_;  // of the blocks
  std::array<SizeClass, most_classes> classes_;
  std::array<std::size_t, most_classes + 1> begins_{};  // of the classes, in the order
  std::size_t used_ = 0;
  double spread_ = 0;
};

HilbertPyramid::Range HilbertPyramid::measure(std::span<const Aabb> boxes) {
  ranges_.assign(block_count(ids_.size(), block_size), {});
  for_each_block(executor_, ids_.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   Range range;
                   for (std::size_t i = first; i < last; ++i) range.add(boxes[ids_[i]]);
                   ranges_[block] = range;
                 });
  Range all;
  for (const Range& range : ranges_) all.add(range);
  return all;
}

// The class of each magnitude, from the smallest up. A class is closed when it has members enough;
// the largest few have one of their own, however few they are.
std::array<std::uint8_t, HilbertPyramid::magnitudes> HilbertPyramid::make_classes(
    const Range& range) {
  std::array<std::uint8_t, magnitudes> class_of{};
  used_ = 0;
  begins_ = {};
  std::size_t members = 0;
  for (std::size_t i = 0; i < magnitudes; ++i) {
    class_of[i] = static_cast<std::uint8_t>(used_);
    members += range.members[i];
    begins_[used_ + 1] = begins_[used_] + members;
    if (members >= least_members && used_ + 1 < most_classes) {
      ++used_;
      members = 0;
      begins_[used_ + 1] = begins_[used_];
    }
  }
  used_ += members > 0 ? 1 : 0;
  return class_of;
}

void HilbertPyramid::sort(std::span<const Aabb> boxes) {
  const Range range = measure(boxes);
  const std::array<std::uint8_t, magnitudes> class_of = make_classes(range);
  order_.resize(ids_.size());
  if (ids_.empty()) return;
  id_bits_ = bits_of(boxes.size());
  // Sixteen cells a body tell bodies apart; more would only make the sort longer.
  const int wanted = (bits_of(ids_.size()) + 4 + 2) / 3 * 3;
  const int class_bits = bits_of(used_ - 1);
  const HilbertGrid grid(range.low, range.high, std::min({wanted, 30, 60 - id_bits_}));
  for_each_block(executor_, ids_.size(), 1024,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   std::array<std::uint32_t, 1024> codes;
                   grid.codes(boxes, std::span(ids_).subspan(first, last - first), codes.data());
                   for (std::size_t i = first; i < last; ++i) {
                     const std::uint64_t own = class_of[magnitude(boxes[ids_[i]])];
                     const std::uint64_t key = own << grid.code_bits() | codes[i - first];
                     order_[i] = key << id_bits_ | ids_[i];
                   }
                 });
  radix_sort_(executor_, order_, grid.code_bits() + class_bits,
              [bits = id_bits_](std::uint64_t item) { return item >> bits; });
}

void HilbertPyramid::fit(std::span<const Aabb> boxes) {
  const std::uint64_t id_mask = (std::uint64_t{1} << id_bits_) - 1;
  for (std::size_t at = 0; at < used_; ++at) {
    SizeClass& c = classes_[at];
    const std::size_t begin = begins_[at];
    c.boxes.gather(executor_, boxes, begins_[at + 1] - begin, [&](std::size_t i) {
      return static_cast<std::uint32_t>(order_[begin + i] & id_mask);
    });
    c.pyramid.fit(executor_, c.boxes);
  }
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {
      {.info = {.name = "hilbert-pyramid",
                .citation = "Kamel, Faloutsos, \"On Packing R-trees\", CIKM 1993; size classes, "
                            "implicit 16-ary tree"},
       .make = [](touchstone::Executor& executor) {
         return std::make_unique<touchstone::HilbertPyramid>(executor);
       }}};
}
