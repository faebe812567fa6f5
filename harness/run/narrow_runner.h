// Runs the narrow phases of a block, frame by frame, and compares what they answer.
#pragma once

#include <map>
#include <memory>
#include <random>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/core/executor.h"
#include "harness/run/outcome_check.h"
#include "harness/run/pair_groups.h"
#include "harness/run/run_context.h"

namespace touchstone {

class NarrowRunner {
 public:
  NarrowRunner(const RunContext& context, Executor& executor);

  // Takes every algorithm's answers for every task on these pairs and compares them with the
  // oracle's, untimed. A peer runs in a process of its own: one that crashes or hangs here is
  // not timed after.
  void compare(int frame, std::span<const Pose> poses, std::span<const IndexPair> pairs);

  // Times every algorithm and task on these pairs, each kind of pairs apart, in the order of
  // `shuffle`. `broad` names the broad phase that found them; empty where they are the true ones.
  // The frame has been compared before.
  void time(int frame, std::span<const Pose> poses, std::span<const IndexPair> pairs,
            const std::string& broad, std::mt19937_64& shuffle);

 private:
  struct Contestant {
    NarrowChoice choice;
    std::string label;                                    // narrow_label
    std::vector<std::unique_ptr<NarrowPhase>> instances;  // one a worker

    const AlgorithmInfo& info() const { return choice.entry->info; }
  };

  OutcomeFaults compare(Contestant& contestant, Task task, const PairGroup& group,
                        std::span<const ReferenceOutcome> reference, int frame,
                        std::span<const Pose> poses);
  void report(const Contestant& contestant, Task task, const PairGroup& group,
              const OutcomeFaults& faults, int frame, std::span<const Pose> poses);
  void time(Contestant& contestant, Task task, const PairGroup& group, int frame,
            std::span<const Pose> poses, const std::string& broad);
  std::string write_case(const Contestant& contestant, Task task, const PairGroup& group,
                         std::size_t pair, int frame, std::span<const Pose> poses) const;

  using Key = std::tuple<std::string, Task, std::string>;  // label, task, kind pair

  RunContext context_;
  Executor* executor_;
  std::vector<std::uint32_t> shape_of_;
  std::vector<Contestant> contestants_;
  Reference reference_;
  std::map<Key, OutcomeFaults> faults_;  // of the frame that was compared last
  std::set<Key> out_;                    // crashed, hung or too slow on such pairs: no longer run
  std::set<Key> reported_;               // a departure is told once a block
  std::vector<Outcome> outcomes_;
};

}  // namespace touchstone
