// The Pareto front of time against error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "harness/trade/errors.h"

namespace touchstone::trade {

// The number that counts as the error of a configuration.
enum class ErrorMeasure : std::uint8_t {
  verdicts,         // share of wrong verdicts
  false_negatives,  // share of the contacts that the configuration missed
  mean,             // mean error of distances or depths, as parts of the size
  p99,
  greatest,
  volume,  // greatest volume that a representation adds or loses, as a part of the body's
  // greatest distance of a representation's surface from the body's, as a part of the size
  hausdorff,
};
inline constexpr std::array<std::string_view, 7> error_measure_names = {
    "verdicts", "false-negatives", "mean", "p99", "greatest", "volume", "hausdorff"};
std::string_view to_string(ErrorMeasure measure);
ErrorMeasure default_measure(Task task);  // verdicts, or `greatest` if the task asks for a number

struct RepresentationSpread {
  Spread volume, hausdorff;  // spreads over bodies, as parts of their volume and of their size
};
RepresentationSpread spread_of(std::span<const proxies::RepresentationError> errors);

double error_of(const PointErrors& errors, const RepresentationSpread& representation,
                ErrorMeasure measure);

struct FrontPoint {
  double seconds, error;
};
// Returns the indices of the points that no other point dominates (as fast and as right, and better
// in one), by rising time. If two points are equal in both, the first is taken. NaN is never on the
// front.
std::vector<std::size_t> pareto_front(std::span<const FrontPoint> points);

}  // namespace touchstone::trade
