// The size of a generated world.
#pragma once

#include <functional>
#include <span>

#include "harness/base/random.h"
#include "harness/files/toml_table.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// The region of a body's origin, all places equally likely: [low, low + width] (metres).
struct Region {
  Vec3d low, width;
};
// Returns the region of a body in a world of the given side. All regions of one side must have the
// same width.
using RegionOf = std::function<Region(std::size_t body, double side)>;

// The tight boxes of the bodies with their origins moved to the world's origin.
std::vector<Aabb> boxes_at_origin(const Scene& scene);

// The expected number of other boxes that a body's box overlaps, from all pairs of boxes, or from
// 16,384 random ones if there are more (262,144 from 200,000 boxes on).
double expected_overlaps(std::span<const Aabb> boxes, const RegionOf& region, double side,
                         base::Random random);

struct WorldDefaults {
  double overlaps = 2;
  double density = 0;  // replaces overlaps if > 0
};

// Reads `overlaps` (expected overlapping boxes per body at frame 0) or `density` (the share of the
// cube that the bodies' unrotated boxes would fill, Broadmark's measure). Returns the side of the
// world (metres), rounded to 16 bits so that differences between platforms vanish. Without
// `with_density` only overlaps are read.
double read_world_side(files::TomlTable& table, const Scene& scene, const RegionOf& region,
                       const WorldDefaults& defaults, bool with_density, base::Random random);

}  // namespace touchstone::scene
