// Sets of boxes that broad phases are tried on, and the truth about them.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

struct BoxSet {
  std::string name;
  std::vector<Aabb> boxes;
  // Where a peer with a known defect may err: boxes that touch exactly, have no volume, coincide,
  // or lie where floats are coarse.
  bool degenerate = false;
  // Beyond what libraries are made for: only our own algorithms are held to it.
  bool extreme = false;
};

using Random = std::mt19937_64;

// In [low, high], the same on every platform.
float uniform(Random& random, float low, float high);

// `count` boxes of sides up to `side` with minima in [0, 1)^3.
std::vector<Aabb> uniform_boxes(Random& random, std::size_t count, float side);

std::vector<BoxSet> box_sets();

// What was found, ascending.
std::vector<IndexPair> sorted(const PairSink& sink);

// Every pair that overlaps, ascending, by definition.
std::vector<IndexPair> true_pairs(std::span<const Aabb> boxes);

}  // namespace touchstone
