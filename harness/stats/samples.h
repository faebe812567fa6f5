// The timed samples of a results folder, sorted into sets of comparable contestants.
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
#include "harness/record/row.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {

// The key of a set: contestants with the same input and the same request, so that their times are
// comparable.
struct SetKey {
  std::string scene;
  std::int64_t bodies = 0;
  std::string seed;  // empty if the file does not have it
  std::string boxes;
  std::int64_t threads = 0;
  std::string task, pair_kind;  // those of narrow phases; empty for broad phases
  std::string pairs_of;         // the source of a narrow phase's pairs; empty: the true ones
  std::string scene_hash;
  bool rebuild = false;   // for broad phases: true if every frame was built anew
  std::string isa_limit;  // the limit of vector instructions, if the campaign sets one

  bool narrow() const { return !task.empty(); }
  auto operator<=>(const SetKey&) const = default;
  // A text such as "uniform, 1000 bodies, tight boxes, 2 threads, broad phases"; of a cell run its
  // scene, "hit, box".
  std::string words() const;
};

inline constexpr std::size_t phase_count = base::enumerators<record::Phase>.size();

// One contestant's work on one window of frames, all phases together. Times are in seconds, NaN for
// an absent part.
struct Sample {
  std::int64_t process = 0, square = 0, round = 0, position = 0;
  std::array<double, phase_count> parts;  // seconds of each phase
  double units = 0;  // the number of frames of a broad phase, of queries of a narrow one
  bool noisy = false;
  std::int64_t frame = 0;    // the first of the window
  double worst_frame = nan;  // seconds of the longest one; NaN if it is not known

  double seconds() const;  // the sum of all parts; NaN if nothing was timed
};

// Work counters, named by their columns.
enum class Work : std::uint8_t {
  iterations,
  iterations_squared,  // sum of squares, for the deviation
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

// The verified answer to one frame. A count of -1 is not known.
struct Check {
  std::int64_t frame = 0;
  record::Phase phase = record::Phase::build;
  double seconds = 0;      // not a sample; NaN if the check failed
  double worst_error = 0;  // error of a distance or depth; NaN if there is none
  double worst_disagreement =
      nan;  // exact distance or depth of the worst answer on the wrong side, metres
  std::optional<record::RowStatus> status;
  std::string pair_hash, outcome_hash;
  std::string grade;  // of a cell run: how the answers compare with exact ones, in words
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

// The label of the lower bound of a broad phase, which is measured like a contestant.
inline constexpr const char* limit_label = "limit";

struct Contestant {
  std::string label;  // a label such as "sweep-one-axis" or "gjk double 1e-06"
  std::optional<record::RowOrigin> origin;  // empty if an older file does not have it
  bool depth_is_bound = false;              // its depths are upper bounds by design
  std::string algorithm;  // its label without the executor; empty: the label has none
  std::optional<ExecutorKind> executor;  // of its samples; empty: one thread, or not known
  std::int64_t batch = -1;               // greatest number of pairs of a call; -1: the usual number
  std::vector<Sample> samples;
  std::vector<Check> checks;
  // Set if the status of a row is crashed, timed_out, unsupported or wrong.
  std::optional<record::RowStatus> failure;

  bool is_ours() const { return origin == record::RowOrigin::ours; }
  // Neither ours nor a module's, which is the user's own.
  bool is_others() const { return !is_ours() && origin != record::RowOrigin::module; }
  const std::string& name() const { return algorithm.empty() ? label : algorithm; }
  bool is_limit() const { return label == limit_label || origin == record::RowOrigin::limit; }
};

struct SampleSet {
  SetKey key;
  std::vector<Contestant> contestants;  // in the order of the file
  Contestant twin;                      // the baseline's second registration
  std::string stop;                     // the reason why repetition ended
  // True if the baseline differs from its twin by more than the campaign's width: then something
  // other than the algorithms is in these times, and none of them is reliable.
  bool suspect = false;

