// Times the contestants of sets that share their rounds: a job for the measuring loop, whose rounds
// become rows of raw.csv.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/campaign/set_times.h"
#include "harness/cells/cell_run.h"
#include "harness/measure/measuring_loop.h"

namespace touchstone::cells {

// A contestant whose answers were graded, and are expected to stay the same.
struct SetMember {
  const kinds::PlannedSet* planned = nullptr;
  const kinds::TimedContestant* contestant = nullptr;
  std::int64_t queries = 0;
  double seconds = 0;        // of one answer to all queries
  std::uint64_t hash = 0;    // of the answers; 0 if they have none
  bool twin = false;         // the second registration of its set's baseline
  std::int64_t repeats = 1;  // answers to all queries in a sample
};

// Returns the members with the twin of each set's baseline behind it. The baseline is the set's first of
// ours, else its first. The members of a set follow each other.
std::vector<SetMember> with_twins(const std::vector<SetMember>& members);

// The squares of so many contestants in which each takes about `rounds` samples, and never less.
struct SquarePlan {
  int squares = 0;
  std::size_t rounds = 0;  // of each square that run: all of them, or the first
};
SquarePlan square_plan(int rounds, std::size_t contestants);

class SetTiming final : private measure::MeasuringJob {
 public:
  // Takes the rows of one sample, of a round or of a contestant that was lost before one.
  using TakeRows = std::function<void(std::span<const record::RawRow>)>;

  // `number` is that of the first set among those that share no rounds. `earlier` are rows of a run that
  // was stopped, all of these sets: whole rounds. The request outlives this object.
  SetTiming(const CellRequest& request, std::int64_t number, std::vector<SetMember> members,
            std::span<const record::RawRow> earlier);

  // Ends early on an interrupt, behind a whole round.
  void run(const TakeRows& take);

 private:
  std::vector<Untimed> warm_up(std::size_t contestant, std::span<const std::size_t> sets,
                               const measure::ProcessLaps& process) override;
  double deadline(std::size_t contestant, std::size_t set, std::uint32_t frames) const override;
  bool is_right(std::size_t contestant, std::size_t set, const measure::SampleRequest& request,
                const measure::SampleReply& reply) const override;
  bool has_time(std::size_t, const measure::ProcessLaps&) const override { return true; }
  void lose(std::size_t contestant, std::size_t set, int process, std::uint32_t frame,
            const measure::Loss& loss) override;
  void take(measure::Round& round) override;
  bool goes_on() override;

  measure::MeasurePlan plan() const;
  void take_over(const record::RawRow& row);
  record::RawRow row_of(const SetMember& member) const;
  record::RawRow row_of(const measure::Round& round, const measure::Sample& sample) const;
  campaign::SetTimes& times_of(const SetMember& member);

  const CellRequest& request_;
  std::int64_t number_;
  std::vector<SetMember> members_;
  measure::SetProgress progress_;
  std::vector<char> lost_;                 // one for each member
  std::vector<campaign::SetTimes> times_;  // one for each set
  const TakeRows* take_ = nullptr;
};

}  // namespace touchstone::cells
