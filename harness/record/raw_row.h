// One measurement: a row of raw.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/outcome.h"
#include "harness/files/csv.h"
#include "harness/record/row.h"

namespace touchstone {

// `convert`: what of a peer's build or update is the conversion to its own types, once more.
enum class Phase : std::uint8_t { build, update, find_pairs, narrow, convert };
std::string_view to_string(Phase phase);

enum class RowKind : std::uint8_t {
  check,   // one frame, verified; its time is no sample
  sample,  // a timed sample of a window of frames
};
std::string_view to_string(RowKind kind);

// What the columns mean is documented in results/README.md. Counts of -1, empty texts and NaN are
// empty fields.
struct RawRow {
  std::string campaign;
  RowKind kind = RowKind::check;
  std::int64_t block = 0;
  std::string scene, scene_hash;
  std::int64_t seed = -1;
  std::int64_t bodies = 0;
  std::string boxes;  // tight, loose
  std::int64_t frame = 0;
  std::int64_t frames = -1;
  std::string broad, narrow, scalar, task;
  double tolerance = Outcome::none, duality_gap = Outcome::none;
  std::int64_t twin = -1;
  std::int64_t threads = 0;
  std::string isa;
  std::string isa_limit;      // empty: the campaign holds the level down to none
  std::int64_t rebuild = -1;  // 1: the campaign has every frame built anew
  std::string pair_kind;
  std::int64_t process = -1, square = -1, round = -1, position = -1;
  Phase phase = Phase::build;
  double seconds = Outcome::none;
  std::int64_t pair_count = -1;
  std::string pair_hash;
  std::int64_t contact_count = -1;
  std::string outcome_hash;
  std::int64_t compared = -1;
  std::int64_t disagreements = -1;
  double worst_disagreement = Outcome::none;
  double worst_error = Outcome::none;
  std::int64_t failures = -1;
  std::int64_t iterations = -1, iterations_squared = -1, support_calls = -1;
  std::int64_t box_tests = -1, node_visits = -1, candidates = -1, bytes = -1;
  std::int64_t allocations = -1, allocated_bytes = -1;
  std::int64_t peak_kb = -1, minor_faults = -1;
  std::int64_t voluntary_switches = -1, involuntary_switches = -1;
  double waited = Outcome::none;  // seconds
  std::int64_t cycles = -1, instructions = -1, branch_misses = -1, cache_misses = -1;
  std::string status;
  std::string noise, words, stop;
  std::int64_t warm = -1;  // 1: the narrow phase started from what the frames before left

  void take(const BroadPhaseWork& work);

  // Its algorithm answered no more.
  bool lost() const {
    return status == to_string(Status::crashed) || status == to_string(Status::timed_out);
  }
};

// The status, of a row only, of an algorithm whose answers at work were not those of its check.
inline constexpr std::string_view status_wrong = "wrong";

// A narrow phase with its settings, as the tables name it: "gjk double", "gjk double 1e-06", "gjk
// double gap 1e-08", "gjk double warm". NaN for both is the algorithm's own tolerance.
std::string narrow_label(std::string_view name, std::string_view scalar, double tolerance,
                         double duality_gap, bool warm);
// Of the row's algorithm: a broad phase's name, or a narrow phase's label.
std::string label_of(const RawRow& row);

std::vector<std::string> raw_header();
void write(CsvWriter& file, const RawRow& row);

// All rows of a file that `write` wrote; InputError with file and line for any other.
std::vector<RawRow> read_raw_rows(const std::filesystem::path& file);

}  // namespace touchstone
