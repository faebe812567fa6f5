// How large a generated world must be.
#pragma once

#include <functional>
#include <span>

#include "harness/base/random.h"
#include "harness/files/toml_table.h"
#include "harness/scene/scene.h"

namespace touchstone {

// Where a body's origin may be, each place equally likely: [low, low + width] (metres).
struct Region {
  Vec3d low, width;
};
// The region of a body in a world of the given side; all regions of one side have the same width.
using RegionOf = std::function<Region(std::size_t body, double side)>;

// The tight boxes of the bodies as if their origins were the world's.
std::vector<Aabb> boxes_at_origin(const Scene& scene);

// The number of other boxes that a body's box is expected to overlap, from every pair of boxes, or
// 16,384 random ones where there are more (262,144 from 200,000 boxes on).
double expected_overlaps(std::span<const Aabb> boxes, const RegionOf& region, double side,
                         Random random);

struct WorldDefaults {
  double overlaps = 2;
  double density = 0;  // takes the place of overlaps where > 0
};

// Reads `overlaps` (expected overlapping boxes a body, at frame 0) or `density` (the share of the
// cube that the bodies' own boxes, unturned, would fill; Broadmark's measure) and returns the side
// of the world (metres), rounded to 16 bits so that no platform's last digit shows. Without
// `with_density` only overlaps are taken.
double read_world_side(TomlTable& table, const Scene& scene, const RegionOf& region,
                       const WorldDefaults& defaults, bool with_density, Random random);

}  // namespace touchstone
