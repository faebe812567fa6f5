// The check pass of narrow phases: every pair of every frame, against the oracle.
// It runs at one thread.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "harness/campaign/blocks.h"
#include "harness/grade/answer_check.h"
#include "harness/measure/block_input.h"
#include "harness/measure/narrow_sampler.h"
#include "harness/process/isolate.h"
#include "harness/process/limited_query.h"

namespace touchstone::campaign {

class NarrowCheck {
 public:
  // `sets` are of one block; all outlive it.
  NarrowCheck(const RunContext& context, const measure::BlockInput& input,
              std::span<const measure::NarrowSet> sets);

  // Takes every algorithm's answers for every set and writes a row for each frame. Each algorithm
  // runs in a child process. If it crashes or hangs on the pairs of a set, it is run again pair by
  // pair, to find the pair, and is then left out of that set.
  void run();

 private:
  struct Piece {  // the pairs of one set in one frame
    std::size_t set, frame;
    std::size_t first;  // the index of its first outcome
    std::size_t reference;
  };
  struct Batch {  // pieces whose outcomes fit into memory together
    std::vector<Piece> pieces;
    std::vector<std::vector<grade::ReferenceOutcome>> references;
    std::size_t outcomes = 0;
  };
  const grade::PairGroup& group(const Piece& piece) const {
    return sets_[piece.set].frames[piece.frame];
  }
  static measure::SampleRequest request(const Piece& piece);
  void run(const Batch& batch, const measure::NarrowChoice& choice);
  // Counts in a pass of its own, in a child of its own: each piece is solved once to warm the
  // algorithm up, and counted the second time. A failure here leaves counts out; the check reports
  // failures.
  std::vector<measure::Allocations> count_allocations(std::span<const Piece> pieces,
                                                      const measure::NarrowChoice& choice,
                                                      process::IsolationLimits limits) const;
  void take(const Piece& piece, const measure::NarrowChoice& choice,
            std::span<const Outcome> outcomes, std::span<const grade::PartList> lists,
            const std::vector<grade::ReferenceOutcome>& reference, record::RawRow row);
  process::SolveBatch solver(const measure::NarrowChoice& choice,
                             const measure::NarrowSet& set) const;
  void lose(const Piece& piece, const measure::NarrowChoice& choice,
            const std::vector<grade::ReferenceOutcome>& reference, Status status,
            const std::string& words);
  void report(const Piece& piece, const measure::NarrowChoice& choice,
              const grade::OutcomeFaults& faults);
  void write_case(const Piece& piece, const measure::NarrowChoice& choice, std::size_t pair,
                  record::Departure& departure) const;
  record::RawRow row(const Piece& piece, const measure::NarrowChoice& choice) const;

  // A choice and the index of a set.
  using Key = std::tuple<const measure::NarrowChoice*, std::size_t>;

  const RunContext* context_;
  const measure::BlockInput* input_;
  std::span<const measure::NarrowSet> sets_;
  std::set<Key> out_;       // crashed, hung or too slow on such pairs: no longer run
  std::set<Key> reported_;  // departures are reported once a block
};

}  // namespace touchstone::campaign
