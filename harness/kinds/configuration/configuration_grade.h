// The rule that decides whether an answer about a robot's configuration is right.
#pragma once

#include <span>

#include "algorithms/configuration_query.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// A distance may be off by so many times the reach.
inline constexpr double configuration_margin = 1e-11;

// The greatest distance of a link or an obstacle from the origin (metres, at least 1).
double configuration_reach(const ConfigurationModel& model, std::span<const Pose> links);

// Whether a pair is in contact, and in which step a motion is first, is what `exact` says. `names_pair`: whether the
// pair that an answer names is in contact, or as near as the answer says.
Graded grade_configuration(ConfigurationTask task, const ConfigurationAnswer& answer,
                           const ConfigurationAnswer& exact, bool names_pair, double reach);

}  // namespace touchstone::kinds
