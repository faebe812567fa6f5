// Part pairs: a mid-phase finds pairs of parts whose boxes may meet, and a test of parts decides.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (the descent of two trees); Moller, JGT
//          1997; Guigue, Devillers, JGT 2003; mesh_pairs.h and kernels/triangles have those of the
//          signs of volumes.
// Steps:   1. Bind: boxes of all parts go to the mid-phase; `fused` builds trees of its own for
//             meshes, with their corners in floats where all of them are floats, and gives boxes to the
//             mid-phase when two bodies of convex parts are asked.
//          2. Two meshes: pairs of triangles are decided by the signs of volumes in doubles, and in
//             integers where rounding hides a sign. `fused` first looks for a plane between their hulls
//             (hull_separation), and then descends trees of its own, with boxes in
//             both bodies' frames, leaves out what lies beyond a leaf's ends along its normal, and
//             tests two leaves of eight at once.
//          3. A convex part with a convex part or a triangle: a narrow phase decides, sixty-four
//             pairs at a time. `fused` searches the mesh's tree in the part's frame and tests leaves
//             of eight triangles (convex_search); the narrow phase gets what rounding leaves open.
//          4. Where no parts meet and a body is solid, or a surface in a compound, exact winding numbers
//             tell whether a piece of the other lies inside (interior).
//          5. distance: a first descent of the trees to a pair of leaves that is near, then the others
//             depth first, with bounds in lanes: of boxes in both bodies' frames, and along the way of the
//             nearest points; of their triangles those are measured whose gaps, also in lanes, leave them
//             near (part_distance).
//          6. measure: the narrow phase gives each pair's depth and normal; `fused` asks GJK and EPA
//             first, and it for what they leave open (part_depths). Where these are to be welded,
//             a normal that the mesh around does not support gives way to the face's (welding).
// Departs: `moller` and `guigue-devillers` decide each pair of triangles in doubles, as their papers
//          do, and are wrong where rounding is: their status is not_reported.
// Fails:   poses of parts within turned compounds are rounded; where that hides a verdict the answer
//          is unknown and the status degenerate. Each pair in which rounding hides a sign costs some
//          microseconds, so that a mesh on itself is slow.
// Cost:    two meshes: O(log n + k) where little meets, k = pairs of leaves that are near. `fused` holds
//             about 58 bytes a triangle, or 94 if a coordinate is no float.
#include <algorithm>
#include <optional>
#include <utility>

#include "algorithms/concave/part_pairs/convex_pairs.h"
#include "algorithms/concave/part_pairs/convex_search.h"
#include "algorithms/concave/part_pairs/hull_separation.h"
#include "algorithms/concave/part_pairs/interior.h"
#include "algorithms/concave/part_pairs/mesh_pairs.h"
#include "algorithms/concave/part_pairs/part_depths.h"
#include "algorithms/concave/part_pairs/part_distance.h"
#include "algorithms/concave/part_pairs/welding.h"
#include "algorithms/concave_phase.h"

namespace touchstone {
namespace {

class PartPairs final : public ConcavePhase {
 public:
  // A null test makes `fused`. `answered` is the status of an answer that is there.
  PartPairs(const ConcaveSettings& settings, RoughTest test, Status answered)
      : answered_(answered),
        test_(test),
        make_mid_phase_(settings.mid_phase),
        trees_(std::make_shared<MeshTrees>()),
        convex_pairs_(settings.narrow_phase),
        distances_(settings.tolerance) {
    if (settings.welds) welding_.emplace();
    if (test == nullptr) {
      mesh_pairs_ = fused_pairs(trees_);
      search_.emplace(trees_);
      hulls_.emplace();
      depths_.emplace();
    }
  }

  void bind(std::span<const ConcaveBody> bodies) override {
    bodies_.clear();
    bodies_.reserve(bodies.size());
    trees_->clear();
    for (const ConcaveBody& body : bodies) {
      bodies_.emplace_back(body);
      if (!search_) continue;
      trees_->push_back(mesh_tree(bodies_.back()));
      if (body.mesh) bodies_.back().drop_boxes();
    }
    if (search_) {
      mid_phase_ = nullptr;
      search_->bind(bodies_);
      hulls_->bind(bodies_);
      depths_->bind(bodies_);
    } else {
      mid_phase_ = make_mid_phase_();  // the one before keeps the bodies of another scene
      mesh_pairs_ = tested_pairs(mid_phase_, test_);
      fill_mid_phase();
    }
    mesh_pairs_->bind(bodies_);
    convex_pairs_.bind(bodies_);
    distances_.bind(bodies_, *trees_);
    if (welding_) welding_->bind(bodies_);
  }

