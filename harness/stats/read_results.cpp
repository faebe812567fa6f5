// Reads raw.csv and sorts its rows into sets of samples.
#include "harness/stats/samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/base/error.h"
#include "harness/files/csv.h"
#include "harness/files/packed_files.h"
#include "harness/record/machine.h"
#include "harness/stats/machines.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {
namespace {

// The counters of a row, in the order of Work.
constexpr std::array<std::int64_t record::RawRow::*, work_count> work_fields = {
    &record::RawRow::iterations,     &record::RawRow::iterations_squared,
    &record::RawRow::support_calls,  &record::RawRow::box_tests,
    &record::RawRow::node_visits,    &record::RawRow::candidates,
    &record::RawRow::bytes,          &record::RawRow::allocations,
    &record::RawRow::allocated_bytes};

// The noise of a set's last row if the run's baseline and its twin differ significantly.
bool is_failure(std::optional<record::RowStatus> status) {
  return status == record::RowStatus::crashed || status == record::RowStatus::timed_out ||
         status == record::RowStatus::garbage || status == record::RowStatus::wrong;
}

// Leaves out the contestants that have checks alone, if their algorithms were timed on executors that
// are in the label.
void leave_out_checks_alone(SampleSet& set) {
  std::set<std::string> timed;
  for (const Contestant& contestant : set.contestants) {
    if (contestant.executor) timed.insert(contestant.algorithm);
  }
  std::erase_if(set.contestants, [&](const Contestant& contestant) {
    return !contestant.executor && !contestant.failure && timed.contains(contestant.algorithm);
  });
}

class Reader {
 public:
  // `machines`: the machine of each block; empty for results of one machine.
  Reader(const OriginOf& origin_of, std::map<std::int64_t, std::string> machines)
      : origin_of_(origin_of), machines_(std::move(machines)) {}

  std::map<std::string, Results> read(const std::filesystem::path& file) {
    record::reader_of<record::RawRow>(file).read([&](const files::CsvReader::Row& fields) {
      fields_ = &fields;
      take(record::read_row<record::RawRow>(fields));
    });
    if (found_.empty()) found_[""];
    std::map<std::string, Results> of_machines;
    for (auto& [machine, found] : found_) {
      found.results.file = file;
      // A file that was cut may end with a set that has only a twin.
      std::erase_if(found.results.sets,
                    [](const SampleSet& set) { return set.contestants.empty(); });
      for (SampleSet& set : found.results.sets) leave_out_checks_alone(set);
      of_machines[machine] = std::move(found.results);
    }
    return of_machines;
  }

 private:
  [[noreturn]] void fail(std::string_view column, const std::string& expected) const {
    std::size_t at = 0;
    while (fields_->name(at) != column) ++at;
    fields_->fail(
        fmt::format("column {}: found '{}'; expected {}", column, fields_->text(at), expected));
  }
  void expect_least(std::string_view column, std::int64_t value, std::int64_t least) const {
    if (value < least) fail(column, fmt::format("a whole number of at least {}", least));
  }

  void take(const record::RawRow& row) {
    const auto machine = machines_.find(row.block);
    at_ = &found_[machine == machines_.end() ? "" : machine->second];
    if (at_->results.campaign.empty()) at_->results.campaign = row.campaign;
    if (row.isa) at_->results.isa.emplace(to_string(*row.isa));
    // An algorithm that takes no pair of these kinds is not a contestant.
    if (row.status == record::RowStatus::unsupported) return;
    SampleSet& set = set_of(row);
    expect_least("frame", row.frame, 0);
    if (!row.stop.empty()) set.stop = row.stop;
    if (row.noise.ends_with(canary_flag)) set.suspect = true;
    Contestant& contestant = contestant_of(set, row);
    if (is_failure(row.status)) contestant.failure = row.status;
    if (row.kind == record::RowKind::sample) {
      take_sample(contestant, row);
      return;
    }
    Check check;
    check.frame = row.frame;
    check.phase = row.phase;
    check.status = row.status;
    check.pair_hash = row.pair_hash;
    check.outcome_hash = row.outcome_hash;
    check.pair_count = row.pair_count;
    check.seconds = row.seconds;
    check.worst_error = row.worst_error;
    check.worst_disagreement = row.worst_disagreement;
    check.contact_count = row.contact_count;
    check.disagreements = row.disagreements;
    check.failures = row.failures;
    check.compared = row.compared;
    for (std::size_t i = 0; i < work_fields.size(); ++i) check.work[i] = row.*work_fields[i];
    contestant.checks.push_back(std::move(check));
  }

