// Embree's collision of a scene with itself; the scene is one user geometry of boxes.
// Paper:   Wald, Woop, Benthin, Johnson, Ernst, "Embree: a kernel framework for efficient CPU ray
//          tracing", SIGGRAPH 2014; Embree 3.13, rtcCollide. `embree-low` builds its BVH in each
//          frame along a Morton curve (Lauterbach et al., "Fast BVH construction on GPUs",
//          Eurographics 2009), which is Embree's RTC_BUILD_QUALITY_LOW; `embree-refit` builds it by
//          the surface area heuristic and then only refits it (RTC_BUILD_QUALITY_REFIT).
// Departs: the scene is dynamic (RTC_SCENE_FLAG_DYNAMIC) and of low quality, since only then the
//          geometry's quality counts. Embree reports pairs of leaf boxes in both orders: the
//          adapter tests those with the smaller primitive first against the given boxes. Embree
//          drops boxes beyond 1.84e18, so larger worlds are scaled down by a power of two; rounding
//          keeps the order of floats, so no pair is lost. Embree gets threads=<the executor's
//          width> and is built on oneTBB, so it finds the pairs in an arena of that width, whose
//          threads are pinned as the executor's are, whatever else the process does with Embree.
// Fails:   on more than one thread the order of the pairs differs each time. A refitted tree suits
//          bodies that move a little: where bodies mix it becomes useless, until some come or go
//          and it is built again. Threads=N limits oneTBB in the whole process to N while Embree is
//          in use.
// Cost:    O(n log n) time to build, O(n) to refit; O(n + k) to query if boxes are small; O(n)
//          memory.
#include "algorithms/broad_phase.h"
#ifdef TOUCHSTONE_HAS_EMBREE
#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace touchstone {
namespace {

// Embree's own limit, FLT_LARGE, is 1.84e18.
constexpr float largest = 0x1p60F;

float reach_of(const Aabb& box) {
  float reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::abs(box.min[axis]), std::abs(box.max[axis])});
  }
  return reach;
}

// Embree builds four primitives and fewer by another method, which aborts on coincident points (an
// assertion). Empty primitives, which it skips, fill up to this number.
constexpr std::size_t fewest = 5;

RTCBounds to_embree(const Aabb& box, float scale) {
  return {scale * box.min[0], scale * box.min[1], scale * box.min[2], 0,
          scale * box.max[0], scale * box.max[1], scale * box.max[2], 0};
}

// Pins each thread that enters the arena as the executor's thread of the same place is.
class Pins final : public oneapi::tbb::task_scheduler_observer {
 public:
  Pins(oneapi::tbb::task_arena& arena, const Executor& executor)
      : task_scheduler_observer(arena), executor_(&executor) {
    observe(true);
  }
  ~Pins() override { observe(false); }
  Pins(const Pins&) = delete;
  Pins& operator=(const Pins&) = delete;

  void on_scheduler_entry(bool) override {
    executor_->pin(oneapi::tbb::this_task_arena::current_thread_index());
  }

 private:
  const Executor* executor_;
};

