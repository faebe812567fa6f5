// The bodies of a scene as concave phases take them.
#pragma once

#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "harness/trade/configuration.h"
#include "harness/trade/pipeline/stand_ins.h"

namespace touchstone::trade {

// For each shape of the scene: its mesh, a solid if that is closed, where the configuration
// represents it by `mesh`; else a compound of its stand-in's parts. Shapes without a body are empty.
std::vector<ConcaveBody> whole_bodies(const SceneFrames& frames, const StandIns& stand_ins,
                                      const Configuration& configuration);

}  // namespace touchstone::trade
