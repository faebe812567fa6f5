// Looks at the shards of a plan, and tells machines apart by their facts.
#include "harness/shards/status.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/names.h"
#include "harness/files/text_file.h"
#include "harness/record/machine.h"
#include "harness/shards/shard_folder.h"

namespace touchstone::shards {
namespace {

constexpr std::array<std::string_view, 4> state_names = {"done", "running", "failed", "to come"};

// Returns the last line of a log that says something. Nothing is read but a file of the plan's folder,
// because whoever can write attempts.csv could name any file, or a pipe that nobody writes to.
std::string last_line(const std::filesystem::path& log, const std::filesystem::path& plan) {
  if (!files::is_regular_inside(log, plan)) return "";
  constexpr std::streamoff looked_at = 4096;
  std::ifstream stream(log, std::ios::binary | std::ios::ate);
  if (!stream) return "";
  const std::streamoff size = stream.tellg();
  stream.seekg(std::max<std::streamoff>(0, size - looked_at));
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return record::one_line(last);
}

// Seconds since 1970 of a text by date_now(); NaN if it is none.
double seconds_of(const std::string& time) {
  std::tm parts{};
  std::istringstream stream(time);
  stream >> std::get_time(&parts, "%Y-%m-%d %H:%M:%S");
  return stream ? static_cast<double>(timegm(&parts)) : std::numeric_limits<double>::quiet_NaN();
}

std::string duration(double seconds) {
  const auto minutes = static_cast<std::int64_t>(seconds / 60 + 0.5);
  if (minutes < 1) return fmt::format("{:.0f} s", seconds);
  if (minutes < 120) return fmt::format("{} min", minutes);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string_view to_string(ShardState state) {
  return state_names[static_cast<std::size_t>(state)];
}

ShardStatus status_of(const ShardPlan& plan, std::int64_t shard) {
  ShardStatus status{.shard = shard, .begun = {}, .ended = {}, .words = {}};
  const std::filesystem::path folder = shard_path(plan.folder, shard);
  const std::vector<Attempt> attempts = read_attempts(folder);
  if (attempts.empty()) return status;
  const Attempt& last = attempts.back();
  const auto begun =
      std::ranges::find(attempts.rbegin(), attempts.rend(), Event::begun, &Attempt::event);
  if (begun != attempts.rend()) status.begun = *begun;
  if (last.event == Event::done) {
    status.state = ShardState::done;
    status.ended = last.time;
    return status;
  }
  if (is_locked(folder)) {
    status.state = ShardState::running;
    return status;
  }
  status.state = ShardState::failed;
  if (last.event == Event::begun) {
    status.words = "killed, or its machine went down";
  } else {
    status.ended = last.time;
    status.words =
        fmt::format("{}{}{}", to_string(last.event), last.words.empty() ? "" : ": ", last.words);
  }
  const std::string said = last.log.empty() ? "" : last_line(last.log, plan.folder);
  if (!said.empty() && said.find(last.words) == std::string::npos)
    status.words += fmt::format("; its last words: {}", said);
  return status;
}

PlanStatus status_of(const ShardPlan& plan) {
  PlanStatus status;
  double taken = 0;
  double running_since = 0;
  const auto now = static_cast<double>(std::time(nullptr));
  for (const PlannedShard& planned : plan.shards) {
    ShardStatus shard = status_of(plan, planned.shard);
    ++status.counts[static_cast<std::size_t>(shard.state)];
    status.seconds += planned.seconds;
    const double begun = seconds_of(shard.begun ? shard.begun->time : "");
    if (shard.state == ShardState::done) {
      status.done_seconds += planned.seconds;
      const double seconds = seconds_of(shard.ended) - begun;
      if (seconds > 0) taken += seconds;
    }
    if (shard.state == ShardState::running) {
      if (now > begun) running_since += now - begun;
      status.running.push_back(std::move(shard));
    } else if (shard.state == ShardState::failed) {
      status.failed.push_back(std::move(shard));
    }
  }
  if (status.done_seconds > 0 && !status.running.empty()) {
    const double to_do =
        (status.seconds - status.done_seconds) * (taken / status.done_seconds) - running_since;
    status.left = std::max(0.0, to_do) / static_cast<double>(status.running.size());
  }
  return status;
}

std::string status_text(const ShardPlan& plan, const PlanStatus& status) {
  constexpr std::size_t most_lines = 20;
  std::string text = fmt::format("{} ({}), {} shards:", plan.name, plan.kind, plan.shards.size());
  for (std::size_t i = 0; i < state_names.size(); ++i)
    text += fmt::format("{} {} {}", i == 0 ? "" : ",", status.counts[i], state_names[i]);
  text += "\n";
  const auto add = [&](const std::vector<ShardStatus>& shards, const auto& line) {
    for (std::size_t i = 0; i < std::min(most_lines, shards.size()); ++i)
      text += fmt::format("  {:>6}  {}\n", shards[i].shard, line(shards[i]));
    if (shards.size() > most_lines)
      text += fmt::format("          and {} more\n", shards.size() - most_lines);
  };
  if (!status.running.empty()) text += "running\n";
  add(status.running, [](const ShardStatus& shard) {
    return !shard.begun ? std::string("begins")
                        : fmt::format("on {}, process {}, since {}{}", shard.begun->host,
                                      shard.begun->process, shard.begun->time,
                                      shard.begun->job.empty() ? "" : ", job " + shard.begun->job);
  });
  if (!status.failed.empty()) text += "failed\n";
  add(status.failed, [](const ShardStatus& shard) {
    return fmt::format("on {}, begun {}: {}", shard.begun ? shard.begun->host : "?",
                       shard.begun ? shard.begun->time : "?", shard.words);
  });
  if (!status.failed.empty()) {
    std::vector<std::int64_t> numbers;
    for (const ShardStatus& shard : status.failed) numbers.push_back(shard.shard);
    text += fmt::format("to run these again: {} {}\n",
                        base::shell_word((plan.folder / "slurm.sh").string()), list_of(numbers));
  }
  if (status.left) text += fmt::format("about {} left\n", duration(*status.left));
  return text;
}

std::string list_of(const std::vector<std::int64_t>& numbers) {
  std::string list;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    list += fmt::format("{}{}", list.empty() ? "" : ",", numbers[i]);
    if (last > i) list += fmt::format("-{}", numbers[last]);
    i = last + 1;
  }
  return list;
}

namespace {

// What differs from run to run on one machine.
constexpr std::array<std::string_view, 3> facts_of_runs = {"command_line", "commit", "tree"};

// Returns the names of the facts that describe a machine and its program.
const std::set<std::string>& names_of_machine_facts() {
  static const std::set<std::string> names = [] {
    std::set<std::string> all;
    for (const auto& [name, value] : record::machine_facts()) all.insert(name);
    for (const std::string_view name : facts_of_runs) all.erase(std::string(name));
    return all;
  }();
  return names;
}

}  // namespace

std::string Machines::name_of(const record::Facts& part) {
  record::Facts facts;
  for (const auto& fact : part) {
    const bool is_cache = fact.first.starts_with("cache_");  // another machine may have more
    if (is_cache || names_of_machine_facts().contains(fact.first)) facts.push_back(fact);
  }
  const std::string host = record::value_of(part, host_fact);
  std::string name = host;
  for (int number = 2;; ++number) {
    const auto [at, is_new] = facts_.try_emplace(name, facts);
    if (is_new || at->second == facts) return name;
    name = fmt::format("{}-{}", host, number);
  }
}

record::Facts Machines::shared() const {
  if (facts_.empty()) return {};
  record::Facts shared;
  for (const auto& [name, value] : facts_.begin()->second) {
    const bool is_equal = std::ranges::all_of(facts_, [&](const auto& machine) {
      return record::value_of(machine.second, name) == value;
    });
    shared.emplace_back(name, is_equal ? value : "differs: see machines/");
  }
  return shared;
}

void Machines::write(const std::filesystem::path& folder) const {
  for (const auto& [name, facts] : facts_) {
    const std::filesystem::path own = folder / "machines" / name;
    std::error_code error;
    std::filesystem::create_directories(own, error);
    if (error) throw base::InputError(own.string(), 0, "cannot be made: " + error.message());
    record::write_facts(own / "machine.csv", facts, files::CsvWriter::Durable::against_kills);
  }
}

}  // namespace touchstone::shards
