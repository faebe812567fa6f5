// ODE's spaces: the multi-resolution hash, the quadtree, and sweep and prune.
// Paper:   none; ODE 0.16, dHashSpace (R. Smith), dQuadTreeSpace (E. de Vries), dSweepAndPruneSpace
//          (A. Moravanszky, P. Terdiman's box pruning), each queried by dSpaceCollide.
// Departs: a body is a geom of our own class, with the given box: floats are exact in Debian's ODE,
//          which is built for doubles, and in a build for floats. dSpaceClean updates the boxes in
//          build and update; dSpaceCollide would else do it first. The adapter tests every pair of
//          the callback against the given boxes. ODE's manual leaves the settings to the scene:
//          - the hash's cells range from the size of the smallest box to that of the greatest, but
//            no cell is so small that a coordinate's cell is beyond an int, on which ODE aborts.
//            ODE gets coordinates that are shifted to be positive: it loses pairs where the address
//            of a cell changes sign, as it does about the origin;
//          - the quadtree has the world (world.h) as its bounds and is made anew when a box
//            leaves it; it has about as many leaves as there are bodies. Bodies are inserted with
//            their boxes known, or all would first go through one list;
//          - the sweep sorts on the axis on which the world is widest, and tests the thinnest last.
//          A box that ends at the greatest float is given as infinite, or the sweep would pass its
//          own sentinel. ODE's library has globals, so all calls of a process take turns.
// Fails:   the hash keeps a table of n^2 bits, and gives up (`capacity`) where that is 2 GB, from
//          131,072 bodies on. The quadtree is flat, its axes are x and y, and all boxes that lie
//          across its middle lines are tested against everything: far from linear. The sweep is
//          quadratic in the boxes that overlap on its axis.
// Cost:    hash O(n levels + k) time beside clearing its table, quadtree O(n sqrt(n) + k) if boxes
//          are small, sweep O(n + pairs on the axis); O(n) memory but for the hash.
#include "algorithms/broad_phase.h"
#include "algorithms/peers/world.h"
#ifdef TOUCHSTONE_HAS_ODE
#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/peers/ode_library.h"

namespace touchstone {
namespace {

constexpr float greatest = std::numeric_limits<float>::max();

// The data of a geom: its box in ODE's order, and its body's id.
struct Body {
  std::array<dReal, 6> box;  // min, max on x, then on y, then on z
  std::uint32_t id;
};

Body& body_of(dGeomID geom) { return *static_cast<Body*>(dGeomGetClassData(geom)); }

// An offset added to all coordinates before ODE gets them (metres).
using Shift = std::array<double, 3>;

void set_box(Body& body, const Aabb& box, const Shift& by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    body.box[2 * axis] = static_cast<dReal>(box.min[axis] + by[axis]);
    body.box[2 * axis + 1] =
        box.max[axis] < greatest ? static_cast<dReal>(box.max[axis] + by[axis]) : dInfinity;
  }
}

// Returns the class of our geoms: ODE has room for four. The caller holds the library's lock.
int geom_class() {
  static const int kind = [] {
    dGeomClass boxes{};
    boxes.bytes = sizeof(Body);
    boxes.collider = [](int) -> dColliderFn* { return nullptr; };
    boxes.aabb = [](dGeomID geom, dReal aabb[6]) { std::ranges::copy(body_of(geom).box, aabb); };
    return dCreateGeomClass(&boxes);
  }();
  return kind;
}

class Hash {
 public:
  static constexpr std::size_t most_bodies = (std::size_t{1} << 17) - 1;

  dSpaceID start(std::span<const Aabb> boxes) {
    world_ = World::around(boxes);
    int least = std::numeric_limits<int>::max();
    most_ = std::numeric_limits<int>::min();
    for (const Aabb& box : boxes) {
      if (box.is_empty()) continue;
      least = std::min(least, level_of(box));
      most_ = std::max(most_, level_of(box));
    }
    const dSpaceID space = dHashSpaceCreate(nullptr);
    if (least > most_) return space;  // no body
    least = std::max(least, finest(world_.widest()));
    // A cell's address is 1000 level + 100 x + 10 y + z, unsigned. If that passes zero inside a
    // box, ODE looks for the box's cells in other places than those where it put them.
    for (std::size_t axis = 0; axis < 3; ++axis) shift_[axis] = -world_.min[axis];
    if (least < 0) {
      const int worst = std::min(most_, -1);
      const double room = std::ldexp(10.0 * -worst + 1, worst);
      shift_[0] += room;
      least = std::max(least, finest(world_.widest() + room));
    }
    dHashSpaceSetLevels(space, least, std::max(least, most_));
    return space;
  }

  bool takes(const FrameChange& change) const {
    const auto held = [&](std::uint32_t id) {
      return world_.holds(change.boxes[id]) && level_of(change.boxes[id]) <= most_;
    };
    return std::ranges::all_of(change.moved, held) && std::ranges::all_of(change.inserted, held);
  }

