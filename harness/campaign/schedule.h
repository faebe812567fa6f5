// The schedule of a block: its sets, their groups, and the windows of frames of their samples.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/campaign/check_pass.h"
#include "harness/measure/measure_plan.h"

namespace touchstone::campaign {

// One algorithm of a block. The control is a second registration of a baseline (an A/A control):
// the difference of their times is the error of the measurement.
struct Candidate {
  const BroadPhaseEntry* broad = nullptr;  // null for a narrow phase
  const measure::NarrowChoice* narrow = nullptr;
  bool control = false;
  std::optional<ExecutorKind> executor = {};  // empty at one thread

  const AlgorithmInfo& info() const { return broad != nullptr ? broad->info : narrow->info(); }
  std::string algorithm() const;  // the label of the algorithm, by which the check knows it
  std::string label() const;      // on its executor; equal for a candidate and its control
  bool operator==(const Candidate&) const = default;
};

// The sets of a block, and its candidates that passed the check. The baseline is the first member
// of its set and of each of its groups; the control is the second member.
struct Schedule {
  std::vector<Candidate> candidates;  // the contestants of the sets
  std::vector<measure::MeasuredSet> sets;
  std::vector<const measure::NarrowSet*> pairs;  // one for each set; null: the broad phases

  std::string key(std::size_t set) const {
    return pairs[set] == nullptr ? "" : set_key(*pairs[set]);
  }
};
Schedule make_schedule(const RunContext& context, const measure::BlockInput& input,
                       std::span<const measure::NarrowSet> narrow, const CheckTable& checks);

}  // namespace touchstone::campaign
