// touchstone query for bodies that need not be convex.
#pragma once

#include <string>
#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/narrow_phase.h"
#include "harness/files/concave/concave_cases.h"

namespace touchstone::commands {

struct ConcaveQuery {
  std::string names;  // of concave phases, joined by commas
  ConcaveTask task = ConcaveTask::intersect;
  Precision scalar = Precision::float64;
  std::string mid, parts;        // names of the mid-phase and of the narrow phase for convex parts
  NarrowPhaseSettings settings;  // of that narrow phase; its scalar is double
  double time_limit = 5;         // seconds a query
  std::string cases;             // the file that the cases are from
  std::string out;               // the CSV file of answers
  std::string pairs;             // the CSV file of pairs of parts; none if empty
  std::string contacts;          // the CSV file of their depths and normals; none if empty
  bool welds = false;            // contacts of a mesh heed the triangles around
};

// Asks concave phases about the cases, writes a row for each answer, and prints a summary. Throws
// InputError for an unknown name.
void query_concave(const ConcaveQuery& query, const std::vector<files::ConcaveCase>& cases);

}  // namespace touchstone::commands
