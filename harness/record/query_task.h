// The tasks of narrow phases and of concave phases, as one list.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "algorithms/concave_phase.h"
#include "algorithms/core/outcome.h"

namespace touchstone::record {

// The values of Task, and `contacts`, which only concave phases have.
enum class QueryTask : std::uint8_t { intersect, distance, penetration, signed_distance, contacts };
std::string_view to_string(QueryTask task);

constexpr QueryTask query_task(Task task) { return static_cast<QueryTask>(task); }
// The task of a narrow phase, or of a concave phase; nothing if such phases do not have it.
std::optional<Task> narrow_task(QueryTask task);
std::optional<ConcaveTask> concave_task(QueryTask task);

}  // namespace touchstone::record
