// A part of a stress sweep: one value of one axis, for all algorithms.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/axes/stress_row.h"
#include "harness/check/families/family_count.h"
#include "harness/grade/true_case.h"

namespace touchstone::check {

struct CellSummary {
  std::uint32_t cell = 0;
  std::int32_t cases = 0;       // drawn cases with the requested value
  std::int32_t dropped = 0;     // slots without such a case
  std::int32_t unresolved = 0;  // the oracle's enclosure leaves the side of contact open
};

template <record::row_of<CellSummary> Row, class Visit>
void columns(Row& row, Visit visit, const StressRequest& request) {
  cell_columns(row, visit, request);
  visit("cases", row.cases, "Cases that were drawn, and are what the value asks for.");
  visit("dropped", row.dropped, "Cases that could not be drawn so.");
  visit("unresolved", row.unresolved, "Cases whose side of contact the oracle leaves open.");
}

struct CellResult {
  CellSummary summary;
  std::vector<StressRow> rows;
  std::vector<FamilyCount> families;  // of a job of a family, which has nothing else

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(summary);
    visit(rows);
    visit(families);
  }
};

// Runs every algorithm of the request, in each scalar, on each task that it offers. The job is that of
// a cell, or of a family after these.
CellResult do_stress_job(const StressRequest& request, std::size_t job, oracle::Oracle& oracle);

// Returns the cell's cases with their exact answers.
std::vector<grade::TrueCase> true_cases(const StressRequest& request, std::size_t cell,
                                        oracle::Oracle& oracle, CellSummary& summary);

}  // namespace touchstone::check
