// The timed samples of a results folder, sorted into what may be compared with what.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/record/raw_row.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {

// A set: contestants that were given the same input and asked the same, so that their times may be
// compared.
struct SetKey {
  std::string scene;
  std::int64_t bodies = 0;
  std::string seed;  // empty where the file does not tell
  std::string boxes;
  std::int64_t threads = 0;
  std::string task, pair_kind;  // of narrow phases; empty for broad phases
  std::string pairs_of;         // narrow phases: whose pairs; empty: the true ones
  std::string scene_hash;
  bool rebuild = false;   // broad phases: every frame was built anew
  std::string isa_limit;  // of the vector instructions, where the campaign set one

  bool narrow() const { return !task.empty(); }
  auto operator<=>(const SetKey&) const = default;
  std::string words() const;  // "uniform, 1000 bodies, tight boxes, 2 threads, broad phases"
};

inline constexpr std::size_t phase_count = base::enumerators<record::Phase>.size();

// One contestant's work on the same run of frames: its phases together. Seconds, NaN for a part
// that it did not have.
struct Sample {
  std::int64_t process = 0, square = 0, round = 0, position = 0;
  std::array<double, phase_count> parts;  // by phase
  double units = 0;                       // frames of a broad phase, queries of a narrow one
  bool noisy = false;

  double seconds() const;  // all parts; NaN where nothing was timed
};

// Work counters, by their columns.
enum class Work : std::uint8_t {
  iterations,
  iterations_squared,  // for their deviation
  support_calls,
  box_tests,
  node_visits,
  candidates,
  bytes,
  allocations,
  allocated_bytes
};
std::string_view to_string(Work work);
inline constexpr std::size_t work_count = base::enumerators<Work>.size();

// The verified answer to one frame. Counts of -1 are not known.
struct Check {
  std::int64_t frame = 0;
  record::Phase phase = record::Phase::build;
  double seconds = 0;      // no sample: NaN where it failed
  double worst_error = 0;  // of a distance or depth; NaN where there is none
  std::optional<record::RowStatus> status;
  std::string pair_hash, outcome_hash;
  std::int64_t pair_count = -1, contact_count = -1, disagreements = -1, failures = -1,
               compared = -1;
  std::array<std::int64_t, work_count> work = unknown_work();

  std::int64_t count(Work of) const { return work[static_cast<std::size_t>(of)]; }

 private:
  static constexpr std::array<std::int64_t, work_count> unknown_work() {
    std::array<std::int64_t, work_count> none{};
    none.fill(-1);
    return none;
  }
};

// Label of the lower bound of a broad phase, which is measured like a contestant.
inline constexpr const char* limit_label = "limit";

struct Contestant {
  std::string label;                        // "sweep-and-prune", "gjk double 1e-06"
  std::optional<record::RowOrigin> origin;  // empty where an older file does not say
  std::vector<Sample> samples;
  std::vector<Check> checks;
  // Set where the status of a row is crashed, timed_out, unsupported or wrong.
  std::optional<record::RowStatus> failure;

  bool is_ours() const { return origin == record::RowOrigin::ours; }
};

struct SampleSet {
  SetKey key;
  std::vector<Contestant> contestants;  // in the order of the file
  Contestant twin;                      // the baseline's second registration
  std::string stop;                     // why repetition ended
  // The baseline was told from its twin by more than the campaign's width: something that is no
  // algorithm is in these times, and nothing that they say is to be relied on.
  bool suspect = false;

  const Contestant* find(const std::string& label) const;
  // What the others are measured by: the one with a twin, else sweep-and-prune or gjk in double,
  // else the first of ours, else the first.
  const Contestant& baseline() const;
};

struct Results {
  std::filesystem::path file;
  std::string campaign;
  std::set<std::string> isa;                   // vector instructions in use
  std::map<std::string, std::string> machine;  // machine.csv; empty where there is none
  std::vector<SampleSet> sets;                 // in the order of the file

  const SampleSet* find(const SetKey& key) const;
};

// Gives the origin of an algorithm by its name, for files that have no column `origin`.
using OriginOf =
    std::function<std::optional<record::RowOrigin>(bool narrow, const std::string& name)>;

// Reads a raw.csv, or the one of a folder, and the machine.csv beside it. InputError with file and
// line.
Results read_results(const std::filesystem::path& folder_or_file, const OriginOf& origin_of = {});

// Adds a phase's seconds to its sample: the phases of one sample come one after the other. `sample`
// identifies it, without its parts.
void add_phase(Contestant& contestant, record::Phase phase, Sample sample, double seconds);

// Seconds a frame or a query, of each square: the median over the square's rounds. Noisy rounds are
// left out unless they are asked for.
using SquareKey = std::pair<std::int64_t, std::int64_t>;  // process, square
enum class Noise : std::uint8_t { left_out, kept };
std::map<SquareKey, double> by_square(const Contestant& contestant, Noise noise);

// log(a / b) for every square that both were in: the values of paired statistics.
std::vector<double> paired_log_ratios(const Contestant& a, const Contestant& b, Noise noise);

// log(a / b) with the p of its being 0. Those that were never in one square are compared by what
// each has to the baseline in its own squares (Mann-Whitney).
struct LogRatio {
  MedianInterval value;
  double p = 1;
};
LogRatio log_ratio(const Contestant& a, const Contestant& b, const Contestant& baseline,
                   Noise noise, double confidence);

}  // namespace touchstone::stats
