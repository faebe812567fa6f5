// Grids of configurations: the combinations of some axes that make sense for a scene.
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
  std::vector<const ConcaveEntry*> concave;  // beside these
  std::vector<Precision> scalars = {Precision::float64};
  std::vector<std::optional<double>> tolerances = {std::nullopt};  // empty: the algorithm's own
  std::vector<std::optional<int>> max_iterations = {std::nullopt};
};

// A grid of this one configuration.
TradeGrid grid_of(const Configuration& configuration);

struct GridPoints {
  std::vector<TradePoint> points;       // in the order of the grids, each configuration once
  std::map<std::string, int> left_out;  // the number of combinations by reason
};

// Representations that mean the same for the scene count as one, and a chain of narrow phases keeps
// only those that take some pair. Combinations are left out if a body cannot be represented so, if
// no narrow phase of the chain takes some pair, if one of them does not have the scalar, if there
// is no narrow phase although a number is asked for or the scene lists its pairs, or if they equal
// another. Concave phases are left out if no body has a mesh, and for tasks that they do not have; narrow phases
// where a mesh stays as it is given.
GridPoints expand(std::span<const TradeGrid> grids, const SceneFrames& frames,
                  StandInLibrary& library, Task task);

// The grids of a request without grids: algorithms in both scalars, tolerances, caps of iterations,
// kinds of boxes and broad phases, and representations; the first is the baseline. All grids use
// the broad phase `broad`, except the grid of broad phases.
std::vector<TradeGrid> default_grids(Task task, const BroadPhaseEntry& broad);
// Configurations that differ from this one by boxes and broad phase, or by narrow phases and
// scalar: every combination of those of default_grids.
std::vector<TradeGrid> grids_like(const Configuration& configuration, Task task);
// Returns the broad phase of default_grids that is the fastest on this scene, by a short trial.
const BroadPhaseEntry& fastest_broad(const SceneFrames& frames, StandInLibrary& library);
// Adds grids in which only one kind of bodies is represented, if there are several kinds.
void add_kinds(const SceneFrames& frames, std::vector<TradeGrid>& grids);

}  // namespace touchstone::trade
