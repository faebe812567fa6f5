// The order in which contestants run.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/base/random.h"

namespace touchstone::measure {

// Round r, position p: which of `size` contestants runs. Each is once in every round and once in
// every position, so that neither being first nor a drift over the rounds favours one. A cyclic
// square with its rounds, positions and contestants shuffled (Fisher and Yates 1938).
using LatinSquare = std::vector<std::vector<std::size_t>>;
LatinSquare latin_square(std::size_t size, base::Random& random);

}  // namespace touchstone::measure