  const Contestant* find(const std::string& label) const;
  // Returns the reference of the ratios: the contestant with a twin, else sweep-one-axis or gjk in
  // double, else the first of ours, else the first.
  const Contestant& baseline() const;
};

struct Results {
  std::filesystem::path file;
  std::string campaign;
  std::set<std::string> isa;                   // vector instructions in use
  std::map<std::string, std::string> machine;  // the facts of machine.csv; empty if there is none
  std::vector<SampleSet> sets;                 // in the order of the file

  const SampleSet* find(const SetKey& key) const;
};

// Returns the origin of an algorithm by its name, for files that have no column `origin`.
using OriginOf =
    std::function<std::optional<record::RowOrigin>(bool narrow, const std::string& name)>;

// Reads a raw.csv, or the one of a folder, and the machine.csv beside it. raw.csv.zst is read where
// raw.csv is not there. Throws InputError with file and line, or if the rows are of several machines.
Results read_results(const std::filesystem::path& folder_or_file, const OriginOf& origin_of = {});

// Reads the results of each machine in a folder of several, by their names. If there is one, its
// name is empty.
std::map<std::string, Results> read_machines(const std::filesystem::path& folder_or_file,
                                             const OriginOf& origin_of = {});

// Adds a phase's seconds to its sample; the phases of one sample are consecutive. `sample`
// identifies it, without its parts.
void add_phase(Contestant& contestant, record::Phase phase, Sample sample, double seconds);
// Adds that of a row.
void add_phase(Contestant& contestant, const record::RawRow& row);

// The flag of a round whose baseline differs from its twin; it disturbs no sample.
inline constexpr std::string_view canary_flag = "canary";

// Returns seconds a frame or a query, for each square: the median over the square's rounds. Noisy
// rounds count only on request.
using SquareKey = std::pair<std::int64_t, std::int64_t>;  // process, square
enum class Noise : std::uint8_t { left_out, kept };
std::map<SquareKey, double> by_square(const Contestant& contestant, Noise noise);
std::vector<double> logs(const std::map<SquareKey, double>& squares);

// Returns the seconds of the longest frame of all windows; NaN if it is not known. A window that was
// played several times counts with the least of its longest frames, since noise only adds.
double worst_frame(const Contestant& contestant, Noise noise);

// Returns log(a / b) for every square that both were in: the values of paired statistics.
std::vector<double> paired_log_ratios(const Contestant& a, const Contestant& b, Noise noise);

// Returns log(a / b). Contestants that were never in one square are compared by their ratios to the
// baseline in their own squares (Mann-Whitney).
MedianInterval log_ratio(const Contestant& a, const Contestant& b, const Contestant& baseline,
                         Noise noise, double confidence);

// The columns of a set's key, which open the rows of all tables.

template <record::row_of<SetKey> Key, class Visit>
void key_columns(Key& key, Visit& visit) {
  visit("scene", key.scene, "The scene's name.");
  visit("scene_hash", key.scene_hash, "The scene's hash, as in raw.csv.");
  visit("bodies", record::nonzero(key.bodies), "Number of bodies; empty for a row over several.");
  visit("seed", key.seed, "The scene's seed, where the campaign sets one.");
  visit("boxes", key.boxes, "Kind of boxes: tight or loose.");
  visit("threads", key.threads, "Width of the executor.");
  visit("task", key.task, "Task of the narrow phases; empty for broad phases.");
  visit("pair_kind", key.pair_kind, "The kinds of the two shapes; empty for broad phases.");
  visit("pairs_of", key.pairs_of,
        "The broad phase that found the pairs of a narrow phase; empty: the true pairs.");
  visit("rebuild", record::newer(key.rebuild), "1 where broad phases build every frame anew.");
  visit("isa_limit", record::newer(key.isa_limit),
        "The most vector instructions that the campaign allows; empty: no limit.");
}

// Visits a number with its interval: `name`, `name_low` and `name_high`.
template <class Interval, class Visit>
void interval_columns(const std::string& name, Interval& interval, const std::string& what,
                      Visit& visit) {
  visit(name, interval.median, what);
  visit(name + "_low", interval.low, "Lower end of its 95 % interval.");
  visit(name + "_high", interval.high, "Upper end of its 95 % interval.");
}

}  // namespace touchstone::stats
