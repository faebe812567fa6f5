// The Pareto front of time against error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "harness/trade/errors.h"

namespace touchstone::trade {

// The number that is taken as the error of a configuration.
enum class ErrorMeasure : std::uint8_t {
  verdicts,         // share of wrong verdicts
  false_negatives,  // share of the contacts that were missed
  mean,             // of the values: distances or depths, as parts of the size
  p99,
  greatest,
  volume,     // of the representations: greatest volume added and lost, as a part of the body's
  hausdorff,  // the same: greatest distance of surfaces, as a part of the size
};
inline constexpr std::array<std::string_view, 7> error_measure_names = {
    "verdicts", "false-negatives", "mean", "p99", "greatest", "volume", "hausdorff"};
std::string_view to_string(ErrorMeasure measure);
ErrorMeasure default_measure(Task task);  // verdicts, or greatest where a number is asked for

struct RepresentationSpread {
  Spread volume, hausdorff;  // over bodies, as parts of their volume and of their size
};
RepresentationSpread spread_of(std::span<const proxies::RepresentationError> errors);

double error_of(const PointErrors& errors, const RepresentationSpread& representation,
                ErrorMeasure measure);

struct FrontPoint {
  double seconds, error;
};
// Indices of the points that no other beats: none is as fast and as right, and better in one. By
// rising time. Of points that are equal in both, the first. NaN is never on it.
std::vector<std::size_t> pareto_front(std::span<const FrontPoint> points);

}  // namespace touchstone::trade
