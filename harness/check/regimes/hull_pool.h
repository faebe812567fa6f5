// The hulls of the generated cases, which take too long to build to be built for each.
#pragma once

#include <cstdint>
#include <memory>

#include "harness/check/regimes/check_shapes.h"

namespace touchstone::check {

// Hull `entry` of the style, for the seed: random points, tetrahedra, split icosahedra, subsets of
// a grid (coplanar points) and prisms, of 4 to 64 vertices and, for two entries, up to 512; some
// lie away from their local origin. It depends on nothing else; the first call builds it and later
// ones may find it again. Safe to call from several threads.
std::shared_ptr<const Hull> pooled_hull(std::uint64_t seed, std::uint64_t entry,
                                        const ShapeStyle& style);

// Each vertex v becomes -v, exactly. Found again too where the hull is one of the pool's.
std::shared_ptr<const Hull> mirrored_hull(const Hull& hull);

}  // namespace touchstone::check
