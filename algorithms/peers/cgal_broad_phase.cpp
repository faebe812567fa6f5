// CGAL's intersection of boxes: streamed segment trees, a scan of the two sides where few are left.
// Paper:   Zomorodian, Edelsbrunner, "Fast software for box intersections", SoCG 2000; CGAL 5.5,
//          box_self_intersection_d (L. Kettner, A. Meyer, A. Zomorodian), closed boxes of floats.
//          CGAL is under the GNU General Public License, and so is a program with this file in it;
//          TOUCHSTONE_WITH_CGAL=OFF leaves it out.
// Departs: nothing is kept from frame to frame, as CGAL keeps nothing; the boxes are handed over as
//          values, the smallest model of its concept that there is (CGAL's manual finds pointers
//          better for large boxes only), and in the order of their ids in every frame. The boxes
//          at which a scan takes over are 100 a side, not the default of 10: less time at every
//          count that was tried.
// Fails:   a box that begins at the greatest float lies beyond CGAL's last segment; such boxes are
//          compared with all others here.
// Cost:    O(n log^3 n + k) time, O(n) memory beside the recursion's.
#include "algorithms/broad_phase.h"
#if TOUCHSTONE_BUILT
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
  static int dimension() { return 3; }
  NT min_coord(int axis) const { return box_.min[static_cast<std::size_t>(axis)]; }
  NT max_coord(int axis) const { return box_.max[static_cast<std::size_t>(axis)]; }
  ID id() const { return id_; }

 private:
  Aabb box_;
  std::uint32_t id_;
};

class CgalBoxIntersection final : public BroadPhase {
 public:
  void build(std::span<const Aabb> boxes) override {
    boxes_.clear();
    boxes_.reserve(boxes.size());
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (!boxes[id].is_empty()) boxes_.emplace_back(boxes[id], id);
    }
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    PairBuffer& out = sink.chunk(0);
    constexpr std::ptrdiff_t cutoff = 100;
    CGAL::box_self_intersection_d(
        boxes_.begin(), boxes_.end(),
        [&out](const Box& a, const Box& b) { out.push(a.id(), b.id()); }, cutoff);
    candidates_ = static_cast<std::int64_t>(out.size());
    return Status::ok;
  }

  BroadPhaseWork work() const override { return {.candidates = candidates_}; }

 private:
  std::vector<Box> boxes_;  // CGAL changes their order
  std::int64_t candidates_ = 0;
};

}  // namespace
}  // namespace touchstone
#endif

TOUCHSTONE_BROAD_PHASE {
  using namespace touchstone;
  return {
      {.info = {.name = "cgal-box",
                .citation = "CGAL 5.5, box_self_intersection_d (Zomorodian, Edelsbrunner, \"Fast "
                            "software for box intersections\", SoCG 2000)",
                .origin = Origin::peer},
       .make =
           TOUCHSTONE_IF_BUILT([](Executor&) { return std::make_unique<CgalBoxIntersection>(); })},
  };
}