  // The rows of one sample are consecutive, one for each phase.
  void take_sample(Contestant& contestant, const record::RawRow& row) const {
    if (std::isnan(row.seconds)) return;  // a failure, which the status names
    if (!(row.seconds >= 0) || std::isinf(row.seconds)) fail("seconds", "seconds of at least 0");
    expect_least("process", row.process, 0);
    expect_least("square", row.square, 0);
    expect_least("round", row.round, 0);
    expect_least("position", row.position, 0);
    expect_least(row.is_narrow() ? "pair_count" : "frames", row.units(), 1);
    add_phase(contestant, row);
  }

  SampleSet& set_of(const record::RawRow& row) {
    expect_least("bodies", row.bodies, 0);
    expect_least("threads", row.threads, 0);
    SetKey key;
    key.scene = row.scene;
    key.scene_hash = row.scene_hash;
    key.bodies = row.bodies;
    if (!row.boxes) fail("boxes", "tight or loose");
    key.boxes = to_string(*row.boxes);
    if (row.seed >= 0) key.seed = std::to_string(row.seed);
    key.threads = row.threads;
    if (row.isa_limit) key.isa_limit = to_string(*row.isa_limit);
    if (row.is_narrow()) {
      if (!row.task) fail("task", "the task of the narrow phase");
      key.task = to_string(*row.task);
      key.pair_kind = row.pair_kind;
      key.pairs_of = row.broad;
    } else {
      key.rebuild = row.is_rebuilt();
    }
    std::vector<SampleSet>& sets = at_->results.sets;
    const auto [at, is_new] = at_->places.try_emplace(key, sets.size());
    if (is_new) sets.emplace_back().key = key;
    return sets[at->second];
  }

  Contestant& contestant_of(SampleSet& set, const record::RawRow& row) const {
    const std::string label = record::label_of(row);
    if (label.empty()) fail("broad", "an algorithm here or in column narrow");
    Contestant* found = &set.twin;
    if (!row.is_twin()) {
      const auto at = std::ranges::find(set.contestants, label, &Contestant::label);
      found = at != set.contestants.end() ? &*at : &set.contestants.emplace_back();
    }
    if (found->label.empty() && !row.is_twin()) {
      // The check, which has one thread, is that of the algorithm on each executor.
      const Contestant* const checked = set.find(record::algorithm_label(row));
      if (checked != nullptr && checked != found) found->checks = checked->checks;
    }
    found->label = label;
    found->algorithm = record::algorithm_label(row);
    if (row.executor) found->executor = row.executor;
    found->batch = row.batch;
    if (row.depth_bound.value_or(false)) found->depth_is_bound = true;
    if (!found->origin) {
      found->origin = row.origin;
      if (!row.origin && origin_of_) {
        found->origin = origin_of_(row.is_narrow(), row.is_narrow() ? row.narrow : row.broad);
      }
    }
    return *found;
  }

  struct Found {
    Results results;
    std::map<SetKey, std::size_t> places;
  };

  const OriginOf& origin_of_;
  const std::map<std::int64_t, std::string> machines_;
  const files::CsvReader::Row* fields_ = nullptr;  // the current row
  std::map<std::string, Found> found_;             // by machine
  Found* at_ = nullptr;                            // of the current row
};

}  // namespace

Results read_results(const std::filesystem::path& folder_or_file, const OriginOf& origin_of) {
  std::map<std::string, Results> of_machines = read_machines(folder_or_file, origin_of);
  if (of_machines.size() > 1) {
    throw base::InputError(
        of_machines.begin()->second.file.string(), 0,
        fmt::format("has rows of {} machines, whose times are not pooled; "
                    "expected the rows of one (`touchstone show --tables` on the folder "
                    "makes tables of each)",
                    of_machines.size()));
  }
  return std::move(of_machines.begin()->second);
}

std::map<std::string, Results> read_machines(const std::filesystem::path& folder_or_file,
                                             const OriginOf& origin_of) {
  const bool folder = std::filesystem::is_directory(folder_or_file);
  const std::filesystem::path file =
      files::row_file(folder ? folder_or_file / "raw.csv" : folder_or_file);
  std::map<std::string, Results> of_machines =
      Reader(origin_of, machines_of_blocks(file.parent_path())).read(file);
  for (auto& [name, results] : of_machines) {
    const std::filesystem::path of =
        of_machines.size() == 1 ? file.parent_path() : file.parent_path() / "machines" / name;
    if (!std::filesystem::exists(of / "machine.csv")) continue;
    const record::Facts facts = record::read_facts(of / "machine.csv");
    results.machine.insert(facts.begin(), facts.end());
  }
  return of_machines;
}

}  // namespace touchstone::stats
