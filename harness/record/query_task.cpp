// Names of tasks.
#include "harness/record/query_task.h"

#include "harness/base/enumerators.h"

namespace touchstone::record {

static_assert(base::enumerators<QueryTask>.size() == base::enumerators<Task>.size() + 1);
static_assert(query_task(Task::signed_distance) == QueryTask::signed_distance);

std::string_view to_string(QueryTask task) {
  return task == QueryTask::contacts ? "contacts" : to_string(static_cast<Task>(task));
}

std::optional<Task> narrow_task(QueryTask task) {
  if (task == QueryTask::contacts) return {};
  return static_cast<Task>(task);
}

std::optional<ConcaveTask> concave_task(QueryTask task) {
  switch (task) {
    case QueryTask::intersect: return ConcaveTask::intersect;
    case QueryTask::distance: return ConcaveTask::distance;
    case QueryTask::contacts: return ConcaveTask::contacts;
    case QueryTask::penetration:
    case QueryTask::signed_distance: break;
  }
  return {};
}

}  // namespace touchstone::record
