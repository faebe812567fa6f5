// A part of a check: the cases of one regime in one round, through every algorithm.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/check_request.h"
#include "harness/check/metamorphic.h"
#include "harness/grade/graded_answer.h"

namespace touchstone::check {

// An algorithm's answers about cases in one other form (harness/check/metamorphic.h), against its
// own about the cases themselves.
struct VariantCount {
  std::uint32_t regime = 0;  // place in the request
  std::uint64_t round = 0;
  std::uint32_t entry = 0;  // place in the request
  Precision scalar{};
  Task task{};
  std::string kind;               // of the variants: "rotation"
  std::int64_t compared = 0;      // both were answered
  std::int64_t flips = 0;         // on different sides of contact, bodies that do not touch
  std::int64_t lost = 0;          // the other form crashed or hung, the case itself did not
  std::int64_t beyond = 0;        // ours, and more than its documented margins
  double worst_flip = 0;          // the exact |signed distance|, as a part of the scale
  double worst_difference = 0;    // of distances or depths, as a part of the scale
  std::uint64_t worst_index = 0;  // the case of the first beyond, or else of the worst flip

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

// Of the regime's cases in the round.
struct JobSummary {
  std::uint32_t regime = 0;
  std::uint64_t round = 0;
  std::int64_t cases = 0;
  std::int64_t unresolved = 0;    // the oracle's enclosure does not tell the side of contact
  std::int64_t proven = 0;        // exact answers whose certificate was verified
  std::int64_t refused = 0;       // ... and refused
  std::int64_t boxes = 0;         // tight and loose boxes of bodies
  std::int64_t boxes_broken = 0;  // ... that do not hold their body
  std::uint64_t worst_index = 0;  // the case of the first refusal or broken box
};

struct JobResult {
  JobSummary summary;
  std::vector<grade::GradedAnswer> answers;
  std::vector<VariantCount> variants;

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(summary);
    visit(answers);
    visit(variants);
  }
};

// Job number -> regime and round: all regimes of a round, then the next.
JobResult do_job(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle);

// The other forms that a sampled case is asked about in.
std::vector<Variant> sampled_variants(const files::Case& c, std::uint64_t seed,
                                      std::uint64_t index);
// "rotation" of "rotation+y+z+x".
std::string kind_of(const Variant& variant);

}  // namespace touchstone::check
