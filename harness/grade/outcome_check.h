// Compares the outcomes of a narrow phase with the exact answers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/core/executor.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/oracle/oracle.h"
#include "harness/grade/pair_groups.h"

namespace touchstone::grade {

// The exact answer for a pair; unknown where the oracle's enclosure holds zero.
struct ReferenceOutcome {
  Answer answer = Answer::unknown;
  double distance = Outcome::none;  // signed, metres; the middle of an enclosure
  double size = 0;                  // greatest extent of the two bodies, metres
  double reach = 0;                 // greatest coordinate of the two bodies, metres
};

// Who is wrong, counted over pairs.
struct OutcomeFaults {
  std::int64_t compared = 0;              // both the oracle and the algorithm gave an answer
  std::int64_t disagree = 0;              // the other side of contact, beyond the grazing band
  std::int64_t grazing = 0;               // the other side of contact, within it
  std::int64_t failed = 0;                // not_converged, degenerate, capacity: an honest failure
  std::int64_t crashed = 0;               // killed its process
  std::int64_t timed_out = 0;             // stopped, or not begun before the time was over
  std::int64_t unanswered = 0;            // unsupported or unknown without a failure
  std::int64_t contacts = 0;              // answered touching or overlapping
  double worst = 0;                       // metres: greatest |exact distance| among `disagree`
  std::optional<std::size_t> worst_pair;  // its place in the group
  std::int64_t values = 0;                // distances or depths that both gave
  double worst_value_error = 0;           // greatest difference, as a part of the size of the pair

  bool lost() const { return crashed + timed_out > 0; }
  void add(const OutcomeFaults& other);  // sums and maxima; the pair is the worse one's
};

OutcomeFaults check_outcomes(std::span<const Outcome> outcomes,
                             std::span<const ReferenceOutcome> reference, Task task,
                             Precision scalar);

// The oracle over the pairs of a group.
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
  std::vector<oracle::Oracle> oracles_;  // one a worker
};

}  // namespace touchstone::grade
