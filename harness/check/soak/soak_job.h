// A part of a soak: the verdicts of all algorithms on cases of one regime or family.
#pragma once

#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/soak/soak.h"

namespace touchstone::check {

struct SoakJobResult {
  std::vector<SoakCount> counts;      // of a job of a regime: one for each of request.algorithms()
  std::vector<FamilyCount> families;  // of a job of a family

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(counts);
    visit(families);
  }
};

// Does a job. Its number gives regime or family, and round, as in do_job.
SoakJobResult do_soak_job(const SoakRequest& request, std::size_t job, oracle::Oracle& oracle);

}  // namespace touchstone::check