class EmbreeBroadPhase final : public PeerBroadPhase {
 public:
  EmbreeBroadPhase(Executor& executor, RTCBuildQuality quality)
      : quality_(quality),
        width_(static_cast<std::size_t>(executor.width())),
        arena_(executor.width()),
        pins_(arena_, executor),
        device_(rtcNewDevice(
            ("threads=" + std::to_string(executor.width()) + ",set_affinity=0").c_str())),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
  }
  ~EmbreeBroadPhase() override {
    rtcReleaseScene(scene_);  // the geometry goes with it
    rtcReleaseDevice(device_);
  }
  EmbreeBroadPhase(const EmbreeBroadPhase&) = delete;
  EmbreeBroadPhase& operator=(const EmbreeBroadPhase&) = delete;

  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    float reach = 0;
    primitives_.assign(boxes.size(), none);
    ids_.clear();
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (boxes[id].is_empty()) continue;
      reach = std::max(reach, reach_of(boxes[id]));
      primitives_[id] = static_cast<std::uint32_t>(ids_.size());
      ids_.push_back(id);
    }
    scale_ = reach < largest ? 1.0F : std::ldexp(1.0F, 59 - std::ilogb(reach));
    bounds_.assign(std::max(ids_.size(), fewest), to_embree(Aabb::empty(), 1));
    for (std::size_t i = 0; i < ids_.size(); ++i) bounds_[i] = to_embree(boxes[ids_[i]], scale_);
    attach();
    rtcCommitScene(scene_);
  }

  void update(const FrameChange& change) override {
    const auto held = [&](std::uint32_t id) {
      return scale_ * reach_of(change.boxes[id]) < largest;
    };
    if (!change.inserted.empty() || !change.removed.empty() ||
        !std::ranges::all_of(change.moved, held)) {
      return build(change.boxes);
    }
    boxes_ = change.boxes;
    for (const std::uint32_t id : change.moved) {
      bounds_[primitives_[id]] = to_embree(boxes_[id], scale_);
    }
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(width_);
    given_.assign(width_, {});
    candidates_ = 0;
    if (ids_.size() < 2) return Status::ok;
    Found found{*this, sink};
    arena_.execute([&] { rtcCollide(scene_, scene_, &Found::add, &found); });
    for (const Count& count : given_) candidates_ += count.pairs;
    switch (rtcGetDeviceError(device_)) {
      case RTC_ERROR_NONE: return Status::ok;
      case RTC_ERROR_OUT_OF_MEMORY: return Status::capacity;
      default: return Status::degenerate;
    }
  }

  // Embree frees the tree when the scene without its geometry is committed.
  void discard() override {
    if (geometry_ == nullptr) return;
    rtcDetachGeometry(scene_, 0);
    geometry_ = nullptr;
    rtcCommitScene(scene_);
  }
  void prepare(std::size_t slots) override {
    primitives_.reserve(slots);
    ids_.reserve(slots);
    bounds_.reserve(std::max(slots, fewest));
  }

  void convert(std::span<const Aabb> boxes) override {
    converted_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) converted_[i] = to_embree(boxes[i], scale_);
  }

  BroadPhaseWork work() const override { return {.candidates = candidates_}; }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  // A count of one thread, in a cache line of its own.
  struct alignas(64) Count {
    std::int64_t pairs = 0;
  };

  // The argument of Embree's callback. Its threads are those of the arena.
  struct Found {
    EmbreeBroadPhase& of;
    PairSink& sink;

    static void add(void* data, RTCCollision* collisions, unsigned count) {
      const auto& [of, sink] = *static_cast<Found*>(data);
      const auto place =
          static_cast<std::size_t>(oneapi::tbb::this_task_arena::current_thread_index());
      PairBuffer& out = sink.chunk(place);
      of.given_[place].pairs += count;
      for (unsigned i = 0; i < count; ++i) {
        const auto [geometry0, first, geometry1, second] = collisions[i];
        if (first >= second) continue;
        const std::uint32_t a = of.ids_[first];
        const std::uint32_t b = of.ids_[second];
        if (overlap(of.boxes_[a], of.boxes_[b])) out.push(a, b);
      }
    }
  };

  // Attaches a new geometry for each build: a refitted geometry would keep its tree.
  void attach() {
    if (geometry_ != nullptr) rtcDetachGeometry(scene_, 0);
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry_, quality_);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(bounds_.size()));
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(
        geometry_,
        [](const RTCBoundsFunctionArguments* asked) {
          const auto& self = *static_cast<const EmbreeBroadPhase*>(asked->geometryUserPtr);
          *asked->bounds_o = self.bounds_[asked->primID];
        },
        nullptr);
    rtcCommitGeometry(geometry_);
    rtcAttachGeometryByID(scene_, geometry_, 0);
    rtcReleaseGeometry(geometry_);  // the scene holds it
  }

  RTCBuildQuality quality_;
  std::size_t width_;
  oneapi::tbb::task_arena arena_;
  Pins pins_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
  std::span<const Aabb> boxes_;
  std::vector<std::uint32_t> ids_;         // indexed by primitive
  std::vector<std::uint32_t> primitives_;  // indexed by id
  std::vector<RTCBounds> bounds_;          // indexed by primitive
  std::vector<RTCBounds> converted_;       // scratch
  float scale_ = 1;                        // factor of the bounds' coordinates
  std::vector<Count> given_;               // indexed by thread
  std::int64_t candidates_ = 0;
};

template <RTCBuildQuality quality>
std::unique_ptr<BroadPhase> make(Executor& executor) {
  return std::make_unique<EmbreeBroadPhase>(executor, quality);
}
constexpr auto make_low = make<RTC_BUILD_QUALITY_LOW>;
constexpr auto make_refit = make<RTC_BUILD_QUALITY_REFIT>;

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<BroadPhaseEntry> peers_embree_broad_phase() {
  return {
      {.info = {.name = "embree-low",
                .citation = "Embree 3.13, rtcCollide, RTC_BUILD_QUALITY_LOW (Wald, Woop, Benthin, "
                            "Johnson, Ernst, SIGGRAPH 2014)",
                .origin = Origin::peer},
       .make = make_low},
      {.info = {.name = "embree-refit",
                .citation = "Embree 3.13, rtcCollide, RTC_BUILD_QUALITY_REFIT (Wald, Woop, "
                            "Benthin, Johnson, Ernst, SIGGRAPH 2014)",
                .origin = Origin::peer},
       .make = make_refit},
  };
}

}  // namespace touchstone::entries
