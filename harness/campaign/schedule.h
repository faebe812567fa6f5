// What is measured when: sets, the groups in which their contestants meet, squares, processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/campaign/check_pass/check_table.h"
#include "harness/measure/latin_square.h"

namespace touchstone {

// One algorithm of a block. The twin is a second registration of a baseline: what the two differ by
// is the error of the measurement.
struct Contestant {
  const BroadPhaseEntry* broad = nullptr;  // or
  const NarrowChoice* narrow = nullptr;
  bool twin = false;

  const AlgorithmInfo& info() const { return broad != nullptr ? broad->info : narrow->entry->info; }
  std::string label() const;  // without a word on the twin
  bool operator==(const Contestant&) const = default;
};

// Contestants that are given the same input and asked the same.
struct MeasuredSet {
  const NarrowSet* narrow = nullptr;             // null: the broad phases
  std::uint32_t number = 0;                      // of the narrow set, in requests
  std::vector<std::size_t> members;              // contestants, the baseline first, then its twin
  std::vector<std::vector<std::size_t>> groups;  // of members; each has the baseline
  std::vector<std::size_t> starts;               // frames at which a window may begin
  std::uint32_t window = 1;                      // frames a sample
  // A member starts warm: frame 0 only comes before the others, and no window goes over it.
  bool skips_first = false;

  std::string key() const { return narrow == nullptr ? "" : set_key(*narrow); }
  // Squares are numbered through all groups of a set: `lap` counts those of one group.
  std::int64_t square(int lap, std::size_t group) const {
    return static_cast<std::int64_t>(static_cast<std::size_t>(lap) * groups.size() + group);
  }
  // Where the window of this round begins: behind that of the round before.
  std::uint32_t first_frame(std::size_t frames, std::size_t round_of_group) const;
};

// The sets of a block, and its contestants, those that the check left in.
struct Schedule {
  std::vector<Contestant> contestants;
  std::vector<MeasuredSet> sets;
};
Schedule make_schedule(const RunContext& context, const BlockInput& input,
                       std::span<const NarrowSet> narrow, const CheckTable& checks);

// A process of a contestant lives through the laps [first, end). Several make a stage, at whose end
// the intervals are looked at: looking after every square would find a narrow one by chance.
struct ProcessSpan {
  int process, first, end;
};
using Stage = std::vector<ProcessSpan>;
inline constexpr int first_look = 6;  // squares; below, no interval of 95 % exists
// 6, 12, 24 and 48 squares a group, by so many processes each; or as many squares as are asked for.
std::vector<Stage> stages(std::optional<int> squares, int processes);

// How many rounds of a square of so many contestants are taken.
std::size_t rounds_of(const CampaignGroup& group, std::size_t size);
// The order of a square's rounds.
LatinSquare square_order(const RunContext& context, std::size_t set, std::int64_t square,
                         std::size_t size);

}  // namespace touchstone
