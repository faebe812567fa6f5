// One measurement: a row of raw.csv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/io/csv.h"

namespace touchstone {

enum class Phase : std::uint8_t { build, update, find_pairs, narrow };
std::string_view to_string(Phase phase);

// What the columns mean is documented in results/README.md. Counts of -1, empty texts and NaN are
// empty fields.
struct RawRow {
  std::string scene, scene_hash;
  std::int64_t bodies = 0;
  std::string boxes;  // tight, loose
  int frame = 0;
  std::string broad, narrow, scalar, task;
  double tolerance = Outcome::none;
  int threads = 0;
  std::string pair_kind;
  Phase phase = Phase::build;
  double seconds = Outcome::none;
  std::int64_t pair_count = -1;
  std::string pair_hash;
  std::int64_t contact_count = -1;
  std::string outcome_hash;
  std::int64_t disagreements = -1;
  double worst_disagreement = Outcome::none;
  std::int64_t failures = -1;
  std::string status;
};

// A narrow phase with its settings, as the tables name it: "gjk double", "gjk double 1e-06". A NaN
// is the algorithm's own tolerance.
std::string narrow_label(std::string_view name, std::string_view scalar, double tolerance);

std::vector<std::string> raw_header();
void write(CsvWriter& file, const RawRow& row, const std::string& campaign);

}  // namespace touchstone
