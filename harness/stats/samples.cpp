#include "harness/stats/samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "algorithms/core/outcome.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/files/csv.h"
#include "harness/record/raw_row.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string> required = {
    "campaign",      "scene",        "scene_hash",    "bodies",    "boxes",   "frame", "broad",
    "narrow",        "scalar",       "task",          "tolerance", "threads", "isa",   "pair_kind",
    "phase",         "seconds",      "pair_count",    "pair_hash", "status",  "kind",  "block",
    "process",       "square",       "round",         "position",  "frames",  "twin",  "noise",
    "contact_count", "outcome_hash", "disagreements", "failures"};
const std::vector<std::string> optional = {"seed",
                                           "stop",
                                           "duality_gap",
                                           "compared",
                                           "worst_error",
                                           "iterations",
                                           "iterations_squared",
                                           "support_calls",
                                           "box_tests",
                                           "node_visits",
                                           "candidates",
                                           "bytes",
                                           "allocations",
                                           "allocated_bytes",
                                           "rebuild",
                                           "isa_limit",
                                           "warm"};

// A row's fields by the columns' names.
class Fields {
 public:
  Fields() {
    for (const auto* list : {&required, &optional}) {
      for (const std::string& name : *list) place_.emplace(name, place_.size());
    }
  }
  void at(const CsvReader::Row& row) { row_ = &row; }
  std::string text(const char* name) const { return std::string(row_->text(place(name))); }
  bool has(const char* name) const { return !row_->text(place(name)).empty(); }
  // -1 where the field is empty.
  std::int64_t count(const char* name) const {
    return has(name) ? needed_count(name) : std::int64_t{-1};
  }
  std::int64_t needed_count(const char* name, std::int64_t least = 0) const {
    const std::int64_t value = row_->integer(place(name));
    if (value < least) {
      fail(name, fmt::format("expected a whole number of at least {}", least));
    }
    return value;
  }
  double seconds() const {
    if (!has("seconds")) return nan;
    const double value = row_->number(place("seconds"));
    if (!(value >= 0) || std::isinf(value)) fail("seconds", "expected seconds of at least 0");
    return value;
  }
  double number(const char* name) const {
    return has(name) ? row_->number(place(name)) : Outcome::none;
  }
  [[noreturn]] void fail(const char* name, const std::string& expected) const {
    row_->fail(fmt::format("column {}: found '{}'; {}", name, text(name), expected));
  }

 private:
  std::size_t place(const char* name) const { return place_.at(name); }
  std::map<std::string, std::size_t> place_;
  const CsvReader::Row* row_ = nullptr;
};

Part part_of(const Fields& row) {
  const std::string phase = row.text("phase");
  for (std::size_t i = 0; i < part_names.size(); ++i) {
    if (phase == part_names[i]) return static_cast<Part>(i);
  }
  row.fail("phase", "expected build, update, find_pairs, narrow or convert");
}

// In a set's last row: the run told its baseline from the twin.
constexpr std::string_view canary = "canary";

bool failed(const std::string& status) {
  return status == to_string(Status::crashed) || status == to_string(Status::timed_out) ||
         status == to_string(Status::unsupported) || status == "wrong";
}

class Reader {
 public:
  Results read(const std::filesystem::path& file) {
    results_.file = file;
    Fields row;
    CsvReader(file, required, optional).read([&](const CsvReader::Row& raw) {
      row.at(raw);
      take(row);
    });
    // A file that was cut may end with a set's twin alone.
    std::erase_if(results_.sets, [](const SampleSet& set) { return set.contestants.empty(); });
    return std::move(results_);
  }

 private:
  void take(const Fields& row) {
    const std::string kind = row.text("kind");
    if (kind != "check" && kind != "sample") row.fail("kind", "expected check or sample");
    if (results_.campaign.empty()) results_.campaign = row.text("campaign");
    if (row.has("isa")) results_.isa.insert(row.text("isa"));
    SampleSet& set = set_of(row);
    const std::int64_t frame = row.needed_count("frame");
    if (row.has("stop")) set.stop = row.text("stop");
    if (row.text("noise").ends_with(canary)) set.suspect = true;
    Contestant& contestant = contestant_of(set, row);
    const std::string status = row.text("status");
    if (failed(status)) contestant.failure = status;
    if (kind == "check") {
      Check check;
      check.frame = frame;
      check.part = part_of(row);
      check.status = status;
      check.pair_hash = row.text("pair_hash");
      check.outcome_hash = row.text("outcome_hash");
      check.pair_count = row.count("pair_count");
      check.seconds = row.number("seconds");
      check.worst_error = row.number("worst_error");
      check.contact_count = row.count("contact_count");
      check.disagreements = row.count("disagreements");
      check.failures = row.count("failures");
      check.compared = row.count("compared");
      for (std::size_t i = 0; i < work_names.size(); ++i) check.work[i] = row.count(work_names[i]);
      contestant.checks.push_back(std::move(check));
    } else {
      take_sample(contestant, row, set.key.narrow());
    }
  }

