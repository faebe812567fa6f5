// The random shapes of generated scenes.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/base/random.h"
#include "harness/scene/shape_reader.h"

namespace touchstone::scene {

// Distribution of sizes between the least and the greatest.
enum class SizeLaw : std::uint8_t { even, over_magnitudes };

struct ShapeMixDefaults {
  std::pair<double, double> size = {0.5, 1.5};  // metres
  double aspect = 0.5;
  SizeLaw law = SizeLaw::even;
};

// Reads `shapes`, `size`, `aspect` and `distinct`, and makes min(distinct, count) shapes; body i
// has the shape i modulo their number.
//   shapes    names, or tables {type, weight} (a random shape of that kind; hull: `points`), or
//             tables with the sizes, or a mesh, and a weight; default ["box"]
//   size      [least, greatest] length of a shape's longest side or diameter
//   aspect    least ratio of the other sides to the longest
//   distinct  the greatest number of different shapes, default 1000
std::vector<TurnedShape> make_shape_mix(files::TomlTable& table, ShapeReader& reader,
                                        std::int64_t count, const ShapeMixDefaults& defaults,
                                        base::Random& random);

}  // namespace touchstone::scene
