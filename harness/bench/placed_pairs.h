// Pairs of bodies for the kernel benchmarks, from two families of shapes, at a given distance or
// depth; and the queries for narrow phases, each algorithm on each two families, near and far.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/registry.h"
#include "harness/base/random.h"

namespace touchstone::bench {

// Random shapes of one sort, of about unit size (metres): sphere, capsule, box, cylinder, cone,
// ellipsoid, hull-N (N random points on a sphere), icosphere-N, halfspace.
struct ShapeFamily {
  std::string_view name;
  ShapeKind kind;
  Shape (*draw)(base::Random& random);
};
std::span<const ShapeFamily> shape_families();
// Null if there is no family with that name.
const ShapeFamily* find_family(std::string_view name);

// Two families, with a's kind before or equal to b's: every two kinds once, hull-32 for the hulls,
// and each family of hulls with itself.
struct FamilyPair {
  const ShapeFamily* a;
  const ShapeFamily* b;
  std::string name() const;  // "box-box", "sphere-hull-32"; "hull-512" for a family with itself
};
std::vector<FamilyPair> family_pairs();

// The distance between the bodies of a pair.
struct PairRegime {
  std::string_view name;  // "far", "gap-0.1", "gap-1e-3", "depth-1e-3", "deep"
  double distance;        // metres, signed: < 0 is minus the depth

  // Returns true if the task gives more than the answer at that distance.
  bool fits(Task task) const {
    return task == Task::intersect || (distance > 0 ? asks_distance(task) : asks_depth(task));
  }
};
std::span<const PairRegime> pair_regimes();

// Distinct pairs at random orientations and in random directions from each other, so that their
// nearest features are those of random bodies. The exact signed distance is the regime's, to one
// millionth of it or to 4e-16 m.
struct PlacedPairs {
  static constexpr std::size_t count = 256;

  ShapeKind kind_a, kind_b;
  std::vector<Shape> shapes;
  std::vector<Pose> poses;
  std::vector<std::uint32_t> shape_of, first, second;

  PlacedPairs(const FamilyPair& families, const PairRegime& regime);

  // A batch of `size` pairs from `begin` on.
  PairBatch batch(std::size_t begin, std::size_t size) const;
};

// The pairs are made when first requested, and kept.
const PlacedPairs& placed_pairs(const FamilyPair& families, const PairRegime& regime);

struct NarrowSubject {
  const NarrowPhaseEntry* entry;
  Precision scalar;
  Task task;
  FamilyPair families;
  PairRegime regime;

  std::string name() const;  // "narrow/gjk/double/hull-32/distance/gap-0.1"
};

// All queries of every narrow phase that is built.
std::vector<NarrowSubject> narrow_subjects();

}  // namespace touchstone::bench
