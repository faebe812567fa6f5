// Bullet's broad phases: the dynamic AABB tree and the 32-bit three-axis sweep and prune.
// Paper:   none; Bullet 3.24, btDbvtBroadphase and bt32BitAxisSweep3 (E. Coumans, N. Presson, S.
//          Hobbs), each with its btHashedOverlappingPairCache.
// Departs: the adapter asks for the smallest margins that Bullet allows: gDbvtMargin is 0, the
//          query finds the collisions (m_deferedcollide), each frame checks every stale pair
//          (m_cupdates = 100), and only boxes that moved are set. Bullet's cache still holds more
//          than the closed pairs (leaves that shrank, quantised end points, boxes beyond the
//          world), so the adapter tests each cached pair against the given boxes, which have the
//          same bits in Bullet's floats. The sweep needs a world and a capacity: both are twice as
//          large as necessary, and the adapter builds a new sweep when a box leaves the world or
//          the capacity is exhausted. The changes are told from Bullet's cache: each cached pair
//          has a mark if it was told, and a marked pair that Bullet removes is kept aside.
// Fails:   removing a body scans all cached pairs, so churn is quadratic. The sweep moves each new
//          end point through the whole axis, so its build is quadratic. The order of the tree's
//          pairs depends on addresses (its balancing compares pointers).
// Cost:    tree: O(log n) a moved box, and a query of all moved boxes against both trees; sweep:
//          O(distance moved in the order) an end point. O(n + k) memory for k cached pairs.
#include <algorithm>
#include <cstdint>

#include "algorithms/broad_phase.h"
#include "algorithms/core/pair_history.h"
#include "algorithms/peers/world.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

namespace touchstone {
namespace {

static_assert(sizeof(btScalar) == sizeof(float), "the boxes' bits would not be Bullet's");

btVector3 corner(const std::array<float, 3>& x) { return {x[0], x[1], x[2]}; }

// The proxy's client pointer carries the body's id.
void* to_client(std::uint32_t id) {
  return reinterpret_cast<void*>(std::uintptr_t{id});  // NOLINT(performance-no-int-to-ptr)
}
std::uint32_t to_id(const btBroadphaseProxy* proxy) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(proxy->m_clientObject));
}

// Bullet's cache, with marks of the pairs that find_changes has told. Marked pairs that leave it are
// lost: they have ended, if they do not come back.
class ToldPairCache final : public btHashedOverlappingPairCache {
 public:
  // `lost` gets the lost pairs, and outlives the cache; null: there are no marks.
  explicit ToldPairCache(std::vector<IndexPair>* lost) : lost_(lost) {}

  void keep_lost(std::vector<IndexPair>& lost) { lost_ = &lost; }
  static bool is_marked(const btBroadphasePair& pair) { return pair.m_internalTmpValue != 0; }
  static void mark(btBroadphasePair& pair, bool value) { pair.m_internalTmpValue = value ? 1 : 0; }

  void* removeOverlappingPair(btBroadphaseProxy* first, btBroadphaseProxy* second,
                              btDispatcher* dispatcher) override {
    if (lost_ != nullptr) {
      const btBroadphasePair* const pair = findPair(first, second);
      if (pair != nullptr) lose(*pair);
    }
    return btHashedOverlappingPairCache::removeOverlappingPair(first, second, dispatcher);
  }
  void lose_all() {
    if (lost_ == nullptr) return;
    const btBroadphasePairArray& pairs = getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) lose(pairs[i]);
  }

 private:
  void lose(const btBroadphasePair& pair) {
    if (!is_marked(pair)) return;
    const std::uint32_t a = to_id(pair.m_pProxy0), b = to_id(pair.m_pProxy1);
    lost_->push_back({std::min(a, b), std::max(a, b)});
  }

  std::vector<IndexPair>* lost_;
};

class Tree {
 public:
  Tree() {
    // gDbvtMargin is a global of Bullet's that btDbvt::update reads when a leaf grows. It is
    // written once, under the lock of this static's initialiser, before the process has its first
    // tree; workers with their own trees may then read it.
    [[maybe_unused]] static const btScalar margin = gDbvtMargin = 0;
  }
  ~Tree() { clear(); }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  btBroadphaseInterface& start(std::span<const Aabb>, btOverlappingPairCache& cache) {
    broad_ = std::make_unique<btDbvtBroadphase>(&cache);
    broad_->m_deferedcollide = true;
    broad_->m_cupdates = 100;
    return *broad_;
  }
  bool takes(const FrameChange&) const { return true; }

  // Bullet's destructor leaks the proxies, and destroyProxy scans the pairs for each of them. An
  // empty pair cache makes destroying them cheap.
  void clear() {
    if (!broad_) return;
    btNullPairCache none;
    broad_->m_paircache = &none;
    for (btDbvtProxy* list : broad_->m_stageRoots) {
      while (list != nullptr) {
        btDbvtProxy* next = list->links[1];
        broad_->destroyProxy(list, nullptr);
        list = next;
      }
    }
    broad_.reset();
  }

 private:
  std::unique_ptr<btDbvtBroadphase> broad_;
};