  // Rows of one sample are together, a phase each.
  static void take_sample(Contestant& contestant, const Fields& row, bool narrow) {
    const Part part = part_of(row);
    const double seconds = row.seconds();
    if (std::isnan(seconds)) return;  // a failure, which the status tells
    Sample sample;
    sample.process = row.needed_count("process");
    sample.square = row.needed_count("square");
    sample.round = row.needed_count("round");
    sample.position = row.needed_count("position");
    sample.units = static_cast<double>(row.needed_count(narrow ? "pair_count" : "frames", 1));
    sample.noisy = row.has("noise") && row.text("noise") != canary;
    add_phase(contestant, part, sample, seconds);
  }

  SampleSet& set_of(const Fields& row) {
    SetKey key;
    key.scene = row.text("scene");
    key.scene_hash = row.text("scene_hash");
    key.bodies = row.needed_count("bodies");
    key.boxes = row.text("boxes");
    key.seed = row.text("seed");
    key.threads = row.needed_count("threads");
    key.isa_limit = row.text("isa_limit");
    if (row.has("narrow")) {
      key.task = row.text("task");
      if (key.task.empty()) row.fail("task", "expected the task of the narrow phase");
      key.pair_kind = row.text("pair_kind");
      key.pairs_of = row.text("broad");
    } else {
      key.rebuild = row.text("rebuild") == "1";
    }
    const auto [at, is_new] = places_.try_emplace(key, results_.sets.size());
    if (is_new) results_.sets.emplace_back().key = key;
    return results_.sets[at->second];
  }

  static Contestant& contestant_of(SampleSet& set, const Fields& row) {
    std::string label = row.text("broad");
    if (set.key.narrow()) {
      label = narrow_label(row.text("narrow"), row.text("scalar"), row.number("tolerance"),
                           row.number("duality_gap"), row.text("warm") == "1");
    }
    if (label.empty()) row.fail("broad", "expected an algorithm here or in column narrow");
    const std::string twin = row.text("twin");
    if (!twin.empty() && twin != "0" && twin != "1") row.fail("twin", "expected 1 or nothing");
    if (twin == "1") {
      set.twin.label = label;
      return set.twin;
    }
    const auto at = std::ranges::find(set.contestants, label, &Contestant::label);
    if (at != set.contestants.end()) return *at;
    set.contestants.emplace_back().label = label;
    return set.contestants.back();
  }

  Results results_;
  std::map<SetKey, std::size_t> places_;
};

}  // namespace

bool is_ours(const SetKey& key, const std::string& label) {
  const std::string name = label.substr(0, label.find(' '));
  const auto ours = [&](const auto& entries) {
    return std::ranges::any_of(entries, [&](const auto& entry) {
      return entry.info.name == name && entry.info.origin == Origin::ours;
    });
  };
  return key.narrow() ? ours(narrow_phases()) : ours(broad_phases());
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

void add_phase(Contestant& contestant, Part part, Sample sample, double seconds) {
  const auto place = [](const Sample& s) {
    return std::tuple(s.process, s.square, s.round, s.position);
  };
  const auto at = static_cast<std::size_t>(part);
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
  const auto ours =
      std::ranges::find_if(contestants, [&](const Contestant& c) { return is_ours(key, c.label); });
  return ours == contestants.end() ? contestants.front() : *ours;
}

const SampleSet* Results::find(const SetKey& key) const {
  const auto at = std::ranges::find(sets, key, &SampleSet::key);
  return at == sets.end() ? nullptr : &*at;
}

Results read_results(const std::filesystem::path& folder_or_file) {
  const bool folder = std::filesystem::is_directory(folder_or_file);
  const std::filesystem::path file = folder ? folder_or_file / "raw.csv" : folder_or_file;
  Results results = Reader().read(file);
  const std::filesystem::path machine = file.parent_path() / "machine.csv";
  if (std::filesystem::exists(machine)) {
    CsvReader(machine, {"name", "value"}).read([&](const CsvReader::Row& row) {
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
