// Draws separations, and finds a least distance by golden sections.
#include "harness/kinds/feature/feature_lengths.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "harness/kinds/feature/feature_forms.h"

namespace touchstone::kinds {
namespace {

// A distance of the features (metres) that is less than those shortly before and after.
double least_distance(const CcdQuery& query, int first_count, oracle::Oracle& oracle) {
  constexpr int looks = 16, sections = 40;
  const auto distance = [&](double time) { return distance_at(query, first_count, time, oracle); };
  int nearest = 0;
  double least = distance(0);
  for (int look = 1; look <= looks; ++look) {
    const double found = distance(1.0 * look / looks);
    if (found < least) {
      least = found;
      nearest = look;
    }
  }
  double begin = std::max(nearest - 1, 0) / (1.0 * looks);
  double end = std::min(nearest + 1, looks) / (1.0 * looks);
  for (int k = 0; k < sections; ++k) {
    const double part = (end - begin) / std::numbers::phi;
    const double at_first = distance(end - part), at_second = distance(begin + part);
    least = std::min({least, at_first, at_second});
    (at_first < at_second ? end : begin) = at_first < at_second ? begin + part : end - part;
  }
  return least;
}

}  // namespace

CcdSize ccd_size(std::uint64_t index) {
  constexpr std::array<CcdSize, 6> sizes = {
      {{1, 1e-6}, {0x1p-20, 0x1p-40}, {0x1p20, 1}, {0x1p-7, 1e-10}, {0x1p10, 0}, {1e-2, 1e-8}}};
  return sizes[index / queries_of_a_call % sizes.size()];
}

Lengths separated_lengths(std::uint64_t index, const CcdQuery& query, int first_count,
                          oracle::Oracle& oracle) {
  constexpr std::array<double, 5> separations = {0x1p-3, 1e-3, 0x1p-20, 1, 1e-9};
  constexpr std::uint64_t close = 16;
  const CcdSize size = ccd_size(index);
  if (index % close == 0) {
    const double half = (index / close % 2 == 0 ? 0.5 : -0.5) * size.tolerance;
    const double separation = least_distance(query, first_count, oracle) + half;
    if (separation > 0) return {size.tolerance, separation};
  }
  return {size.tolerance, size.scale * separations[index / queries_of_a_call % separations.size()]};
}

}  // namespace touchstone::kinds
