// Expands grids into the configurations that make sense for a scene.
#include "harness/trade/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/base/error.h"
#include "harness/record/query_task.h"
#include "harness/trade/pipeline/whole_bodies.h"

namespace touchstone::trade {
namespace {

// Returns the narrow phases of the chain that take some pair of the scene; nothing, with the
// reason, if a pair is taken by none.
std::optional<NarrowChain> used(const NarrowChain& chain, const StandIns& stand_ins, Task task,
                                std::string& reason) {
  std::set<const NarrowPhaseEntry*> taking;
  for (const auto& [a, b] : stand_ins.kind_pairs) {
    const auto taker = std::ranges::find_if(
        chain, [&](const NarrowPhaseEntry* entry) { return offers(*entry, a, b, task); });
    if (taker == chain.end()) {
      reason = fmt::format("{} does not take {}-{} for {}", chain_name(chain), to_string(a),
                           to_string(b), to_string(task));
      return {};
    }
    taking.insert(*taker);
  }
  NarrowChain left;
  for (const NarrowPhaseEntry* entry : chain) {
    if (taking.contains(entry)) left.push_back(entry);
  }
  return left;
}

class Expansion {
 public:
  Expansion(const SceneFrames& frames, StandInLibrary& library, Task task)
      : frames_(&frames), library_(&library), task_(task) {}

  void add(const TradeGrid& grid) {
    for (const Representations& asked : grid.representations) {
      const Representations representations = library_->complete(asked);
      std::shared_ptr<const StandIns> stand_ins;
      try {
        stand_ins = library_->get(representations);
      } catch (const base::InputError& error) {
        leave_out(fmt::format("{}: {}", representations.name(), error.what()));
        continue;
      }
      Configuration configuration;
      configuration.representations = representations;
      for (const BoxChoice& boxes : grid.boxes) {
        configuration.boxes = boxes;
        for (const BroadPhaseEntry* broad : grid.broad) {
          configuration.broad = broad;
          if (!frames_->scene->pairs.empty()) {
            configuration.boxes = {};
            configuration.broad = nullptr;
          }
          for (const NarrowChain& chain : grid.narrow) add(configuration, stand_ins, grid, chain);
          for (const ConcaveEntry* entry : grid.concave) {
            add(configuration, stand_ins, grid, *entry);
          }
        }
      }
    }
  }

  GridPoints points;

 private:
  void leave_out(const std::string& reason) { ++points.left_out[reason]; }

  void add(Configuration configuration, const std::shared_ptr<const StandIns>& stand_ins,
           const TradeGrid& grid, const NarrowChain& chain) {
    if (chain.empty()) {
      configuration.narrow = {};
      configuration.settings = {};
      if (task_ != Task::intersect) return leave_out("without a narrow phase there are no numbers");
      if (configuration.broad == nullptr) {
        return leave_out("the scene lists its pairs: without a narrow phase nothing is left to do");
      }
      return keep(configuration, stand_ins);
    }
    std::string reason;
    const std::optional<NarrowChain> narrow = used(chain, *stand_ins, task_, reason);
    if (!narrow) return leave_out(reason);
    configuration.narrow = *narrow;
    for (const Precision scalar : grid.scalars) {
      const auto lacks = std::ranges::find_if_not(
          *narrow, [&](const NarrowPhaseEntry* entry) { return offers(*entry, scalar); });
      if (lacks != narrow->end()) {
        leave_out(fmt::format("{} has no {}", (*lacks)->info.name, to_string(scalar)));
        continue;
      }
      for (const std::optional<double> tolerance : grid.tolerances) {
        for (const std::optional<int> cap : grid.max_iterations) {
          configuration.settings = {
              .scalar = scalar, .tolerance = tolerance, .max_iterations = cap};
          keep(configuration, stand_ins);
        }
      }
    }
  }

  void add(Configuration configuration, const std::shared_ptr<const StandIns>& stand_ins,
           const TradeGrid& grid, const ConcaveEntry& entry) {
    if (std::ranges::all_of(frames_->mesh_of, [](const auto* mesh) { return mesh == nullptr; })) {
      return leave_out("no body has a mesh: concave phases have nothing to do");
    }
    const std::optional<ConcaveTask> task = record::concave_task(record::query_task(task_));
    configuration.concave = &entry;
    for (const Precision scalar : grid.scalars) {
      if (!task || !offers(entry, *task, scalar)) {
        leave_out(fmt::format("{} has no {} for {}", entry.info.name, to_string(scalar),
                              to_string(task_)));
        continue;
      }
      configuration.settings = {.scalar = scalar};
      const std::vector<ConcaveBody> bodies = whole_bodies(*frames_, *stand_ins, configuration);
      const bool all =
          entry.supports == nullptr || std::ranges::all_of(bodies, [&](const ConcaveBody& a) {
            return std::ranges::all_of(bodies,
                                       [&](const ConcaveBody& b) { return entry.supports(a, b); });
          });
      if (all) {
        keep(configuration, stand_ins);
      } else {
        leave_out(fmt::format("{} does not take all bodies", entry.info.name));
      }
    }
  }

  void keep(const Configuration& configuration, const std::shared_ptr<const StandIns>& stand_ins) {
    if (!names_.insert(configuration.name()).second) return leave_out("the same as another");
    points.points.push_back({configuration, stand_ins});
  }

  const SceneFrames* frames_;
  StandInLibrary* library_;
  Task task_;
  std::set<std::string> names_;
};

}  // namespace

TradeGrid grid_of(const Configuration& configuration) {
  TradeGrid grid;
  grid.representations = {configuration.representations};
  grid.boxes = {configuration.boxes};
  grid.broad = {configuration.broad};
  if (configuration.concave != nullptr) {
    grid.concave = {configuration.concave};
  } else {
    grid.narrow = {configuration.narrow};
  }
  grid.scalars = {configuration.settings.scalar};
  grid.tolerances = {configuration.settings.tolerance};
  grid.max_iterations = {configuration.settings.max_iterations};
  return grid;
}

GridPoints expand(std::span<const TradeGrid> grids, const SceneFrames& frames,
                  StandInLibrary& library, Task task) {
  Expansion expansion(frames, library, task);
  for (const TradeGrid& grid : grids) expansion.add(grid);
  return std::move(expansion.points);
}

}  // namespace touchstone::trade
