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
#ifdef TOUCHSTONE_HAS_ODE
#include <algorithm>

#include "algorithms/peers/ode_library.h"
#include "algorithms/peers/ode_spaces.h"

namespace touchstone {
namespace {

using namespace ode_spaces;

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

  void discard() override {
    const auto lock = ode::enter();
    clear();
  }
  void prepare(std::size_t slots) override { geoms_.reserve(slots); }

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
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
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
