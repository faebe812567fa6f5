// The tables of a results folder: every number of them is computed from raw.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/grade/margins.h"
#include "harness/stats/samples.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {

// One contestant of one set.
struct TimeRow {
  SetKey key;
  std::string label;
  std::optional<record::RowOrigin> origin;  // empty: not known
  bool per_query = false;    // true if the times are those of a query, not of a frame
  MedianInterval seconds;    // an estimate over the squares
  double minimum = 0;        // the minimum of all samples, noisy ones too, because noise only adds
  double worst_frame = nan;  // see samples.h
  std::array<double, phase_count> parts;  // medians of the phases, NaN for absent ones
  std::int64_t samples = 0, noisy = 0, outliers = 0;
  bool wrong = false;   // true for wrong pairs, or an answer on the wrong side of contact
  std::string failure;  // crashed, timed_out, unsupported, wrong
  // Counts of narrow phases, over all verified frames.
  std::int64_t queries = 0, unknown = 0;  // unknown: failed, or without an answer
  double worst_error = nan;               // see AgreementRow
  bool depth_is_bound = false;            // its depths are upper bounds by design
};

// A ratio of a contestant's time to the baseline's. The twin's row is the canary: its true ratio is
// 1.
struct RatioRow {
  SetKey key;
  std::string label, baseline;
  bool canary = false;
  MedianInterval ratio;  // exp of the median of paired log ratios over the squares
  bool suspect = false;  // see SampleSet
};

// The fastest of the contestants of a batch that are right, against the next. There is none where
// too few squares were left undisturbed to tell (Tables::undecided).
struct WinnerRow {
  SetKey key;
  std::int64_t batch = -1;  // of both, see Contestant
  std::string winner, runner_up;
  MedianInterval ratio;  // ratio of the runner-up's time to the winner's
  bool suspect = false;

  // Returns true if the two cannot be told apart.
  bool is_tie() const { return !(ratio.low > 1); }
};

// The growth of time with the number of bodies: least squares on the logarithms of the medians.
struct ExponentRow {
  SetKey key;  // bodies 0, seed and scene_hash empty
  std::string label;
  std::vector<std::int64_t> counts;
  PowerLaw law;          // seconds as a function of bodies
  PowerLaw law_of_many;  // the law for counts from many_bodies on; NaN below two of them
};
inline constexpr std::int64_t many_bodies = 10'000;  // fewer bodies may fit into the caches

// A ratio of the time with the fewest threads to the time with these.
struct SpeedUpRow {
  SetKey key;
  std::string label;
  std::int64_t base_threads = 1;
  MedianInterval speed_up;
};

// An algorithm on another executor against itself on the usual one, in the same set.
struct ExecutorRow {
  SetKey key;
  std::string algorithm;
  ExecutorKind executor = usual_executor, base = usual_executor;
  MedianInterval ratio;  // of its time to that on the base
  bool suspect = false;  // see SampleSet
};

// The agreement of a narrow phase's answers with the exact ones, over all its verified frames.
struct AgreementRow {
  SetKey key;
  std::string label;
  std::optional<record::RowOrigin> origin;
  std::int64_t queries = 0, right = 0, wrong = 0, failed = 0, unanswered = 0;
  // The greatest error of a distance or depth, as a part of the pair's size; NaN if there is none.
  double worst_error = nan;
  // The greatest exact distance or depth of an answer on the wrong side, metres; NaN if unknown.
  double worst_disagreement = nan;
  bool depth_is_bound = false;
};

// The amount of a contestant's work, over all its verified frames. A number that is not counted is
// NaN.
struct WorkRow {
  SetKey key;
  std::string label;
  std::optional<record::RowOrigin> origin;
  std::int64_t frames = 0, queries = 0;  // queries: pairs of a narrow phase, found pairs of a broad
  // Numbers of a broad phase for a body and frame; candidates are for each pair found, bytes for
  // each body.
  double box_tests = 0, node_visits = 0, candidates = 0, bytes = 0;
  // Numbers of a narrow phase for a query.
  double iterations = 0, support_calls = 0;
  // The heap calls of a frame, or a query, after the warm-up.
  double allocations = 0, allocated_bytes = 0;
};

