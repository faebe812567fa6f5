// The Pareto front, and names of error measures.
#include "harness/trade/front.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace touchstone::trade {

std::string_view to_string(ErrorMeasure measure) {
  return error_measure_names[static_cast<std::size_t>(measure)];
}

ErrorMeasure default_measure(Task task) {
  return task == Task::intersect ? ErrorMeasure::verdicts : ErrorMeasure::greatest;
}

RepresentationSpread spread_of(std::span<const proxies::RepresentationError> errors) {
  std::vector<double> volumes, distances;
  for (const proxies::RepresentationError& error : errors) {
    volumes.push_back(error.volume_error());
    distances.push_back(error.size > 0 ? error.hausdorff / error.size : 0);
  }
  return {spread_of(std::move(volumes)), spread_of(std::move(distances))};
}

double error_of(const PointErrors& errors, const RepresentationSpread& representation,
                ErrorMeasure measure) {
  switch (measure) {
    case ErrorMeasure::verdicts: return errors.wrong_share();
    case ErrorMeasure::false_negatives: return errors.false_negative_share();
    case ErrorMeasure::mean: return errors.value.mean;
    case ErrorMeasure::p99: return errors.value.p99;
    case ErrorMeasure::greatest: return errors.value.greatest;
    case ErrorMeasure::volume: return representation.volume.greatest;
    case ErrorMeasure::hausdorff: break;
  }
  return representation.hausdorff.greatest;
}

std::vector<std::size_t> pareto_front(std::span<const FrontPoint> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) {
    return std::isnan(points[i].seconds) || std::isnan(points[i].error);
  });
  std::ranges::stable_sort(order, [&](std::size_t i, std::size_t j) {
    return points[i].seconds != points[j].seconds ? points[i].seconds < points[j].seconds
                                                  : points[i].error < points[j].error;
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(points[i].error < least)) continue;
    least = points[i].error;
    front.push_back(i);
  }
  return front;
}

}  // namespace touchstone::trade
