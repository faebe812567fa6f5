// CGAL's intersection of boxes: streamed segment trees, and a scan of both sides once few are left.
// Paper:   Zomorodian, Edelsbrunner, "Fast software for box intersections", SoCG 2000; CGAL 5.5,
//          box_self_intersection_d (L. Kettner, A. Meyer, A. Zomorodian), closed boxes of floats.
//          CGAL is under the GNU General Public License, and so is a program with this file in it;
//          TOUCHSTONE_WITH_CGAL=OFF leaves it out.
// Departs: CGAL keeps nothing from frame to frame. The boxes are values of the smallest model of
//          its concept (CGAL's manual finds pointers better for large boxes only), in the order of
//          their ids in every frame. The scan takes over at 100 boxes a side instead of the default
//          of 10: half the time at 1,000 bodies, two thirds at 10,000. CGAL loses pairs at the
//          greatest float, with which it marks the ends of the axis; the adapter passes the float
//          before it instead, and in a frame with such a box it tests each pair against the given
//          boxes.
//          It is compiled without vector instructions beyond SSE2: with AVX2 or AVX-512, as our
//          kernels use them, it is no faster.
// Fails:   boxes that begin at the same coordinate cannot be split there and are scanned: quadratic
//          if most do so on the axes y and z.
// Cost:    O(n log^3 n + k) time, O(n) memory.
#include "algorithms/broad_phase.h"
#ifdef TOUCHSTONE_HAS_CGAL
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <limits>

namespace touchstone {
namespace {

// A model of CGAL's BoxIntersectionBox_d.
class Box {
 public:
  using NT = float;
  using ID = std::uint32_t;

  Box(const Aabb& box, std::uint32_t id) : box_(box), id_(id) {}
  bool is_bounded() const {
    bool bounded = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounded &= box_.min[axis] >= -most && box_.max[axis] <= most;
    }
    return bounded;
  }
  void bound() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box_.min[axis] = std::clamp(box_.min[axis], -most, most);
      box_.max[axis] = std::clamp(box_.max[axis], -most, most);
    }
  }
  static int dimension() { return 3; }
  NT min_coord(int axis) const { return box_.min[static_cast<std::size_t>(axis)]; }
  NT max_coord(int axis) const { return box_.max[static_cast<std::size_t>(axis)]; }
  ID id() const { return id_; }

 private:
  static constexpr float most = 0x1.fffffcp127F;  // the greatest float but one

  Aabb box_;
  std::uint32_t id_;
};

class CgalBoxIntersection final : public PeerBroadPhase {
 public:
  void build(std::span<const Aabb> boxes) override {
    given_ = boxes;
    exact_ = to_cgal(boxes, boxes_);
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    PairBuffer& out = sink.chunk(0);
    candidates_ = 0;
    constexpr std::ptrdiff_t cutoff = 100;
    CGAL::box_self_intersection_d(
        boxes_.begin(), boxes_.end(),
        [&](const Box& a, const Box& b) {
          ++candidates_;
          if (exact_ || overlap(given_[a.id()], given_[b.id()])) out.push(a.id(), b.id());
        },
        cutoff);
    return Status::ok;
  }

  void prepare(std::size_t slots) override { boxes_.reserve(slots); }

  void convert(std::span<const Aabb> boxes) override { to_cgal(boxes, converted_); }

  BroadPhaseWork work() const override { return {.candidates = candidates_}; }

 private:
  // Returns true if no box had to be changed.
  static bool to_cgal(std::span<const Aabb> boxes, std::vector<Box>& converted) {
    bool exact = true;
    converted.clear();
    converted.reserve(boxes.size());
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (boxes[id].is_empty()) continue;
      converted.emplace_back(boxes[id], id);
      exact &= converted.back().is_bounded();
    }
    if (!exact) {
      for (Box& box : converted) box.bound();
    }
    return exact;
  }

  std::span<const Aabb> given_;
  bool exact_ = true;
  std::vector<Box> boxes_;      // CGAL reorders them
  std::vector<Box> converted_;  // scratch
  std::int64_t candidates_ = 0;
};

std::unique_ptr<BroadPhase> make(Executor&) { return std::make_unique<CgalBoxIntersection>(); }

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<BroadPhaseEntry> peers_cgal_broad_phase() {
  return {
      {.info = {.name = "cgal-box",
                .citation = "CGAL 5.5, box_self_intersection_d (Zomorodian, Edelsbrunner, \"Fast "
                            "software for box intersections\", SoCG 2000)",
                .origin = Origin::peer},
       .make = make},
  };
}

}  // namespace touchstone::entries
