// What a check found, counted.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "harness/check/check_job.h"

namespace touchstone {

// Answers of one algorithm in one scalar, over all tasks. Errors are parts of the scale
// (GradedAnswer::scale), the greatest of each; NaN where there is none.
struct AnswerCount {
  std::int64_t answers = 0;       // supported pairs that were asked about
  std::int64_t not_reported = 0;  // with a status that says nothing
  std::int64_t silent = 0;        // wrong side of contact, against what was given
  std::int64_t silent_end = 0;    // wrong side of contact, against the case
  std::int64_t honest = 0;        // failures that the algorithm told of
  std::int64_t crashed = 0;
  std::int64_t timed_out = 0;
  std::int64_t touching = 0;          // of bodies that touch exactly, answered
  std::int64_t touching_contact = 0;  // ... as contact
  std::int64_t bounds = 0;            // certified bounds that miss the exact value
  std::int64_t not_a_number = 0;
  std::int64_t beyond = 0;         // ours: beyond the documented margins
  double honest_margin;            // greatest exact |signed distance| of an honest failure
  double margin, margin_end;       // greatest exact |signed distance| called wrongly
  double distance, distance_end;   // |error| of a gap
  double too_deep, too_shallow;    // errors of a depth, both >= 0, against what was given
  double depth_end;                // |error| of a depth, against the case
  double does_not_separate;        // by how far the reported translation does not
  double excess;                   // by how far it is more than is needed
  double bounds_missed;            // by how far, against the case
  double witness, witness_length;  // points off their bodies; |a - b| against the distance
  double normal;                   // | |n| - 1 |

  AnswerCount();
  void add(const GradedAnswer& answer);
  void add(const AnswerCount& other);
};

// Variants of one algorithm in one scalar.
struct FlipCount {
  std::int64_t compared = 0, flips = 0, lost = 0, beyond = 0;
  double worst_flip = 0, worst_difference = 0;

  void add(const VariantCount& count);
};

class Tally {
 public:
  struct Key {
    std::uint32_t entry = 0;
    Precision scalar{};
    std::uint32_t regime = 0;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  void add(const GradedAnswer& answer);
  void add(std::uint32_t regime, const VariantCount& count);
  void add(const JobSummary& summary);

  const std::map<Key, AnswerCount>& answers() const { return answers_; }
  const std::map<Key, FlipCount>& flips() const { return flips_; }
  const std::vector<JobSummary>& jobs() const { return jobs_; }

  // Counts with some of ours beyond the margins.
  struct RegimeVariants {
    std::uint32_t regime;
    VariantCount count;
  };
  const std::vector<RegimeVariants>& variants_beyond() const { return variants_beyond_; }

  // Answers that are worth a case file, the worst first: of ours what is beyond the margins, of
  // others crashes, silent errors, and numbers off by more than our margins would allow.
  std::vector<GradedAnswer> failures(const CheckRequest& request) const;

  bool ours_are_wrong() const;

 private:
  struct Failure {
    double badness;
    GradedAnswer answer;
  };
  static constexpr std::size_t kept = 3;  // failures of a key

  std::map<Key, AnswerCount> answers_;
  std::map<Key, FlipCount> flips_;
  std::vector<JobSummary> jobs_;
  std::vector<RegimeVariants> variants_beyond_;
  std::map<Key, std::vector<Failure>> failures_;
};

// How bad an answer is; 0 where there is nothing to show. Crash before hang before silent error
// before wrong number.
double badness(const GradedAnswer& answer);

}  // namespace touchstone
