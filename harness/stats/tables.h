// The tables of a results folder: every number of them is computed from raw.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "harness/stats/samples.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {

// One contestant of one set.
struct TimeRow {
  SetKey key;
  std::string label, origin;              // ours, peer, oracle, limit; empty: not known
  bool per_query = false;                 // the times are of a query, not of a frame
  MedianInterval seconds;                 // over the squares
  double minimum = 0;                     // of all samples, noisy ones too: noise only adds
  std::array<double, phase_count> parts;  // medians of the phases, NaN where there is none
  std::int64_t samples = 0, noisy = 0, outliers = 0;
  bool wrong = false;   // other pairs than there are, or an answer on the wrong side of contact
  std::string failure;  // crashed, timed_out, unsupported, wrong
  // Narrow phases, over all verified frames.
  std::int64_t queries = 0, unknown = 0;  // unknown: failed, or without an answer
  double worst_error = std::numeric_limits<double>::quiet_NaN();  // see AgreementRow
};

// A contestant's time over the baseline's. The twin's row is the canary: its true ratio is 1.
struct RatioRow {
  SetKey key;
  std::string label, baseline;
  bool canary = false;
  MedianInterval ratio;           // exp of the median of paired log ratios over the squares
  double p = 1, p_corrected = 1;  // sign test; Holm over the table, canaries apart
  bool suspect = false;           // see SampleSet
};

// The fastest of those that answer right, against the next. A distance or depth is right within the
// stated error.
struct WinnerRow {
  SetKey key;
  std::string winner, runner_up;
  MedianInterval ratio;  // of the runner-up's time over the winner's
  double p = 1, p_corrected = 1;
  bool suspect = false;
};

// How time grows with the number of bodies: least squares on the logarithms of the medians.
struct ExponentRow {
  SetKey key;  // bodies 0, seed and scene_hash empty
  std::string label;
  std::vector<std::int64_t> counts;
  PowerLaw law;          // of seconds over bodies
  PowerLaw law_of_many;  // of the counts from many_bodies on; NaN below two of them
};
inline constexpr std::int64_t many_bodies = 10'000;  // fewer may be in the caches

// The time with the fewest threads over that with these.
struct SpeedUpRow {
  SetKey key;
  std::string label;
  std::int64_t base_threads = 1;
  MedianInterval speed_up;
};

// How the answers of a narrow phase agree with the exact ones, over all its verified frames.
struct AgreementRow {
  SetKey key;
  std::string label, origin;
  std::int64_t queries = 0, right = 0, wrong = 0, failed = 0, unanswered = 0;
  // Greatest of a distance or depth, as a part of the pair's size; NaN where there is none.
  double worst_error = std::numeric_limits<double>::quiet_NaN();
};

// What a contestant's work comes to, over all its verified frames. NaN where it is not counted.
struct WorkRow {
  SetKey key;
  std::string label, origin;
  std::int64_t frames = 0, queries = 0;  // queries: pairs of a narrow phase, found pairs of a broad
  // Broad phases: a body and frame; candidates are for each pair found, bytes for each body.
  double box_tests = 0, node_visits = 0, candidates = 0, bytes = 0;
  // Narrow phases: a query.
  double iterations = 0, support_calls = 0;
  // What a frame, or a query, asks of the heap once it is warm.
  double allocations = 0, allocated_bytes = 0;
};

// The best of ours among the broad phases of a set, against the best of the others; those that
// answer right. Empty names and NaN where there is none.
struct BroadBestRow {
  SetKey key;
  struct Best {
    std::string label;
    double seconds;        // a frame
    MedianInterval ratio;  // of its time over that of the best of ours
  };
  Best ours, peer;
  Best bullet_or_fcl;         // those that every distribution has
  MedianInterval over_limit;  // the time of ours over that of the limit
  double bytes_a_body;        // that ours holds
  std::int64_t base_threads;  // of the speed-up of ours; 0: none
  MedianInterval speed_up;
  double exponent;  // of the time of ours, from many_bodies on
};

// The fastest of ours among the narrow phases of a set, against the others, with their errors.
// An algorithm is right that has no wrong answer and no distance or depth off by more than the
// stated error.
struct NarrowBestRow {
  struct Best {
    std::string label;                                          // empty where there is none
    double seconds = std::numeric_limits<double>::quiet_NaN();  // a query
    std::int64_t queries = 0, wrong = 0, failed = 0;            // see AgreementRow
    double worst_error = std::numeric_limits<double>::quiet_NaN();
    MedianInterval ratio = {};  // of its time over that of ours
  };
  SetKey key;
  Best ours;
  Best right_peer, any_peer;
};

// The greatest error of a distance or depth that counts as right, as a part of the pair's size.
inline constexpr double usual_depth_error = 1e-3;

struct Tables {
  std::string campaign;
  double depth_error = usual_depth_error;
  std::vector<std::string> machine;  // what tells the machine, "processor: ..."
  std::vector<TimeRow> times;
  std::vector<RatioRow> ratios;
  // The same to a library, in sets that have one: progress of ours does not change what it is.
  std::vector<RatioRow> library_ratios;
  std::vector<WinnerRow> winners;
  std::vector<ExponentRow> exponents;
  std::vector<SpeedUpRow> speed_ups;
  std::vector<AgreementRow> agreement;
  std::vector<WorkRow> work;
  std::vector<BroadBestRow> broad_best;
  std::vector<NarrowBestRow> narrow_best;
};

// The time of a over that of b, both of the set, with the p of its being 1: paired over the squares
// that both were in, else by what each has to the baseline in its own squares.
struct TestedRatio {
  MedianInterval ratio;
  double p = 1;
};
TestedRatio ratio_between(const SampleSet& set, const Contestant& a, const Contestant& b,
                          Noise noise);

Tables make_tables(const Results& results, Noise noise, double depth_error = usual_depth_error);

// Need the other tables of the same results.
std::vector<BroadBestRow> broad_best(const Results& results, Noise noise, const Tables& tables);
std::vector<NarrowBestRow> narrow_best(const Results& results, Noise noise, const Tables& tables);

// True where a contestant found other pairs than the rest, or gave an answer that the exact one
// contradicts.
bool is_wrong(const SampleSet& set, const Contestant& contestant);

// The greatest error of a distance or depth over the verified frames, as a part of the pair's size;
// NaN where there is none.
double worst_error(const Contestant& contestant);

// All tables, as Markdown.
std::string tables_markdown(const Tables& tables);

// Writes tables.md and times.csv, ratios.csv, library_ratios.csv, winners.csv, exponents.csv,
// speed_ups.csv, agreement.csv, work.csv, broad_best.csv, narrow_best.csv into the folder. `band`:
// the files of ratios state for each cell the band within which it holds: the interval, widened by
// this factor at both ends. InputError where a file cannot be written.
void write_tables(const Tables& tables, double band, const std::filesystem::path& folder);

}  // namespace touchstone::stats