class AxisSweep {
 public:
  btBroadphaseInterface& start(std::span<const Aabb> boxes, btOverlappingPairCache& cache) {
    world_ = World::around(boxes);
    used_ = count(boxes);
    capacity_ = std::max(2 * used_, std::size_t{64});
    // Within these bounds no step of the quantisation overflows. Bullet clamps what is beyond them
    // and keeps the order, so no pair is lost.
    constexpr double limit = 1e18;
    btVector3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      low[axis] = static_cast<float>(std::clamp(world_.min[i], -limit, limit / 2));
      high[axis] = static_cast<float>(std::clamp(world_.max[i], -limit / 2, limit));
    }
    constexpr bool without_ray_accelerator = true;
    broad_ = std::make_unique<bt32BitAxisSweep3>(low, high, static_cast<unsigned>(capacity_),
                                                 &cache, without_ray_accelerator);
    return *broad_;
  }
  void clear() { broad_.reset(); }

  bool takes(const FrameChange& change) {
    used_ += change.inserted.size();
    used_ -= change.removed.size();
    const auto held = [&](std::uint32_t id) { return world_.holds(change.boxes[id]); };
    // Removed bodies make room before the inserted ones arrive.
    return used_ <= capacity_ && std::ranges::all_of(change.moved, held) &&
           std::ranges::all_of(change.inserted, held);
  }

 private:
  static std::size_t count(std::span<const Aabb> boxes) {
    return static_cast<std::size_t>(
        std::ranges::count_if(boxes, [](const Aabb& box) { return !box.is_empty(); }));
  }

  World world_;
  std::size_t used_ = 0, capacity_ = 0;
  std::unique_ptr<bt32BitAxisSweep3> broad_;
};

template <class Structure>
class BulletBroadPhase final : public PeerBroadPhase {
 public:
  void build(std::span<const Aabb> boxes) override {
    discard();
    boxes_ = boxes;
    cache_ = std::make_unique<ToldPairCache>(is_told_ ? &lost_ : nullptr);
    broad_ = &structure_.start(boxes, *cache_);
    proxies_.assign(boxes.size(), nullptr);
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (!boxes[id].is_empty()) insert(id);
    }
  }

  void update(const FrameChange& change) override {
    if (!structure_.takes(change)) return build(change.boxes);
    boxes_ = change.boxes;
    proxies_.resize(boxes_.size(), nullptr);
    for (const std::uint32_t id : change.removed) {
      broad_->destroyProxy(proxies_[id], nullptr);
      proxies_[id] = nullptr;
    }
    for (const std::uint32_t id : change.moved) {
      broad_->setAabb(proxies_[id], corner(boxes_[id].min), corner(boxes_[id].max), nullptr);
    }
    for (const std::uint32_t id : change.inserted) insert(id);
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    PairBuffer& out = sink.chunk(0);
    broad_->calculateOverlappingPairs(nullptr);
    const btBroadphasePairArray& pairs = cache_->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
      const std::uint32_t a = to_id(pairs[i].m_pProxy0);
      const std::uint32_t b = to_id(pairs[i].m_pProxy1);
      if (overlap(boxes_[a], boxes_[b])) out.push(a, b);
    }
    candidates_ = pairs.size();
    return Status::ok;
  }

  // A pair that Bullet removed and took in again is in both lists, and has not changed.
  Status find_changes(PairSink& began, PairSink& ended) override {
    is_told_ = true;
    cache_->keep_lost(lost_);
    broad_->calculateOverlappingPairs(nullptr);
    btBroadphasePairArray& pairs = cache_->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
      const std::uint32_t a = to_id(pairs[i].m_pProxy0);
      const std::uint32_t b = to_id(pairs[i].m_pProxy1);
      const bool overlaps = overlap(boxes_[a], boxes_[b]);
      if (overlaps == ToldPairCache::is_marked(pairs[i])) continue;
      ToldPairCache::mark(pairs[i], overlaps);
      (overlaps ? came_ : lost_).push_back({std::min(a, b), std::max(a, b)});
    }
    write_difference(came_, lost_, began, ended);
    came_.clear();
    lost_.clear();
    return Status::ok;
  }

  void discard() override {
    if (cache_) cache_->lose_all();
    structure_.clear();
    broad_ = nullptr;
    cache_.reset();
  }
  void prepare(std::size_t slots) override { proxies_.reserve(slots); }

  void convert(std::span<const Aabb> boxes) override {
    converted_.clear();
    for (const Aabb& box : boxes) {
      converted_.push_back(corner(box.min));
      converted_.push_back(corner(box.max));
    }
  }

  BroadPhaseWork work() const override { return {.candidates = candidates_}; }

 private:
  void insert(std::uint32_t id) {
    constexpr int everything = btBroadphaseProxy::DefaultFilter;
    proxies_[id] = broad_->createProxy(corner(boxes_[id].min), corner(boxes_[id].max), 0,
                                       to_client(id), everything, everything, nullptr);
  }

  bool is_told_ = false;                // changes have been asked for
  std::vector<IndexPair> lost_, came_;  // lost pairs; scratch of find_changes
  // The structure's end passes through the cache, which reads the ids of its proxies.
  std::unique_ptr<ToldPairCache> cache_;
  Structure structure_;
  btBroadphaseInterface* broad_ = nullptr;
  std::span<const Aabb> boxes_;
  std::vector<btBroadphaseProxy*> proxies_;  // indexed by id; null for an empty slot
  std::vector<btVector3> converted_;         // scratch
  std::int64_t candidates_ = 0;
};

template <class Structure>
std::unique_ptr<BroadPhase> make(Executor&) {
  return std::make_unique<BulletBroadPhase<Structure>>();
}
constexpr auto make_tree = make<Tree>;
constexpr auto make_axis_sweep = make<AxisSweep>;

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<BroadPhaseEntry> peers_bullet_broad_phase() {
  return {
      {.info = {.name = "bullet-tree",
                .citation = "Bullet 3.24, btDbvtBroadphase (setAabb, calculateOverlappingPairs)",
                .origin = Origin::peer},
       .make = make_tree},
      {.info = {.name = "bullet-axis-sweep",
                .citation = "Bullet 3.24, bt32BitAxisSweep3 (setAabb, calculateOverlappingPairs)",
                .origin = Origin::peer},
       .make = make_axis_sweep},
  };
}

}  // namespace touchstone::entries
