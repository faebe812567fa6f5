// The state of the shards of a plan, and the machines that did its parts.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/record/result_folder.h"
#include "harness/shards/shard_folder.h"
#include "harness/shards/shard_plan.h"

namespace touchstone::shards {

enum class ShardState : std::uint8_t { done, running, failed, to_come };
std::string_view to_string(ShardState state);

struct ShardStatus {
  std::int64_t shard = 0;
  ShardState state = ShardState::to_come;
  std::optional<Attempt> begun;  // the begin of the last attempt
  std::string ended;             // when it ended; empty if it runs or was killed
  std::string words;             // why it failed, with its last words
};

// Returns the state of a shard. Reading it disturbs no process.
ShardStatus status_of(const ShardPlan& plan, std::int64_t shard);

struct PlanStatus {
  std::array<std::int64_t, 4> counts{};  // by state
  std::vector<ShardStatus> running, failed;
  double seconds = 0, done_seconds = 0;  // estimates of all shards and of those that are done
  // Seconds until the last one is done, by the estimates and the time that the done ones took, if as
  // many go on as run now. Empty if none is done or none runs.
  std::optional<double> left;
};
PlanStatus status_of(const ShardPlan& plan);

// Returns a text for the terminal: counts, who runs what since when, what failed and why.
std::string status_text(const ShardPlan& plan, const PlanStatus& status);

// Returns a list such as "3,17-19" of ascending numbers.
std::string list_of(const std::vector<std::int64_t>& numbers);

// Names machines by their hosts. A host whose facts changed from one part to another, such as its
// kernel, counts as another machine: "n7" and "n7-2".
class Machines {
 public:
  // Returns the name of the machine with these facts of a part's machine.csv.
  std::string name_of(const record::Facts& part);

  std::size_t size() const { return facts_.size(); }
  // Returns the facts that all machines share; the others say that they differ.
  record::Facts shared() const;
  // Writes FOLDER/machines/NAME/machine.csv for each.
  void write(const std::filesystem::path& folder) const;

 private:
  std::map<std::string, record::Facts> facts_;  // by the machine's name
};

}  // namespace touchstone::shards
