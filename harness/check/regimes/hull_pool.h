// The hulls of generated cases, built once each, since building takes long.
#pragma once

#include <cstdint>
#include <memory>

#include "harness/check/regimes/check_shapes.h"

namespace touchstone::check {

// Returns hull `entry` of the style, for the seed: random points, tetrahedra, split icosahedra,
// subsets of a grid (coplanar points) and prisms, of 4 to 64 vertices and, for two entries, up to
// 512; some lie away from their local origin. It depends on nothing else. The first call builds it,
// and later ones may find it again. Safe to call from several threads.
std::shared_ptr<const Hull> pooled_hull(std::uint64_t seed, std::uint64_t entry,
                                        const ShapeStyle& style);

// Returns the point reflection: each vertex v becomes -v, exactly. It is kept too if the hull is in
// the pool.
std::shared_ptr<const Hull> mirrored_hull(const Hull& hull);

}  // namespace touchstone::check
