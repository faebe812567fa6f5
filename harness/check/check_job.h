// A part of a check: the cases of one regime or family in one round, for all algorithms.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/check_request.h"
#include "harness/check/families/family_count.h"
#include "harness/check/metamorphic.h"
#include "harness/grade/graded_answer.h"

namespace touchstone::check {

// Counts of an algorithm's answers for one kind of variant (harness/check/metamorphic.h), compared
// with its own answers for the original cases.
struct VariantCount {
  std::uint32_t regime = 0;  // place in the request
  std::uint64_t round = 0;
  std::uint32_t entry = 0;  // place in the request
  Precision scalar{};
  Task task{};
  std::string kind;           // kind of the variants, such as "rotation"
  std::int64_t compared = 0;  // pairs of answers that were compared
  std::int64_t flips = 0;     // answers on different sides of contact, for bodies that do not touch
  std::int64_t lost = 0;      // variants that crashed or hung, unlike the case itself
  std::int64_t beyond = 0;    // differences of ours beyond the documented margins
  double worst_flip = 0;      // exact |signed distance| of a flip, part of the scale
  double worst_difference = 0;    // difference of distances or depths, part of the scale
  std::uint64_t worst_index = 0;  // case of the first beyond, or else of the worst flip

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(regime);
    visit(round);
    visit(entry);
    visit(scalar);
    visit(task);
    visit(kind);
    for (std::int64_t* count : {&compared, &flips, &lost, &beyond}) visit(*count);
    for (double* worst : {&worst_flip, &worst_difference}) visit(*worst);
    visit(worst_index);
  }
};

// Counts over the regime's cases in the round.
struct JobSummary {
  std::uint32_t regime = 0;
  std::uint64_t round = 0;
  std::int64_t cases = 0;
  std::int64_t unresolved = 0;    // cases whose side of contact the oracle's enclosure leaves open
  std::int64_t proven = 0;        // exact answers whose certificate was verified
  std::int64_t refused = 0;       // exact answers whose certificate was refused
  std::int64_t boxes = 0;         // tight and loose boxes of bodies
  std::int64_t boxes_broken = 0;  // boxes that do not contain their body
  std::uint64_t worst_index = 0;  // case of the first refusal or broken box
};

struct JobResult {
  JobSummary summary;
  std::vector<grade::GradedAnswer> answers;
  std::vector<VariantCount> variants;
  std::vector<FamilyCount> families;  // of a job of a family, which has nothing else

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(summary);
    visit(answers);
    visit(variants);
    visit(families);
  }
};

// Does a job. Its number gives regime or family, and round: all of a round, then the next round.
JobResult do_job(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle);

// Returns the variants of a sampled case, and none for other cases.
std::vector<Variant> sampled_variants(const files::Case& c, std::uint64_t seed,
                                      std::uint64_t index);
// Returns "rotation" for "rotation+y+z+x".
std::string kind_of(const Variant& variant);

}  // namespace touchstone::check
