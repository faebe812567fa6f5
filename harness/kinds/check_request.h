// The request of a check.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "harness/kinds/batch.h"
#include "harness/record/folder_files.h"

namespace touchstone::kinds {

// What is made of the cases.
enum class CheckMode : std::uint8_t {
  cases,  // sampled cases are asked in other forms too; of pairs each answer is a row
  axes,   // one property of a case grows to its extreme: the first values that are wrong
  count,  // counts of verdicts alone, of many cases, a thousand of a family in a job
};

inline constexpr std::int64_t cases_of_a_count_job = 1000;
inline constexpr int most_cases_of_axes = 100'000;  // of each value

struct CheckRequest {
  CheckRequest() = default;
  // With the defaults of the mode.
  explicit CheckRequest(CheckMode of) : mode(of) {
    if (of != CheckMode::axes) return;
    cases = 48;
    time_limit = 0.5;
  }

  CheckMode mode = CheckMode::cases;
  std::vector<Precision> scalars = {Precision::float64, Precision::float32};
  std::vector<const Family*> families;  // of the contestants' kinds; of axes, their values
  std::vector<Contestant> contestants;
  std::uint64_t seed = 1;
  int cases = 200;                 // number of cases of each family in a round; without `count`
  int rounds = 1;                  // number of rounds; of cases alone
  double seconds = 0;              // rounds go on for so long instead; 0: `rounds` of them
  std::int64_t count = 1'000'000;  // of that mode: cases in all, spread evenly
  int workers = 2;                 // number of processes
  double time_limit = 10;          // seconds for one query; of axes, of processor time
  std::filesystem::path out;
  bool resume = false;               // resumes the work in the folder
  std::optional<record::Part> part;  // some jobs instead of all

  // The jobs of one round: one for each family.
  std::size_t period() const { return families.size(); }
  // The jobs of the whole check, if it does not go on for some time.
  std::int64_t job_count() const {
    if (mode == CheckMode::count) return (count + cases_of_a_count_job - 1) / cases_of_a_count_job;
    return static_cast<std::int64_t>(period()) * rounds;
  }
  // Returns the jobs of the part, or else `all`.
  base::UnitRange jobs(std::int64_t all) const {
    return part ? part->units : base::UnitRange{0, all};
  }
};

}  // namespace touchstone::kinds
