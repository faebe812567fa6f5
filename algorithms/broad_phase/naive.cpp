// Naive: test every box against every other.
// Paper:   none; this is the definition of the problem, and the reference for the other algorithms.
// Steps:   1. List the slots that have a body.
//          2. Gather their boxes into one array for each coordinate.
//          3. Cut the rows into tasks of 256 boxes.
//          4. For each task go through the boxes from its first row on, in tiles of 1024.
//          5. Test each row against the boxes of the tile that come after it, a vector at a time.
//          6. Write the pairs that overlap into the task's chunk of the sink.
// Departs: tests a vector of boxes at a time, in tiles that stay in the first-level cache.
// Fails:   quadratic, whatever the scene.
// Cost:    O(n^2) time, O(n) memory beside the output.
#include "algorithms/broad_phase.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_scan.h"

namespace touchstone {
namespace {

class Naive final : public BroadPhase {
 public:
  explicit Naive(Executor& executor) : executor_(executor) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    arrays_.gather(executor_, boxes, ids_.size(), [&](std::size_t i) { return ids_[i]; });
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    sink.start(block_count(arrays_.size(), rows_a_task));
    for_each_block(executor_, arrays_.size(), rows_a_task,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     // The first tile contains all of the task's rows; the others come after them.
                     for (std::size_t tile = first; tile < arrays_.size(); tile += tile_size) {
                       const IndexRange columns{tile, std::min(tile + tile_size, arrays_.size())};
                       scan_boxes(arrays_, {first, last}, {&columns, 1}, sink.chunk(task));
                     }
                   });
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    const auto pairs =
        static_cast<std::int64_t>(pairs_of_scan({0, arrays_.size()}, {0, arrays_.size()}));
    return {.box_tests = pairs,
            .node_visits = 0,
            .candidates = pairs,
            .bytes = sum_held_bytes(ids_, arrays_)};
  }

 private:
  static constexpr std::size_t rows_a_task = 256;
  static constexpr std::size_t tile_size = 1024;  // 24 KiB of boxes

  Executor& executor_;
  std::vector<std::uint32_t> ids_;
  AabbSoA arrays_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_naive() {
  return {{.info = {.name = "naive", .citation = "definition: every pair of boxes is tested"},
           .make = [](Executor& executor) { return std::make_unique<Naive>(executor); }}};
}

}  // namespace touchstone::entries
