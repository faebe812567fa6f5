// Shuffles a cyclic Latin square.
#include "harness/measure/latin_square.h"

#include <numeric>
#include <utility>

namespace touchstone::measure {
namespace {

std::vector<std::size_t> shuffled(std::size_t size, base::Random& random) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

}  // namespace

LatinSquare latin_square(std::size_t size, base::Random& random) {
  const std::vector<std::size_t> rounds = shuffled(size, random);
  const std::vector<std::size_t> positions = shuffled(size, random);
  const std::vector<std::size_t> contestants = shuffled(size, random);
  LatinSquare square(size, std::vector<std::size_t>(size));
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t p = 0; p < size; ++p) {
      square[r][p] = contestants[(rounds[r] + positions[p]) % size];
    }
  }
  return square;
}

}  // namespace touchstone::measure
