// Counts of a check, and its worst answers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "harness/check/check_job.h"
#include "harness/grade/graded_answer.h"

namespace touchstone::check {

// Counts over variants for one algorithm in one scalar.
struct FlipCount {
  std::int64_t compared = 0, flips = 0, lost = 0, beyond = 0;
  double worst_flip = 0, worst_difference = 0;

  // Adds a VariantCount or another FlipCount.
  template <class Count>
  void add(const Count& count) {
    compared += count.compared;
    flips += count.flips;
    lost += count.lost;
    beyond += count.beyond;
    worst_flip = std::max(worst_flip, count.worst_flip);
    worst_difference = std::max(worst_difference, count.worst_difference);
  }
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

  void add(const grade::GradedAnswer& answer);
  void add(const VariantCount& count);
  void add(const JobSummary& summary);
  void add(const AxisCount& count);
  void add(const AxisSummary& summary);
  void add(const VerdictCount& count);
  void add(const FamilyCount& count);

  const std::map<Key, grade::AnswerCount>& answers() const { return answers_; }
  const std::map<Key, FlipCount>& flips() const { return flips_; }
  const std::vector<JobSummary>& jobs() const { return jobs_; }
  const std::vector<AxisCount>& axis_counts() const { return axis_counts_; }
  const std::vector<AxisSummary>& axis_summaries() const { return axis_summaries_; }
  const std::map<Key, VerdictCount>& verdicts() const { return verdicts_; }
  const FamilyCounts& families() const { return families_; }

  // The counts that contain differences of ours beyond the margins.
  const std::vector<VariantCount>& variants_beyond() const { return variants_beyond_; }

  // Returns the answers of graded cases that get a case file, the worst first: for ours those beyond
  // the margins; for others crashes, silent errors, and numbers whose error exceeds our margins.
  std::vector<grade::GradedAnswer> failures(const CheckRequest& request) const;

 private:
  struct Failure {
    double badness;
    grade::GradedAnswer answer;
  };
  static constexpr std::size_t kept = 3;  // number of failures of a key

  std::map<Key, grade::AnswerCount> answers_;
  std::map<Key, FlipCount> flips_;
  std::vector<JobSummary> jobs_;
  std::vector<AxisCount> axis_counts_;
  std::vector<AxisSummary> axis_summaries_;
  std::map<Key, VerdictCount> verdicts_;
  FamilyCounts families_;
  std::vector<VariantCount> variants_beyond_;
  std::map<Key, std::vector<Failure>> failures_;
};

}  // namespace touchstone::check
