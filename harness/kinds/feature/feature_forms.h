// Forms of queries of continuous collision: swapped, scaled, moved, reversed and cut in two.
#pragma once

#include <array>
#include <optional>

#include "algorithms/ccd.h"
#include "algorithms/oracle/oracle.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/exact_forms.h"

namespace touchstone::kinds {

// The query in that form, which is not `split`; nothing if the form would round a number. The first
// feature has `first_count` vertices; `scale` is the size of the features (metres).
std::optional<CcdQuery> query_in_form(const CcdQuery& query, int first_count, double scale,
                                      const FormNumbers& numbers, CaseForm form);

// The vertices halfway, if they are exact.
std::optional<std::array<Vec3d, 4>> vertices_halfway(const CcdQuery& query);

// The distance of the features at a time (metres), up to the rounding of their places; 0 where they share a point.
double distance_at(const CcdQuery& query, int first_count, double time, oracle::Oracle& oracle);

// 1 if the features are further apart than that at the time (metres), -1 if they are nearer, both by more
// than rounding and what they move in 2^-38 of the time; 0 between.
int side_of_distance(const CcdQuery& query, int first_count, double time, double distance,
                     oracle::Oracle& oracle);

// True if the features are further apart than that at the time, beyond rounding (metres).
bool are_further_apart(const CcdQuery& query, int first_count, double time, double distance,
                       oracle::Oracle& oracle);

}  // namespace touchstone::kinds
