// What cells with meshes share: convex bodies by name, and concave phases that are ready to bind.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "algorithms/concave_phase.h"
#include "algorithms/core/shape.h"
#include "harness/base/random.h"

namespace touchstone::kinds {

inline constexpr std::array<std::string_view, 4> convex_names = {"sphere", "capsule", "box",
                                                                 "hull-32"};

// The shape with this greatest half extent (metres). Its numbers are floats, so that peers see the same body.
Shape convex_shape(std::string_view name, double size, base::Random& random);

// With the mid-phase `wide-bvh` and the narrow phase `certified`, if it takes any.
std::unique_ptr<ConcavePhase> make_phase(const ConcaveEntry& entry, Precision scalar, bool welds);

}  // namespace touchstone::kinds
