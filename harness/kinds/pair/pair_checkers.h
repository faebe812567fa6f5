// The checkers of pairs, one for each mode: graded cases, axes, counts of verdicts.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/kinds/checker.h"
#include "harness/kinds/pair/envelope.h"
#include "harness/kinds/pair/metamorphic.h"
#include "harness/kinds/pair/pair_failures.h"
#include "harness/kinds/pair/pair_rows.h"
#include "harness/record/machine.h"

namespace touchstone::kinds {

using CaseRows = JobRows<grade::GradedAnswer, VariantCount, JobSummary>;

// Every answer is graded, and sampled cases are asked in other forms too.
class CaseChecker final
    : public RowChecker<CaseChecker, grade::GradedAnswer, VariantCount, JobSummary> {
 public:
  static constexpr std::array row_files = {"grades.csv", "variants.csv", "jobs.csv"};

  explicit CaseChecker(const CheckRequest& request) : request_(request) {}
  const PairRequest& subjects() const { return request_; }
  CaseRows rows_of_job(std::uint32_t family, std::uint64_t round);
  void add(const grade::GradedAnswer& answer);
  void add(const VariantCount& count);
  void add(const JobSummary& job) { jobs_.push_back(job); }

  std::string certificates(std::uint32_t family) override;
  // Also writes summary.csv: a row for each algorithm, scalar and regime.
  void finish() override;
  // The faults beyond the documented margins.
  std::vector<std::string> ours_wrong() const override;
  std::vector<std::string> commands() const override;
  std::string text(std::size_t page_width) const override;
  std::string page(const std::string& pictures) const override;
  std::string page_end() const override;

  const std::map<RegimeKey, grade::AnswerCount>& answers() const { return answers_; }
  const std::map<RegimeKey, FlipCount>& flips() const { return flips_; }
  const std::map<RegimeKey, GradeCount>& grades() const { return grades_; }
  const std::vector<JobSummary>& jobs() const { return jobs_; }
  const std::vector<FailureCase>& failures() const { return failures_; }
  const std::vector<VariantFailure>& variant_failures() const { return variant_failures_; }

 private:
  struct Worst {
    double badness;
    grade::GradedAnswer answer;
  };

  // The answers that get a case file, the worst first: for ours those beyond the margins; for others
  // crashes, silent errors, and numbers whose error exceeds our margins.
  std::vector<grade::GradedAnswer> failing_answers() const;

  PairRequest request_;
  oracle::Oracle oracle_;
  std::map<RegimeKey, grade::AnswerCount> answers_;
  std::map<RegimeKey, FlipCount> flips_;
  std::map<RegimeKey, GradeCount> grades_;
  std::vector<JobSummary> jobs_;
  std::vector<VariantCount>
      variants_beyond_;  // that contain differences of ours beyond the margins
  std::map<RegimeKey, std::vector<Worst>> worst_;
  std::vector<FailureCase> failures_;  // of ours and of others
  std::vector<VariantFailure> variant_failures_;
  std::vector<TruthFailure> truth_failures_;
};

using AxisRows = JobRows<AxisCount, AxisSummary>;

// One property of a pair grows to its extreme.
class AxisChecker final : public RowChecker<AxisChecker, AxisCount, AxisSummary> {
 public:
  static constexpr std::array row_files = {"stress.csv", "cells.csv"};

  explicit AxisChecker(const CheckRequest& request) : request_(request) {}
  const PairRequest& subjects() const { return request_; }
  AxisRows rows_of_job(std::uint32_t family, std::uint64_t round);
  void add(const AxisCount& count) { counts_.push_back(count); }
  void add(const AxisSummary& summary) { summaries_.push_back(summary); }

  std::string certificates(std::uint32_t family) override;
  // Also writes envelope.csv.
  void finish() override;
  // Of ours in double what is silently wrong, crashed or hung.
  std::vector<std::string> ours_wrong() const override;
  std::string text(std::size_t page_width) const override;
  std::string page(const std::string& pictures) const override;
  std::string page_end() const override;

  std::vector<Reach> reaches() const { return envelope(request_, counts_); }
  const std::vector<FailureCase>& failures() const { return failures_; }

 private:
  PairRequest request_;
  oracle::Oracle oracle_;
  std::vector<AxisCount> counts_;
  std::vector<AxisSummary> summaries_;
  std::vector<FailureCase> failures_;
};

// Verdicts alone are counted, of a thousand cases of a regime in a job.
class CountChecker final : public RowChecker<CountChecker, VerdictCount> {
 public:
  static constexpr std::array row_files = {"jobs.csv"};

  explicit CountChecker(const CheckRequest& request) : request_(request) {}
  const PairRequest& subjects() const { return request_; }
  JobRows<VerdictCount> rows_of_job(std::uint32_t family, std::uint64_t round);
  void add(const VerdictCount& count);

  std::vector<std::string> made() const override { return {"soak.csv"}; }
  void write_made(std::int64_t jobs) const override;
  void finish() override;
  // The counts in which ours is silently wrong or lost.
  std::vector<std::string> ours_wrong() const override;
  std::string text(std::size_t page_width) const override;

  const std::map<RegimeKey, VerdictCount>& verdicts() const { return verdicts_; }

 private:
  PairRequest request_;
  std::string program_ = record::hash_of_program();
  oracle::Oracle oracle_;
  std::map<RegimeKey, VerdictCount> verdicts_;
  std::vector<FailureCase> failures_;
};

// Proves the exact answer of a case: the certificate as a line, with its line break.
std::string proof_line(const files::Case& c, oracle::Oracle& oracle);

// Returns the cases of a value of an axis with their exact answers.
std::vector<grade::TrueCase> axis_cases(const PairRequest& request, std::uint32_t regime,
                                        oracle::Oracle& oracle, AxisSummary& summary);

}  // namespace touchstone::kinds
