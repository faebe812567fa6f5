// Part of the oracle, used by the checks of certificates and by what makes them: boxes around bodies.
#pragma once

#include <optional>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/part_tree.h"

namespace touchstone::oracle {

// A box in world coordinates that holds the body, and of an empty one any; none of one with a half-space. Throws Fault
// if the body is invalid.
std::optional<RationalBox> world_box(const ConcaveBody& body, const Pose& pose);

// The greatest n . x over the box.
mpq_class support(const RationalVector& n, const RationalBox& box);

}  // namespace touchstone::oracle
