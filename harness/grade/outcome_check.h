// Compares the outcomes of a narrow phase with the exact answers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/oracle/oracle.h"
#include "harness/grade/concave/part_list.h"
#include "harness/grade/pair_groups.h"

namespace touchstone::grade {

// The exact answer for a pair; unknown if the oracle's enclosure contains zero.
struct ReferenceOutcome {
  Answer answer = Answer::unknown;
  double distance = Outcome::none;  // signed, metres; the middle of an enclosure
  double size = 0;                  // greatest extent of the two bodies, metres
  double reach = 0;                 // greatest coordinate of the two bodies, metres
  PartList parts = {};              // pairs of parts in contact, if they were asked for
};

// Counts of faults over pairs.
struct OutcomeFaults {
  std::int64_t compared = 0;    // the oracle and the algorithm both gave an answer
  std::int64_t disagree = 0;    // answers on the other side of contact, beyond the grazing band
  std::int64_t grazing = 0;     // answers on the other side of contact, within the band
  std::int64_t failed = 0;      // honest failures: not_converged, degenerate, capacity
  std::int64_t crashed = 0;     // queries that killed their process
  std::int64_t timed_out = 0;   // queries that were stopped, or not begun in time
  std::int64_t unanswered = 0;  // answers unsupported or unknown without a failure
  std::int64_t contacts = 0;    // answers of touching or overlapping
  double worst = 0;             // metres: greatest |exact distance| among `disagree`
  std::optional<std::size_t> worst_pair;  // its place in the group
  std::int64_t values = 0;                // distances or depths that both gave
  double worst_value_error = 0;           // greatest difference, as a part of the pair's size

  bool lost() const { return crashed + timed_out > 0; }
  void add(const OutcomeFaults& other);  // adds counts, keeps maxima and the worse pair
};

// `lists` has the pairs of parts that were found, or is empty; a wrong list is a disagreement.
OutcomeFaults check_outcomes(std::span<const Outcome> outcomes,
                             std::span<const ReferenceOutcome> reference, Task task,
                             Precision scalar, std::span<const PartList> lists = {});

// Exact answers for the pairs of a group.
class Reference {
 public:
  static std::string_view name() { return "exact"; }

  Reference(std::span<const Shape> shapes, Executor& executor);
  std::vector<ReferenceOutcome> solve(const PairGroup& group,
                                      std::span<const std::uint32_t> shape_of,
                                      std::span<const Pose> poses);

 private:
  std::span<const Shape> shapes_;
  Executor* executor_;
  std::vector<oracle::Solid> solids_;
  std::vector<oracle::Oracle> oracles_;  // one for each worker
};

}  // namespace touchstone::grade
