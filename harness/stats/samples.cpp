// Sorts the rows of raw.csv into sets of samples.
#include "harness/stats/samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "harness/base/error.h"
#include "harness/files/csv.h"
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
constexpr std::string_view canary = "canary";

bool is_failure(std::optional<record::RowStatus> status) {
  return status == record::RowStatus::crashed || status == record::RowStatus::timed_out ||
         status == record::RowStatus::wrong;
}

class Reader {
 public:
  explicit Reader(const OriginOf& origin_of) : origin_of_(origin_of) {}

  Results read(const std::filesystem::path& file) {
    results_.file = file;
    record::reader_of<record::RawRow>(file).read([&](const files::CsvReader::Row& fields) {
      fields_ = &fields;
      take(record::read_row<record::RawRow>(fields));
    });
    // A file that was cut may end with a set that has only a twin.
    std::erase_if(results_.sets, [](const SampleSet& set) { return set.contestants.empty(); });
    return std::move(results_);
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
    if (results_.campaign.empty()) results_.campaign = row.campaign;
    if (row.isa) results_.isa.emplace(to_string(*row.isa));
    // An algorithm that takes no pair of these kinds is not a contestant.
    if (row.status == record::RowStatus::unsupported) return;
    SampleSet& set = set_of(row);
    expect_least("frame", row.frame, 0);
    if (!row.stop.empty()) set.stop = row.stop;
    if (row.noise.ends_with(canary)) set.suspect = true;
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
    const std::int64_t units = row.is_narrow() ? row.pair_count : row.frames;
    expect_least(row.is_narrow() ? "pair_count" : "frames", units, 1);
    Sample sample;
    sample.process = row.process;
    sample.square = row.square;
    sample.round = row.round;
    sample.position = row.position;
    sample.units = static_cast<double>(units);
    sample.noisy = !row.noise.empty() && row.noise != canary;
    add_phase(contestant, row.phase, sample, row.seconds);
  }

  SampleSet& set_of(const record::RawRow& row) {
    expect_least("bodies", row.bodies, 0);
    expect_least("threads", row.threads, 0);
    SetKey key;
    key.scene = row.scene;
    key.scene_hash = row.scene_hash;
    key.bodies = row.bodies;
    key.boxes = to_string(row.boxes);
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
    const auto [at, is_new] = places_.try_emplace(key, results_.sets.size());
    if (is_new) results_.sets.emplace_back().key = key;
    return results_.sets[at->second];
  }

  Contestant& contestant_of(SampleSet& set, const record::RawRow& row) const {
    const std::string label = record::label_of(row);
    if (label.empty()) fail("broad", "an algorithm here or in column narrow");
    Contestant* found = &set.twin;
    if (!row.is_twin()) {
      const auto at = std::ranges::find(set.contestants, label, &Contestant::label);
      found = at != set.contestants.end() ? &*at : &set.contestants.emplace_back();
    }
    found->label = label;
    if (row.depth_bound.value_or(false)) found->depth_is_bound = true;
    if (!found->origin) {
      found->origin = row.origin;
      if (!row.origin && origin_of_) {
        found->origin = origin_of_(row.is_narrow(), row.is_narrow() ? row.narrow : row.broad);
      }
    }
    return *found;
  }

  const OriginOf& origin_of_;
  const files::CsvReader::Row* fields_ = nullptr;  // the current row
  Results results_;
  std::map<SetKey, std::size_t> places_;
};

}  // namespace

std::string_view to_string(Work work) {
  constexpr std::array<std::string_view, work_count> names = {
      "iterations", "iterations_squared", "support_calls",
      "box_tests",  "node_visits",        "candidates",
      "bytes",      "allocations",        "allocated_bytes"};
  return names[static_cast<std::size_t>(work)];
}

std::string SetKey::words() const {
  std::string text = fmt::format("{}, {} bodies, {} boxes, {} thread{}", scene, bodies, boxes,
                                 threads, threads == 1 ? "" : "s");
  if (!seed.empty()) text += ", seed " + seed;
  if (!isa_limit.empty()) text += ", " + isa_limit + " instructions";
  if (rebuild) text += ", rebuilt";
  if (!narrow()) return text + ", broad phases";
  text += fmt::format(", {} {}", task, pair_kind);
  if (!pairs_of.empty()) text += " on the pairs of " + pairs_of;
  return text;
}

