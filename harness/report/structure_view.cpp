// Runs broad phases on the frames of a scene and asks for what they keep.
#include "harness/report/structure_view.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "harness/report/packed_numbers.h"

namespace touchstone::report {
namespace {

using files::OrderedJson;

OrderedJson structure_view(BroadPhase& broad, const measure::BlockInput& input, bool& shows) {
  OrderedJson frames = OrderedJson::array();
  for (const measure::BlockFrame& frame : input.frames) {
    if (frames.empty()) {
      broad.build(frame.boxes);
    } else {
      broad.update(frame.change());
    }
    // Some decide in the search what they keep.
    PairSink sink;
    broad.find_pairs(sink);
    std::vector<float> corners;
    std::vector<std::uint8_t> levels;
    for (const StructureBox& each : broad.structure()) {
      append(corners, each.box);
      levels.push_back(static_cast<std::uint8_t>(std::min(each.level, 255u)));
    }
    shows = shows || !levels.empty();
    frames.push_back({{"boxes", packed(corners)}, {"levels", packed(levels)}});
  }
  return frames;
}

}  // namespace

void append(std::vector<float>& numbers, const Aabb& box) {
  numbers.insert(numbers.end(), box.min.begin(), box.min.end());
  numbers.insert(numbers.end(), box.max.begin(), box.max.end());
}

OrderedJson structure_views(const measure::BlockInput& input,
                            const std::vector<const BroadPhaseEntry*>& broad) {
  Executor executor(1);
  OrderedJson views = OrderedJson::array();
  for (const BroadPhaseEntry* entry : broad) {
    bool shows = false;
    const std::unique_ptr<BroadPhase> algorithm = entry->make(executor);
    OrderedJson frames = structure_view(*algorithm, input, shows);
    if (shows) views.push_back({{"broad", entry->info.name}, {"frames", std::move(frames)}});
  }
  return views;
}

}  // namespace touchstone::report
