// ODE's spaces: the multi-resolution hash, the quadtree, and sweep and prune.
// Paper:   none; ODE 0.16, dHashSpace (R. Smith), dQuadTreeSpace (E. de Vries), dSweepAndPruneSpace
//          (A. Moravanszky, P. Terdiman's box pruning), each asked by dSpaceCollide.
// Departs: a body is a geom of a class of its own, whose box is the given one: floats are exact in
//          Debian's ODE, which is built for doubles, and in one for floats. Boxes are brought up to
//          date by dSpaceClean in build and update, which dSpaceCollide would else do first. Every
//          pair of the callback is tested against the given boxes. ODE's manual leaves the settings
//          to the scene:
//          - the hash's cells go from the size of the smallest box to that of the greatest, but no
//            cell is so small that a coordinate's cell is beyond an int, which ODE aborts on;
//          - the quadtree has the world (core/world.h) as its bounds, which is made anew when a box
//            leaves it, and about as many leaves as there are bodies; bodies are put in with their
//            boxes known, or all would first go through one list;
//          - the sweep sorts on the axis on which the world is widest, and tests the thinnest last.
//          A box that ends at the greatest float is given as endless, or the sweep would pass its
//          own sentinel. ODE's library has globals, so all calls of a process take turns.
// Fails:   the hash keeps a table of n^2 bits, and gives up (`capacity`) where that is 2 GB, from
//          131,072 bodies on. The quadtree is flat, its axes are x and y, and all boxes that lie
//          across its middle lines are tested against everything: far from linear. The sweep is
//          quadratic in the boxes that overlap on its axis.
// Cost:    hash O(n levels + k) time beside clearing its table, quadtree O(n sqrt(n) + k) where
// boxes
//          are small, sweep O(n + pairs on the axis); O(n) memory but for the hash.
#include "algorithms/broad_phase.h"
#include "algorithms/core/world.h"
#if TOUCHSTONE_BUILT
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace touchstone {
namespace {

constexpr float greatest = std::numeric_limits<float>::max();

// What a geom holds: its box as ODE writes boxes, and whose it is.
struct Body {
  std::array<dReal, 6> box;  // min, max on x, then on y, then on z
  std::uint32_t id;
};

Body& body_of(dGeomID geom) { return *static_cast<Body*>(dGeomGetClassData(geom)); }

void set_box(Body& body, const Aabb& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    body.box[2 * axis] = box.min[axis];
    body.box[2 * axis + 1] = box.max[axis] < greatest ? dReal{box.max[axis]} : dInfinity;
  }
}

// ODE's own state, and the lock for it. `kind` is the class of our geoms: ODE has room for four.
struct Library {
  std::mutex mutex;
  int kind = 0;

  Library() {
    dInitODE2(0);
    dGeomClass boxes{};
    boxes.bytes = sizeof(Body);
    boxes.collider = [](int) -> dColliderFn* { return nullptr; };
    boxes.aabb = [](dGeomID geom, dReal aabb[6]) { std::ranges::copy(body_of(geom).box, aabb); };
    kind = dCreateGeomClass(&boxes);
  }
};

Library& library() {
  static Library the;
  return the;
}

// Of ODE in this thread.
std::unique_lock<std::mutex> enter() {
  std::unique_lock lock(library().mutex);
  dAllocateODEDataForThread(dAllocateMaskAll);
  return lock;
}

class Hash {
 public:
  static constexpr std::size_t most_bodies = (std::size_t{1} << 17) - 1;

  dSpaceID start(std::span<const Aabb> boxes) {
    least_ = std::numeric_limits<int>::max();
    most_ = std::numeric_limits<int>::min();
    reach_ = 0;
    space_ = dHashSpaceCreate(nullptr);
    for (const Aabb& box : boxes) {
      if (!box.is_empty()) take(box);
    }
    set();
    return space_;
  }

  bool takes(const FrameChange& change) {
    for (const std::uint32_t id : change.moved) take(change.boxes[id]);
    for (const std::uint32_t id : change.inserted) take(change.boxes[id]);
    set();
    return true;
  }

 private:
  void take(const Aabb& box) {
    double side = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side = std::max(side, double{box.max[axis]} - box.min[axis]);
      reach_ = std::max({reach_, std::abs(double{box.min[axis]}), std::abs(double{box.max[axis]})});
    }
    int level = 0;  // of a point too, as ODE has it
    std::frexp(side, &level);
    least_ = std::min(least_, level);
    most_ = std::max(most_, level);
  }
  void set() {
    int level = 0;
    std::frexp(reach_, &level);
    const int least = std::max(least_, level - 30);
    if (least_ <= most_) dHashSpaceSetLevels(space_, least, std::max(least, most_));
  }

  dSpaceID space_ = nullptr;
  int least_ = 0, most_ = 0;  // cells are 2^level wide
  double reach_ = 0;          // greatest coordinate without its sign
};

class QuadTree {
 public:
  static constexpr std::size_t most_bodies = std::numeric_limits<std::size_t>::max();

  dSpaceID start(std::span<const Aabb> boxes) {
    world_ = World::around(boxes);
    dVector3 centre{}, extents{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis] = static_cast<dReal>(world_.min[axis] / 2 + world_.max[axis] / 2);
      extents[axis] = static_cast<dReal>(world_.max[axis] / 2 - world_.min[axis] / 2);
    }
    constexpr int deepest = 10;  // a million leaves, which ODE makes at once
    int depth = 1;
    while (depth < deepest && (std::size_t{1} << 2 * depth) < boxes.size()) ++depth;
    return dQuadTreeSpaceCreate(nullptr, centre, extents, depth);
  }

  bool takes(const FrameChange& change) const {
    const auto held = [&](std::uint32_t id) { return world_.holds(change.boxes[id]); };
    return std::ranges::all_of(change.moved, held) && std::ranges::all_of(change.inserted, held);
  }

 private:
  World world_;
};