// The best of ours among the broad phases of a set, against the best of the others; only those that
// are right count. If there is none, names are empty and numbers are NaN. A ratio is NaN too where
// too few squares were left undisturbed.
struct BroadBestRow {
  SetKey key;
  struct Best {
    std::string label;
    double seconds;        // time for a frame
    MedianInterval ratio;  // ratio of its time to that of the best of ours
  };
  Best ours, peer;
  Best bullet_or_fcl;         // the libraries that every distribution has
  MedianInterval over_limit;  // ratio of the time of ours to that of the limit
  double bytes_a_body;        // memory of ours
  std::int64_t base_threads;  // threads of the base of our speed-up; 0: none
  MedianInterval speed_up;
  double exponent;     // exponent of the time of ours, from many_bodies on
  double worst_frame;  // seconds of the longest frame of ours, see samples.h
};

// The fastest of ours among the narrow phases of a set and batch, against the others, with their
// errors. A ratio is NaN where there is no such contestant, or too few squares were left undisturbed.
struct NarrowBestRow {
  struct Best {
    std::string label;                                // empty if there is none
    double seconds = nan;                             // time for a query
    std::int64_t queries = 0, wrong = 0, failed = 0;  // see AgreementRow
    double worst_error = nan;
    MedianInterval ratio = {nan, nan, nan, 0};  // ratio of its time to that of ours
  };
  SetKey key;
  std::int64_t batch = -1;  // of all of them, see Contestant
  Best ours;
  Best right_peer, any_peer;
};

struct Tables {
  std::string campaign;
  double depth_error = grade::usual_depth_error;
  std::vector<std::string> machine;  // the facts that identify the machine, "processor: ..."
  std::vector<TimeRow> times;
  std::vector<RatioRow> ratios;
  // Ratios to a library, in sets that have one: progress of ours does not change a library.
  std::vector<RatioRow> library_ratios;
  std::vector<WinnerRow> winners;
  std::size_t undecided = 0;  // sets and batches with contestants, and too few squares for a winner
  std::vector<ExponentRow> exponents;
  std::vector<SpeedUpRow> speed_ups;
  std::vector<ExecutorRow> executors;
  std::vector<AgreementRow> agreement;
  std::vector<WorkRow> work;
  std::vector<BroadBestRow> broad_best;
  std::vector<NarrowBestRow> narrow_best;
};

// Returns the ratio of the time of a to that of b, both of the set: paired over the squares that
// both were in, else by their ratios to the baseline in their own squares. It is NaN if there is no
// interval.
MedianInterval ratio_between(const SampleSet& set, const Contestant& a, const Contestant& b,
                             Noise noise);

Tables make_tables(const Results& results, Noise noise,
                   double depth_error = grade::usual_depth_error);

// Returns true if a contestant found other pairs than the rest, or gave an answer that the exact
// one contradicts.
bool is_wrong(const SampleSet& set, const Contestant& contestant);

// Returns true if a contestant answered, did not fail, is not wrong, and has no distance or depth
// that is off by more than the stated error: only these win.
bool is_right(const SampleSet& set, const Contestant& contestant, double depth_error);

// Returns the greatest error of a distance or depth over the verified frames, as a part of the
// pair's size; NaN if there is none.
double worst_error(const Contestant& contestant);

// Returns all tables as Markdown.
std::string tables_markdown(const Tables& tables);

// Writes tables.md and times.csv, ratios.csv, library_ratios.csv, winners.csv, exponents.csv,
// speed_ups.csv, executors.csv, agreement.csv, work.csv, broad_best.csv, narrow_best.csv into the folder. With
// `band`, the files of ratios state for each cell the band within which it holds: the interval,
// widened by this factor at both ends. Throws InputError if a file cannot be written.
void write_tables(const Tables& tables, double band, const std::filesystem::path& folder);

}  // namespace touchstone::stats
