// The written names of tasks of configuration queries.
#include "algorithms/configuration_query.h"

namespace touchstone {

std::string_view to_string(ConfigurationTask task) {
  switch (task) {
    case ConfigurationTask::free: return "free";
    case ConfigurationTask::distance: return "distance";
    case ConfigurationTask::motion: return "motion";
  }
  return "?";
}

}  // namespace touchstone