class Sweep {
 public:
  static constexpr std::size_t most_bodies = std::numeric_limits<std::size_t>::max();

  static dSpaceID start(std::span<const Aabb> boxes) {
    const World world = World::around(boxes);
    std::array<int, 3> axes = {0, 1, 2};
    std::ranges::stable_sort(axes, std::greater{}, [&](int axis) {
      const auto i = static_cast<std::size_t>(axis);
      return world.max[i] - world.min[i];
    });
    return dSweepAndPruneSpaceCreate(nullptr, axes[0] | axes[1] << 2 | axes[2] << 4);
  }
  static bool takes(const FrameChange&) { return true; }
};

template <class Rules>
class OdeBroadPhase final : public BroadPhase {
 public:
  OdeBroadPhase() = default;
  ~OdeBroadPhase() override {
    const auto lock = enter();
    clear();
  }
  OdeBroadPhase(const OdeBroadPhase&) = delete;
  OdeBroadPhase& operator=(const OdeBroadPhase&) = delete;

  void build(std::span<const Aabb> boxes) override {
    const auto lock = enter();
    start(boxes);
  }

  void update(const FrameChange& change) override {
    const auto lock = enter();
    live_ += change.inserted.size();
    live_ -= change.removed.size();
    if (space_ == nullptr || live_ > Rules::most_bodies || !rules_.takes(change)) {
      return start(change.boxes);
    }
    boxes_ = change.boxes;
    geoms_.resize(boxes_.size(), nullptr);
    for (const std::uint32_t id : change.removed) {
      dGeomDestroy(geoms_[id]);
      geoms_[id] = nullptr;
    }
    for (const std::uint32_t id : change.moved) {
      set_box(body_of(geoms_[id]), boxes_[id]);
      tell(geoms_[id]);
    }
    for (const std::uint32_t id : change.inserted) insert(id);
    dSpaceClean(space_);
  }

  Status find_pairs(PairSink& sink) override {
    const auto lock = enter();
    sink.start(1);
    if (space_ == nullptr) return Status::capacity;
    Found found{boxes_, sink.chunk(0)};
    dSpaceCollide(space_, &found, &Found::add);
    candidates_ = found.calls;
    return Status::ok;
  }

  bool convert(std::span<const Aabb> boxes) override {
    converted_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) set_box(converted_[i], boxes[i]);
    return true;
  }

  BroadPhaseWork work() const override { return {.candidates = candidates_}; }

 private:
  struct Found {
    std::span<const Aabb> boxes;
    PairBuffer& out;
    std::int64_t calls = 0;

    static void add(void* data, dGeomID first, dGeomID second) {
      auto& found = *static_cast<Found*>(data);
      ++found.calls;
      const std::uint32_t a = body_of(first).id;
      const std::uint32_t b = body_of(second).id;
      if (overlap(found.boxes[a], found.boxes[b])) found.out.push(a, b);
    }
  };

  void start(std::span<const Aabb> boxes) {
    clear();
    boxes_ = boxes;
    live_ = static_cast<std::size_t>(
        std::ranges::count_if(boxes, [](const Aabb& box) { return !box.is_empty(); }));
    if (live_ > Rules::most_bodies) return;
    space_ = rules_.start(boxes);
    geoms_.assign(boxes.size(), nullptr);
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (!boxes[id].is_empty()) insert(id);
    }
    dSpaceClean(space_);
  }

  // Its geoms go with a space.
  void clear() {
    if (space_ != nullptr) dSpaceDestroy(space_);
    space_ = nullptr;
  }

  void insert(std::uint32_t id) {
    dGeomID geom = dCreateGeom(library().kind);
    body_of(geom).id = id;
    set_box(body_of(geom), boxes_[id]);
    dReal known[6];
    dGeomGetAABB(geom, known);
    dSpaceAdd(space_, geom);
    geoms_[id] = geom;
  }

  // ODE looks at a geom's box again when the geom was moved.
  static void tell(dGeomID geom) {
    const auto& box = body_of(geom).box;
    dGeomSetPosition(geom, box[0], box[2], box[4]);
  }

  Rules rules_;
  std::span<const Aabb> boxes_;
  dSpaceID space_ = nullptr;  // null where there are too many bodies for it
  std::size_t live_ = 0;
  std::vector<dGeomID> geoms_;   // by id; null where there is no body
  std::vector<Body> converted_;  // scratch
  std::int64_t candidates_ = 0;
};

}  // namespace
}  // namespace touchstone
#endif

TOUCHSTONE_BROAD_PHASE {
  using namespace touchstone;
  return {
      {.info = {.name = "ode-hash",
                .citation = "ODE 0.16, dHashSpaceCreate (dSpaceCollide)",
                .origin = Origin::peer},
       .make =
           TOUCHSTONE_IF_BUILT([](Executor&) { return std::make_unique<OdeBroadPhase<Hash>>(); })},
      {.info = {.name = "ode-quadtree",
                .citation = "ODE 0.16, dQuadTreeSpaceCreate (dSpaceCollide)",
                .origin = Origin::peer},
       .make = TOUCHSTONE_IF_BUILT(
           [](Executor&) { return std::make_unique<OdeBroadPhase<QuadTree>>(); })},
      {.info = {.name = "ode-sap",
                .citation = "ODE 0.16, dSweepAndPruneSpaceCreate (dSpaceCollide)",
                .origin = Origin::peer},
       .make =
           TOUCHSTONE_IF_BUILT([](Executor&) { return std::make_unique<OdeBroadPhase<Sweep>>(); })},
  };
}
