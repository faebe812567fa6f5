// The written names of point queries' tasks and sides.
#include "algorithms/point_query.h"

namespace touchstone {

std::string_view to_string(PointTask task) {
  switch (task) {
    case PointTask::closest: return "closest";
    case PointTask::side: return "side";
  }
  return "?";
}

std::string_view to_string(PointSide side) {
  switch (side) {
    case PointSide::outside: return "outside";
    case PointSide::surface: return "surface";
    case PointSide::inside: return "inside";
    case PointSide::unknown: return "unknown";
  }
  return "?";
}

}  // namespace touchstone
