// FCL's seven broad-phase managers.
// Paper:   none; FCL 0.7, the managers of fcl/broadphase for double (J. Pan, S. Chitta, D. Manocha,
//          "FCL: A General Purpose Library for Collision and Proximity Queries", ICRA 2012).
// Departs: the adapter writes the boxes into the objects' protected `aabb`, since computeAABB makes
//          a box around a rotated body's bounding sphere; floats are exact in FCL's doubles. It
//          tests each pair that a manager calls back with against the given boxes: the hash does no
//          box test, and the trees keep the larger box of a body that shrank. SaP repeats pairs, so
//          they are sorted and made unique. Four managers are made anew where FCL 0.7 cannot update
//          them:
//          - SaP, in a frame in which bodies come or go, or a box does more than slide.
//            unregisterObject reads a list node that it has freed; registerObject misses the boxes
//            that contain the new one; update links an end point to itself, and then runs for ever
//            or crashes, when a box's two ends on an axis do not both rise, both fall or both stay.
//          - the tree in an array, when bodies come: its insertion reads nodes that it has freed as
//            the array grows. Its re-balancing from the top renumbers the nodes behind the
//            manager's back, which exchanges boxes; so that is switched off
//            (max_tree_nonbalanced_level), and the incremental one remains.
//          - the interval tree, in every frame: update(objects) never moves upper end points, and
//            update() does the work of a fresh set-up and loses its old intervals.
//          - the hash, when a box leaves the limits: two boxes that overlap only outside are lost.
// Fails:   SaP and the interval tree order equal end points at random, so they miss pairs that
//          merely touch, and pairs of flat boxes. SaP and the hash are quadratic in dense scenes.
//          The tree in an array leaks its leaves (about 80 bytes a body) each time that it is made.
// Cost:    naive O(n^2); SSaP and interval tree O(n log n + pairs on the axis); SaP O(end points
//          passed times pairs); trees O(n log n) to build.
#include "algorithms/broad_phase.h"
#ifdef TOUCHSTONE_HAS_FCL
#include <algorithm>
#include <new>

#include <fcl/geometry/shape/sphere.h>

#include "algorithms/peers/fcl_managers.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace touchstone {
namespace {

using namespace fcl_managers;

// The tree in an array leaks its copy of the leaves (see above); the leak check ignores it.
void register_all(fcl::BroadPhaseCollisionManager<double>& manager,
                  const std::vector<fcl::CollisionObject<double>*>& objects) {
#if defined(__SANITIZE_ADDRESS__)
  __lsan::ScopedDisabler known;
#endif
  manager.registerObjects(objects);
}

template <class Rules>
class FclBroadPhase final : public PeerBroadPhase {
 public:
  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    guard([&] { make(); });
  }

  void update(const FrameChange& change) override {
    boxes_ = change.boxes;
    const bool room = boxes_.size() <= objects_.capacity();
    guard([&] {
      if (status_ == Status::ok && room && rules_.takes(change, objects_)) {
        apply(change);
      } else {
        make();
      }
    });
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    PairBuffer& out = sink.chunk(0);
    if (status_ != Status::ok) return status_;
    found_.clear();
    Found found{boxes_, Rules::repeats ? found_ : out};
    guard([&] { manager_->collide(&found, &Found::add); });
    candidates_ = found.calls;
    if constexpr (Rules::repeats) {
      std::vector<IndexPair> pairs(found_.pairs().begin(), found_.pairs().end());
      std::ranges::sort(pairs);
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      for (const IndexPair& pair : pairs) out.push(pair.a, pair.b);
    }
    return status_;
  }

