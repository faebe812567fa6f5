// Finds the side of a world with a given number of expected overlaps, or a given density.
#include "harness/scene/generators/world_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algorithms/core/bounds.h"
#include "harness/scene/concave_shape.h"

namespace touchstone::scene {
namespace {

// Many bodies need a larger sample: the smaller the share of overlapping pairs, the fewer a sample
// has.
constexpr std::size_t many_bodies = 200'000;
constexpr std::size_t sampled_of_few = 16'384, sampled_of_many = 262'144;

// The probability P(X - Y <= x) for X and Y uniform on [0, 1].
double triangle(double x) {
  if (x <= -1) return 0;
  if (x >= 1) return 1;
  return x < 0 ? (1 + x) * (1 + x) / 2 : 1 - (1 - x) * (1 - x) / 2;
}

double overlap_probability(const Aabb& a, const Region& at, const Aabb& b, const Region& bt) {
  double probability = 1;
  for (int axis = 0; axis < 3; ++axis) {
    // The intervals share a point if the difference of the origins is in [low, high].
    const auto i = static_cast<std::size_t>(axis);
    const double between = bt.low[axis] - at.low[axis];
    const double low = static_cast<double>(a.min[i]) - static_cast<double>(b.max[i]) - between;
    const double high = static_cast<double>(a.max[i]) - static_cast<double>(b.min[i]) - between;
    const double width = at.width[axis];
    probability *= width > 0 ? triangle(high / width) - triangle(low / width)
                             : (low <= 0 && high >= 0 ? 1.0 : 0.0);
  }
  return probability;
}

double round_to_16_bits(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(mantissa * 0x1p16 + 0.5), exponent - 16);
}

// The sum of the volumes of the bodies' boxes, each in its own frame.
double own_volume(const Scene& scene) {
  std::vector<double> volumes;
  for (const Shape& shape : scene.shapes) {
    const Aabb box = tight_box(shape, Pose{});
    double volume = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      volume *= static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
    }
    volumes.push_back(volume);
  }
  double sum = 0;
  for (const Body& body : scene.bodies) sum += volumes[body.shape];
  return sum;
}

// Returns the side at which that many overlaps are expected, or 0 if no side has so many.
double side_for_overlaps(double overlaps, std::span<const Aabb> boxes, const RegionOf& region,
                         const base::Random& random) {
  const auto expect = [&](double side) { return expected_overlaps(boxes, region, side, random); };
  double low = 1, high = 1;
  for (int i = 0; expect(low) < overlaps; ++i) {
    if (i == 100) return 0;
    low /= 2;
  }
  while (expect(high) > overlaps) high *= 2;
  for (int i = 0; i < 18; ++i) {
    const double middle = (low + high) / 2;
    (expect(middle) >= overlaps ? low : high) = middle;
  }
  return high;
}

}  // namespace

std::vector<Aabb> boxes_at_origin(const Scene& scene) {
  std::vector<Aabb> boxes;
  for (const Body& body : scene.bodies) {
    const Shape& shape = scene.shapes[body.shape];
    const Pose turned{body.pose.rotation, Vec3d::Zero()};
    const ConcaveBody* concave = scene.concave_of(body.shape);
    boxes.push_back(concave != nullptr ? concave_box(*concave, shape, turned)
                                       : tight_box(shape, turned));
  }
  return boxes;
}

double expected_overlaps(std::span<const Aabb> boxes, const RegionOf& region, double side,
                         base::Random random) {
  const std::size_t n = boxes.size();
  if (n < 2) return 0;
  double sum = 0;
  std::size_t pairs = 0;
  const std::size_t sampled_pairs = n > many_bodies ? sampled_of_many : sampled_of_few;
  const auto add = [&](std::size_t i, std::size_t j) {
    sum += overlap_probability(boxes[i], region(i, side), boxes[j], region(j, side));
    ++pairs;
  };
  if (n * (n - 1) / 2 <= sampled_pairs) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) add(i, j);
    }
  } else {
    while (pairs < sampled_pairs) {
      const std::size_t i = random.below(n), j = random.below(n);
      if (i != j) add(i, j);
    }
  }
  return sum / static_cast<double>(pairs) * static_cast<double>(n - 1);
}

double read_world_side(files::TomlTable& table, const Scene& scene, const RegionOf& region,
                       const WorldDefaults& defaults, bool with_density, base::Random random) {
  const auto others = static_cast<double>(scene.bodies.size()) - 1;
  const bool asked = table.has("overlaps");
  if (with_density && (table.has("density") || (defaults.density > 0 && !asked))) {
    if (asked) table.fail("overlaps", "given beside density; expected one of the two");
    const double density = table.number("density", files::positive, defaults.density);
    return round_to_16_bits(base::cube_root(own_volume(scene) / density));
  }
  // Few bodies have few overlaps by default.
  const double overlaps =
      asked ? table.number("overlaps", files::positive) : std::min(defaults.overlaps, others / 2);
  if (!(overlaps > 0)) return round_to_16_bits(base::cube_root(own_volume(scene)) + 1);
  const double side =
      overlaps < others ? side_for_overlaps(overlaps, boxes_at_origin(scene), region, random) : 0;
  if (side == 0) {
    table.fail("overlaps", fmt::format("found {}; {} bodies in this arrangement cannot have so "
                                       "many: expected fewer",
                                       overlaps, scene.bodies.size()));
  }
  return round_to_16_bits(side);
}

}  // namespace touchstone::scene
