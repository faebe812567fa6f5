// Compares what broad and narrow phases found with the true pairs and the exact answers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/oracle/oracle.h"
#include "harness/grade/pair_groups.h"

namespace touchstone::grade {

// Differences between a found set of pairs and the true one, counted by kind.
struct PairFaults {
  std::int64_t missing = 0;          // overlap, but not reported: always an error
  std::int64_t stale = 0;            // reported; overlapped in the frame before, but no longer
  std::int64_t extra = 0;            // reported, but no overlap: a margin, or an error
  std::int64_t duplicate = 0;        // reported more than once, or with a >= b
  std::optional<IndexPair> example;  // one of them, the most serious kind first

  bool none() const { return missing + stale + extra + duplicate == 0; }
};

// Sorts `found`. `truth` must be sorted and without repetition. `before` has the boxes of the frame
// before, and is empty in the first frame.
PairFaults check_pairs(std::vector<IndexPair>& found, std::span<const IndexPair> truth,
                       std::span<const Aabb> before);

// Returns words such as "3 missing, 1 duplicate (first: 17-203)".
std::string to_string(const PairFaults& faults);

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

class ConcaveReference {
 public:
  // The bodies of the shapes that groups name; they outlive it.
  explicit ConcaveReference(std::span<const ConcaveBody> bodies);
  // `boxes` has the box of each body. There is no distance of bodies that share a point, and of
  // others only with ConcaveTask::distance.
  std::vector<ReferenceOutcome> solve(ConcaveTask task, const PairGroup& group,
                                      std::span<const std::uint32_t> shape_of,
                                      std::span<const Pose> poses, std::span<const Aabb> boxes);

 private:
  std::unique_ptr<ConcavePhase> oracle_;
};

}  // namespace touchstone::grade
