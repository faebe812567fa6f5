// Latin squares: the order in which contestants run.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/base/random.h"

namespace touchstone::measure {

// The entry of round r and position p is one of `size` contestants. Each occurs once in every round
// and once in every position, so that neither the first position nor a drift over the rounds
// favours one. It is a cyclic square with its rounds, positions and contestants shuffled (Fisher
// and Yates 1938).
using LatinSquare = std::vector<std::vector<std::size_t>>;
LatinSquare latin_square(std::size_t size, base::Random& random);

}  // namespace touchstone::measure
