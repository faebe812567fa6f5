// The configurations that are compared: every combination of the axes of some grids, without those
// that make no sense for the scene.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/trade/evaluation.h"

namespace touchstone::trade {

struct TradeGrid {
  std::vector<Representations> representations = {{}};
  std::vector<BoxChoice> boxes = {{}};
  std::vector<const BroadPhaseEntry*> broad;
  std::vector<NarrowChain> narrow;
  std::vector<Precision> scalars = {Precision::float64};
  std::vector<std::optional<double>> tolerances = {std::nullopt};  // none: the algorithm's own
  std::vector<std::optional<int>> max_iterations = {std::nullopt};
};

// A grid of just this one.
TradeGrid grid_of(const Configuration& configuration);

struct GridPoints {
  std::vector<TradePoint> points;       // in the grids' order, each once
  std::map<std::string, int> left_out;  // combinations by the reason
};

// Representations that mean the same for the scene are one; of a chain of narrow phases only those
// stay that some pair comes to. Left out: what cannot be represented so, pairs that no narrow phase
// of the chain takes, a scalar that one of them has not, no narrow phase where a number is asked
// for or the scene lists its pairs, and what is the same as another.
GridPoints expand(std::span<const TradeGrid> grids, const SceneFrames& frames,
                  StandInLibrary& library, Task task);

// The comparison of a request without grids: algorithms in both scalars, tolerances, caps of
// iterations, kinds of boxes and broad phases, and representations; the first is the baseline.
// `broad` is the one that all but the grid of broad phases use.
std::vector<TradeGrid> default_grids(Task task, const BroadPhaseEntry& broad);
// Configurations that differ from this one by boxes and broad phase, or by narrow phases and
// scalar: every combination of those of default_grids.
std::vector<TradeGrid> grids_like(const Configuration& configuration, Task task);
// The broad phase of default_grids that is the fastest on this scene, by a short trial.
const BroadPhaseEntry& fastest_broad(const SceneFrames& frames, StandInLibrary& library);
// Adds grids in which one kind of bodies is represented, where there are several kinds.
void add_kinds(const SceneFrames& frames, std::vector<TradeGrid>& grids);

}  // namespace touchstone::trade
