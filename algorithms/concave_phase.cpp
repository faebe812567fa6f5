// The written names of tasks of collision of meshes.
#include "algorithms/concave_phase.h"

namespace touchstone {

std::string_view to_string(ConcaveTask task) {
  switch (task) {
    case ConcaveTask::intersect: return "intersect";
    case ConcaveTask::distance: return "distance";
    case ConcaveTask::contacts: return "contacts";
  }
  return "?";
}

}  // namespace touchstone
