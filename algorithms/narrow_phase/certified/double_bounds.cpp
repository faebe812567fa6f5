// Part of certified: the bounds of double_bounds.h.
#include "algorithms/narrow_phase/certified/double_bounds.h"

#include <algorithm>
#include <limits>

#include "algorithms/narrow_phase/certified/enclosure.h"

namespace touchstone {
namespace {

// Heights and lengths are at most 8 units, so two subtractions from one, and a division by a sum of
// weights, add at most 16 half epsilons.
constexpr double off = proven_rounding + 8 * std::numeric_limits<double>::epsilon();

// The product with a power of two is exact, and underflow is less than what `off` has to spare.
DistanceBounds in_metres(const SupportPair<double>& pair, double lower, double upper) {
  if (!(pair.unit() > 0x1p-960)) return {};
  return {pair.unit() * lower, pair.unit() * upper};
}

}  // namespace

DistanceBounds between_in_doubles(const SupportPair<double>& pair,
                                  const GjkDistanceResult<double>& found) {
  if (!(found.lower > off)) return {};
  // A search that stopped at a plane has not set the weights: they may be anything.
  double weights = 0;
  for (int i = 0; i < found.simplex.size; ++i) {
    if (!(found.simplex.weights[i] >= 0)) return {};
    weights += found.simplex.weights[i];
  }
  if (!(weights > 0.5)) return {};
  const double distance = distance_from_origin(found.simplex) / weights;
  return in_metres(pair, found.lower - off - pair.radius(), distance + off - pair.radius());
}

DistanceBounds inside_in_doubles(const SupportPair<double>& pair, const EpaHull<double>& surface,
                                 double depth) {
  // The distance of a face's triangle along its normal is that of its nearest corner.
  double least = std::numeric_limits<double>::infinity();
  const bool encloses = surface.all_faces([&](int face) {
    const std::array<Vec3d, 3> points = surface.points(surface.corners(face));
    if (!is_surely_behind(points)) return false;
    const Vec3d n = surface.normal(face);
    least = std::min({least, n.dot(points[0]), n.dot(points[1]), n.dot(points[2])});
    return n.allFinite();
  });
  if (!encloses || !(least < std::numeric_limits<double>::infinity())) return {};
  return in_metres(pair, -(depth + off), off - least);
}

double tolerance_in_doubles(const SupportPair<double>& pair, double widest) {
  return 0.5 * (widest / pair.unit() - 2 * off);
}

}  // namespace touchstone