  void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    outcome.status = answered_;
    pairs.clear();
    enclose(a);
    enclose(b);
    const BoundBody &first = bodies_[a.body], &second = bodies_[b.body];
    const bool all = task == ConcaveTask::contacts;
    std::optional<Status> undecided;
    if (first.mesh() != nullptr && second.mesh() != nullptr) {
      if (hulls_ && hulls_->parts(a, b)) {
        outcome.answer = Answer::separated;
        if (task == ConcaveTask::distance) distances_.measure(a, b, convex_pairs_, outcome);
        return;
      }
      mesh_pairs_->find(a, b, [&](std::span<const IndexPair> found) {
        pairs.insert(pairs.end(), found.begin(), found.end());
        return all;
      });
    } else {
      waiting_.clear();
      if (!search_meshes(a, b, all, pairs, undecided)) find_convex(a, b, all, pairs, undecided);
    }
    if (undecided) outcome.status = *undecided;
    if (!pairs.empty() || is_inside(a, b, undecided.has_value())) {
      outcome.answer = Answer::overlapping;
      if (!all) outcome.status = answered_;
    } else {
      outcome.answer = undecided ? Answer::unknown : Answer::separated;
    }
    if (task == ConcaveTask::distance && outcome.answer == Answer::separated) {
      distances_.measure(a, b, convex_pairs_, outcome);
    }
  }

  bool measure(const PlacedConcave& a, const PlacedConcave& b, std::span<const IndexPair> pairs,
               std::vector<PartContact>& contacts) override {
    contacts.clear();
    const std::span<const Outcome> depths =
        depths_ ? depths_->find(a, b, pairs, convex_pairs_)
                : convex_pairs_.solve(Task::penetration, bodies_[a.body], a.pose, bodies_[b.body],
                                      b.pose, pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Outcome& found = depths[i];
      PartContact& contact = contacts.emplace_back();
      contact.parts = pairs[i];
      contact.status = found.status;
      if (!found.normal.allFinite()) continue;
      contact.normal = found.normal;
      contact.depth = std::max(0.0, -found.distance);
      contact.point = (found.witness_a + found.witness_b) / 2;
      if (welding_) welding_->mend(a, found.witness_a, b, found.witness_b, contact);
    }
    return true;
  }

 private:
  static constexpr std::size_t portion = 64;

  // Refits the boxes of a body whose pose shrinks it.
  void enclose(const PlacedConcave& body) {
    if (!bodies_[body.body].enclose(body.pose.rotation)) return;
    if (mid_phase_ != nullptr) mid_phase_->refit(body.body, bodies_[body.body].boxes);
    distances_.refit(body.body);
  }

  void fill_mid_phase() {
    for (const BoundBody& body : bodies_) {
      if (body.mesh() != nullptr && body.boxes.empty()) {
        mid_phase_->add(body.made_boxes());
      } else {
        mid_phase_->add(body.boxes);
      }
    }
  }

  // Asks the narrow phase about the pairs that wait. Returns false if no more is wanted.
  bool decide(const PlacedConcave& a, const PlacedConcave& b, bool all,
              std::vector<IndexPair>& pairs, std::optional<Status>& undecided) {
    const auto outcomes = convex_pairs_.solve(Task::intersect, bodies_[a.body], a.pose,
                                              bodies_[b.body], b.pose, waiting_);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const Outcome& found = outcomes[i];
      const bool stands = found.status == Status::ok || found.status == Status::not_reported;
      if (found.answer == Answer::unknown || !stands) undecided = found.status;
      if (found.answer == Answer::touching || found.answer == Answer::overlapping) {
        pairs.push_back(waiting_[i]);
      }
    }
    waiting_.clear();
    return all || pairs.empty();
  }

