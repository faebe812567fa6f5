// References for tests of continuous collision, which share nothing with the algorithms.
#pragma once

#include <optional>

#include "algorithms/ccd.h"

namespace touchstone::reference {

// The first time of contact, for coordinates that are small integers (up to some hundreds): roots
// and distances in floating-point numbers of 640 bits. Numbers that are not zero are far greater
// than its thresholds there, since they are algebraic of small height. The double is rounded.
std::optional<double> first_contact_of_small(FeaturePair pair, const CcdQuery& query);

// The distance of the features at a time, in long doubles: the least of the distances of all parts
// (vertices, edges and the face), so that parallel and degenerate ones need no care.
double distance_at(FeaturePair pair, const CcdQuery& query, double time);

}  // namespace touchstone::reference