void add_phase(Contestant& contestant, record::Phase phase, Sample sample, double seconds) {
  const auto place = [](const Sample& s) {
    return std::tuple(s.process, s.square, s.round, s.position);
  };
  const auto at = static_cast<std::size_t>(phase);
  std::vector<Sample>& samples = contestant.samples;
  const bool is_new = samples.empty() || place(samples.back()) != place(sample) ||
                      !std::isnan(samples.back().parts[at]);
  if (is_new) {
    sample.parts.fill(nan);
    samples.push_back(sample);
  }
  samples.back().parts[at] = seconds;
  samples.back().noisy = samples.back().noisy || sample.noisy;
}

double Sample::seconds() const {
  double sum = nan;
  for (const double part : parts) {
    if (!std::isnan(part)) sum = std::isnan(sum) ? part : sum + part;
  }
  return sum;
}

const Contestant* SampleSet::find(const std::string& label) const {
  const auto at = std::ranges::find(contestants, label, &Contestant::label);
  return at == contestants.end() ? nullptr : &*at;
}

const Contestant& SampleSet::baseline() const {
  for (const std::string& label :
       {twin.label, std::string(key.narrow() ? "gjk double" : "sweep-and-prune")}) {
    if (const Contestant* found = find(label)) return *found;
  }
  const auto ours = std::ranges::find_if(contestants, &Contestant::is_ours);
  return ours == contestants.end() ? contestants.front() : *ours;
}

const SampleSet* Results::find(const SetKey& key) const {
  const auto at = std::ranges::find(sets, key, &SampleSet::key);
  return at == sets.end() ? nullptr : &*at;
}

Results read_results(const std::filesystem::path& folder_or_file, const OriginOf& origin_of) {
  const bool folder = std::filesystem::is_directory(folder_or_file);
  const std::filesystem::path file = folder ? folder_or_file / "raw.csv" : folder_or_file;
  Results results = Reader(origin_of).read(file);
  const std::filesystem::path machine = file.parent_path() / "machine.csv";
  if (std::filesystem::exists(machine)) {
    files::CsvReader(machine, {"name", "value"}).read([&](const files::CsvReader::Row& row) {
      results.machine.emplace(row.text(0), row.text(1));
    });
  }
  return results;
}

std::map<SquareKey, double> by_square(const Contestant& contestant, Noise noise) {
  std::map<SquareKey, std::vector<double>> rounds;
  for (const Sample& sample : contestant.samples) {
    const double value = sample.seconds() / sample.units;
    if (std::isfinite(value) && value > 0 && (noise == Noise::kept || !sample.noisy)) {
      rounds[{sample.process, sample.square}].push_back(value);
    }
  }
  std::map<SquareKey, double> medians;
  for (auto& [square, values] : rounds) medians[square] = median(std::move(values));
  return medians;
}

std::vector<double> logs(const std::map<SquareKey, double>& squares) {
  std::vector<double> values;
  for (const auto& [square, value] : squares) values.push_back(std::log(value));
  return values;
}

std::vector<double> paired_log_ratios(const Contestant& a, const Contestant& b, Noise noise) {
  const std::map<SquareKey, double> of_b = by_square(b, noise);
  std::vector<double> ratios;
  for (const auto& [square, value] : by_square(a, noise)) {
    const auto at = of_b.find(square);
    if (at != of_b.end()) ratios.push_back(std::log(value / at->second));
  }
  return ratios;
}

LogRatio log_ratio(const Contestant& a, const Contestant& b, const Contestant& baseline,
                   Noise noise, double confidence) {
  const std::vector<double> paired = paired_log_ratios(a, b, noise);
  if (!paired.empty()) return {median_interval(paired, confidence), sign_test(paired)};
  const std::vector<double> of_a = paired_log_ratios(a, baseline, noise);
  const std::vector<double> of_b = paired_log_ratios(b, baseline, noise);
  return {shift(of_b, of_a, confidence), mann_whitney(of_b, of_a)};
}

}  // namespace touchstone::stats