  // A mesh and convex parts, in lanes; returns false if that is not how to find them.
  bool search_meshes(const PlacedConcave& a, const PlacedConcave& b, bool all,
                     std::vector<IndexPair>& pairs, std::optional<Status>& undecided) {
    if (!search_) return false;
    const bool mesh_first = bodies_[a.body].mesh() != nullptr;
    if (!mesh_first && bodies_[b.body].mesh() == nullptr) return false;
    const auto take = [&](std::uint32_t part, std::span<const std::uint32_t> triangles, bool open) {
      std::vector<IndexPair>& to = open ? waiting_ : pairs;
      for (const std::uint32_t triangle : triangles) {
        to.push_back(mesh_first ? IndexPair{triangle, part} : IndexPair{part, triangle});
      }
      if (!open) return all;
      return waiting_.size() < portion || decide(a, b, all, pairs, undecided);
    };
    if (!search_->find(mesh_first ? b : a, mesh_first ? a : b, take)) return false;
    if (!waiting_.empty() && (all || pairs.empty())) decide(a, b, all, pairs, undecided);
    return true;
  }

  void find_convex(const PlacedConcave& a, const PlacedConcave& b, bool all,
                   std::vector<IndexPair>& pairs, std::optional<Status>& undecided) {
    if (mid_phase_ == nullptr) {
      mid_phase_ = make_mid_phase_();
      fill_mid_phase();
    }
    const bool ended = !mid_phase_->find_pairs(
        a.body, a.pose, b.body, b.pose, [&](std::span<const IndexPair> found) {
          waiting_.insert(waiting_.end(), found.begin(), found.end());
          return waiting_.size() < portion || decide(a, b, all, pairs, undecided);
        });
    if (!ended && !waiting_.empty()) decide(a, b, all, pairs, undecided);
  }

  bool is_inside(const PlacedConcave& a, const PlacedConcave& b, bool only_exact) const {
    const BoundBody &first = bodies_[a.body], &second = bodies_[b.body];
    return lies_inside(second, b.pose, first, a.pose, only_exact) ||
           lies_inside(first, a.pose, second, b.pose, only_exact);
  }

  Status answered_;
  RoughTest test_;  // null: `fused`
  std::function<std::unique_ptr<MidPhase>()> make_mid_phase_;
  std::vector<BoundBody> bodies_;
  std::shared_ptr<MeshTrees> trees_;     // of `fused`
  std::shared_ptr<MidPhase> mid_phase_;  // null until it is needed
  std::unique_ptr<MeshPairs> mesh_pairs_;
  std::optional<ConvexSearch> search_;   // of `fused`
  std::optional<HullSeparation> hulls_;  // of `fused`
  std::optional<PartDepths> depths_;     // of `fused`
  ConvexPairs convex_pairs_;
  PartDistance distances_;
  std::optional<Welding> welding_;
  std::vector<IndexPair> waiting_;
};

ConcaveEntry entry(const char* name, const char* citation, RoughTest test) {
  return {.info = {.name = name, .citation = citation},
          .tasks = {ConcaveTask::intersect, ConcaveTask::distance, ConcaveTask::contacts},
          .scalars = {Precision::float64},
          .takes_mid_phase = test != nullptr,
          .measures = true,
          .welds = true,
          .make = [test](const ConcaveSettings& settings) {
            return std::make_unique<PartPairs>(settings, test, Status::ok);
          }};
}

// With a test that decides where rounding hides the verdict too.
ConcaveEntry approximate(const char* name, const char* citation, RoughTest test) {
  return {.info = {.name = name, .citation = citation},
          .tasks = {ConcaveTask::intersect, ConcaveTask::contacts},
          .scalars = {Precision::float64},
          .supports = [](const ConcaveBody& a, const ConcaveBody& b) { return a.mesh && b.mesh; },
          .takes_mid_phase = true,
          .approximate = true,
          .make =
              [test](const ConcaveSettings& settings) {
                return std::make_unique<PartPairs>(settings, test, Status::not_reported);
              }};
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<ConcaveEntry> concave_part_pairs() {
  return {
      entry(
          "fused",
          "a descent of two trees of eight boxes a node, whose leaves are tested by fifteen signs "
          "of volumes in vector lanes; integers where rounding hides a sign",
          nullptr),
      entry("part-pairs",
            "a mid-phase, then signs of volumes or a narrow phase for each pair of parts; integers "
            "where rounding hides a sign",
            test_by_signs),
      approximate("moller",
                  "T. Moller, \"A fast triangle-triangle intersection test\", JGT 2(2), 1997",
                  test_by_moller),
      approximate("guigue-devillers",
                  "P. Guigue, O. Devillers, \"Fast and robust triangle-triangle overlap test using "
                  "orientation predicates\", JGT 8(1), 2003",
                  test_by_guigue_devillers)};
}

}  // namespace touchstone::entries