  // Asks a tree about each of these bodies; a pair of two of them counts at the smaller id.
  Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) override {
    if constexpr (!Rules::is_tree) {
      return BroadPhase::find_pairs_of(bodies, sink);
    } else {
      sink.start(1);
      if (status_ != Status::ok) return status_;
      asked_.set(bodies);
      Found found{boxes_, sink.chunk(0), &asked_};
      guard([&] {
        for (const std::uint32_t id : bodies) {
          if (boxes_[id].is_empty()) continue;
          probe_.set(id, boxes_[id]);
          manager_->collide(&probe_, &found, &Found::add);
        }
      });
      return status_;
    }
  }

  void discard() override {
    manager_.reset();
    live_ = 0;
  }
  void prepare(std::size_t slots) override {
    guard([&] { make_objects(slots); });
  }

  void convert(std::span<const Aabb> boxes) override {
    converted_.clear();
    for (const Aabb& box : boxes) converted_.push_back(to_fcl(box));
  }

  BroadPhaseWork work() const override { return {.candidates = candidates_}; }

 private:
  // The argument of FCL's callback.
  struct Found {
    std::span<const Aabb> boxes;
    PairBuffer& out;
    const BodyMarks* asked = nullptr;  // set if the second object is one of these bodies
    std::int64_t calls = 0;

    static bool add(Object* first, Object* second, void* data) {
      auto& found = *static_cast<Found*>(data);
      ++found.calls;
      const std::uint32_t a = static_cast<const BoxObject*>(first)->id();
      const std::uint32_t b = static_cast<const BoxObject*>(second)->id();
      constexpr bool stop = false;
      if (found.asked != nullptr && (a == b || (a < b && found.asked->has(a)))) return stop;
      if (overlap(found.boxes[a], found.boxes[b])) found.out.push(a, b);
      return stop;
    }
  };

  // Runs an action; if FCL throws on the input, the pairs of the frame are unknown.
  template <class Action>
  void guard(Action action) {
    try {
      action();
    } catch (const std::bad_alloc&) {
      status_ = Status::capacity;
    } catch (const std::exception&) {
      status_ = Status::degenerate;
    }
  }

  void make() {
    status_ = Status::ok;
    manager_.reset();
    make_objects(boxes_.size());
    batch_.clear();
    for (std::uint32_t id = 0; id < boxes_.size(); ++id) {
      if (boxes_[id].is_empty()) continue;
      objects_[id].set(boxes_[id]);
      batch_.push_back(&objects_[id]);
    }
    live_ = batch_.size();
    manager_ = rules_.make(boxes_);
    register_all(*manager_, batch_);
    manager_->setup();
  }

  // Makes an object for each slot; no manager holds any.
  void make_objects(std::size_t slots) {
    if (slots > objects_.capacity()) {
      objects_.clear();
      objects_.reserve(std::max(slots, 2 * objects_.capacity()));
    }
    extend(slots);
  }

  void apply(const FrameChange& change) {
    extend(boxes_.size());
    // Removal precedes the change of boxes: managers look for a body at its box.
    for (const std::uint32_t id : change.removed) manager_->unregisterObject(&objects_[id]);
    batch_.clear();
    for (const std::uint32_t id : change.moved) {
      objects_[id].set(boxes_[id]);
      batch_.push_back(&objects_[id]);
    }
    for (const std::uint32_t id : change.inserted) {
      objects_[id].set(boxes_[id]);
      manager_->registerObject(&objects_[id]);
    }
    live_ += change.inserted.size();
    live_ -= change.removed.size();
    if (rules_.by_list(change.moved.size(), live_)) {
      manager_->update(batch_);
    } else {
      manager_->update();
    }
  }

  // Makes the objects that are missing, and moves none of those that exist.
  void extend(std::size_t slots) {
    while (objects_.size() < slots) {
      objects_.emplace_back(static_cast<std::uint32_t>(objects_.size()));
    }
  }

  Rules rules_;
  std::span<const Aabb> boxes_;
  // Objects by id, in one array: two managers keep sets ordered by address, so the order of their
  // pairs is that of the ids. The managers hold pointers: it is never reallocated under them.
  std::vector<BoxObject> objects_;
  std::unique_ptr<Manager> manager_;
  std::vector<Object*> batch_;                             // scratch
  BoxObject probe_{0, std::make_shared<fcl::Sphered>(1)};  // object that a tree is asked about
  BodyMarks asked_;                                        // scratch
  PairBuffer found_;                          // scratch of a manager that repeats pairs
  std::vector<fcl::AABB<double>> converted_;  // scratch
  std::size_t live_ = 0;
  std::int64_t candidates_ = 0;
  Status status_ = Status::ok;
};

template <class Rules>
std::unique_ptr<BroadPhase> make(Executor&) {
  return std::make_unique<FclBroadPhase<Rules>>();
}
constexpr auto make_naive = make<Incremental<fcl::NaiveCollisionManager<double>>>;
constexpr auto make_ssap = make<Incremental<fcl::SSaPCollisionManager<double>>>;
constexpr auto make_sap = make<SortAndSweep>;
constexpr auto make_tree = make<DynamicTree>;
constexpr auto make_tree_array = make<DynamicTreeArray>;
constexpr auto make_interval_tree = make<IntervalTree>;
constexpr auto make_spatial_hash = make<SpatialHash>;

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<BroadPhaseEntry> peers_fcl_broad_phase() {
  const auto info = [](const char* name, const char* manager, const char* known_defect = "") {
    return AlgorithmInfo{
        .name = name,
        .citation = std::string("FCL 0.7, ") + manager + " (Pan, Chitta, Manocha, ICRA 2012)",
        .origin = Origin::peer,
        .known_defect = known_defect};
  };
  return {
      {.info = info("fcl-naive", "NaiveCollisionManager"), .make = make_naive},
      {.info = info("fcl-ssap", "SSaPCollisionManager"), .make = make_ssap},
      {.info =
           info("fcl-sap", "SaPCollisionManager", "misses pairs that only touch, and flat boxes"),
       .make = make_sap},
      {.info = info("fcl-dynamic-tree", "DynamicAABBTreeCollisionManager"), .make = make_tree},
      {.info = info("fcl-dynamic-tree-array", "DynamicAABBTreeCollisionManager_Array"),
       .make = make_tree_array},
      {.info = info("fcl-interval-tree", "IntervalTreeCollisionManager",
                    "misses pairs that only touch, and flat boxes"),
       .make = make_interval_tree},
      {.info = info("fcl-spatial-hash", "SpatialHashingCollisionManager"),
       .make = make_spatial_hash},
  };
}

}  // namespace touchstone::entries
