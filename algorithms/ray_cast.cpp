// The written names of ray casts' tasks.
#include "algorithms/ray_cast.h"

namespace touchstone {

std::string_view to_string(RayTask task) {
  switch (task) {
    case RayTask::closest: return "closest";
    case RayTask::any: return "any";
  }
  return "?";
}

}  // namespace touchstone