  const Shift& shift() const { return shift_; }

 private:
  // The cells that ODE chooses for a box are 2^level wide. A point's level is 0.
  static int level_of(const Aabb& box) {
    double side = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side = std::max(side, double{box.max[axis]} - box.min[axis]);
    }
    int level = 0;
    std::frexp(side, &level);
    return level;
  }
  // The level at which 2^30 cells span `reach`.
  static int finest(double reach) {
    int level = 0;
    std::frexp(reach, &level);
    return level - 30;
  }

  World world_;
  Shift shift_{};
  int most_ = 0;
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
    constexpr int deepest = 10;  // a million leaves, which ODE allocates at once
    int depth = 1;
    while (depth < deepest && (std::size_t{1} << 2 * depth) < boxes.size()) ++depth;
    return dQuadTreeSpaceCreate(nullptr, centre, extents, depth);
  }

  bool takes(const FrameChange& change) const {
    const auto held = [&](std::uint32_t id) { return world_.holds(change.boxes[id]); };
    return std::ranges::all_of(change.moved, held) && std::ranges::all_of(change.inserted, held);
  }
  static Shift shift() { return {}; }

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
  static Shift shift() { return {}; }
};

template <class Rules>
class OdeBroadPhase final : public PeerBroadPhase {
 public:
  OdeBroadPhase() = default;
  ~OdeBroadPhase() override {
    const auto lock = ode::enter();
    clear();
  }
  OdeBroadPhase(const OdeBroadPhase&) = delete;
  OdeBroadPhase& operator=(const OdeBroadPhase&) = delete;

  void build(std::span<const Aabb> boxes) override {
    const auto lock = ode::enter();
    start(boxes);
  }

  void update(const FrameChange& change) override {
    const auto lock = ode::enter();
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
      set_box(body_of(geoms_[id]), boxes_[id], rules_.shift());
      tell(geoms_[id]);
    }
    for (const std::uint32_t id : change.inserted) insert(id);
    dSpaceClean(space_);
  }

  Status find_pairs(PairSink& sink) override {
    const auto lock = ode::enter();
    sink.start(1);
    if (space_ == nullptr) return Status::capacity;
    Found found{boxes_, sink.chunk(0)};
    dSpaceCollide(space_, &found, &Found::add);
    candidates_ = found.calls;
    return Status::ok;
  }

  void convert(std::span<const Aabb> boxes) override {
    converted_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) set_box(converted_[i], boxes[i], rules_.shift());
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

  // Destroys the space and, with it, its geoms.
  void clear() {
    if (space_ != nullptr) dSpaceDestroy(space_);
    space_ = nullptr;
  }

  void insert(std::uint32_t id) {
    dGeomID geom = dCreateGeom(geom_class());
    body_of(geom).id = id;
    set_box(body_of(geom), boxes_[id], rules_.shift());
    dReal known[6];
    dGeomGetAABB(geom, known);
    dSpaceAdd(space_, geom);
    geoms_[id] = geom;
  }

  // Marks a geom as moved, so that ODE reads its box again.
  static void tell(dGeomID geom) {
    const auto& box = body_of(geom).box;
    dGeomSetPosition(geom, box[0], box[2], box[4]);
  }

  Rules rules_;
  std::span<const Aabb> boxes_;
  dSpaceID space_ = nullptr;  // null if there are too many bodies for it
  std::size_t live_ = 0;
  std::vector<dGeomID> geoms_;   // indexed by id; null for an empty slot
  std::vector<Body> converted_;  // scratch
  std::int64_t candidates_ = 0;
};

template <class Space>
std::unique_ptr<BroadPhase> make(Executor&) {
  return std::make_unique<OdeBroadPhase<Space>>();
}
constexpr auto make_hash = make<Hash>;
constexpr auto make_quadtree = make<QuadTree>;
constexpr auto make_sweep = make<Sweep>;

}  // namespace
}  // namespace touchstone
#else
constexpr std::nullptr_t make_hash = nullptr, make_quadtree = nullptr, make_sweep = nullptr;
#endif

namespace touchstone::entries {

std::vector<BroadPhaseEntry> peers_ode_broad_phase() {
  return {
      {.info = {.name = "ode-hash",
                .citation = "ODE 0.16, dHashSpaceCreate (dSpaceCollide)",
                .origin = Origin::peer},
       .make = make_hash},
      {.info = {.name = "ode-quadtree",
                .citation = "ODE 0.16, dQuadTreeSpaceCreate (dSpaceCollide)",
                .origin = Origin::peer},
       .make = make_quadtree},
      {.info = {.name = "ode-sap",
                .citation = "ODE 0.16, dSweepAndPruneSpaceCreate (dSpaceCollide)",
                .origin = Origin::peer},
       .make = make_sweep},
  };
}

}  // namespace touchstone::entries
