// Scenes of bodies that move: cells that play a scene's steps, by casts and by substeps of narrow
// phases; and time a step against the share of hits missed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/cells/cell_run.h"
#include "harness/kinds/timed_set.h"
#include "harness/record/row.h"
#include "harness/scene/scene.h"

namespace touchstone::cells {

// Several algorithms behind each other: a pair goes to the first that takes it.
using CastChain = std::vector<const CastEntry*>;
using NarrowChain = std::vector<const NarrowPhaseEntry*>;

struct MotionRequest {
  std::vector<std::filesystem::path> scenes;
  std::vector<scene::SceneOverrides> overrides = {{}};  // each with every scene
  std::vector<int> threads = {1};
  std::vector<const BroadPhaseEntry*> broad;
  std::vector<CastChain> casts;
  std::vector<NarrowChain> narrow;  // each with every number of substeps
  std::vector<int> substeps;
  std::vector<Precision> scalars = {Precision::float64};  // of the narrow phases
  std::optional<double> tolerance;                        // of the casts, metres
  bool is_linear = false;                                 // leaves rotations out
  int parts = 0;  // of a step, for the broad phase of casts; 0: the cheapest
};

// One way through the steps: casts, or substeps.
struct MotionMethod {
  std::string name = {};  // of its contestant
  const BroadPhaseEntry* broad = nullptr;
  CastChain casts = {};
  NarrowChain narrow = {};
  int substeps = 0;  // 0: casts
  Precision scalar = Precision::float64;

  std::string chain_name() const;  // the algorithms' names, joined by '+'
  Origin origin() const;           // that of the first
};

// The methods of a request, casts first.
std::vector<MotionMethod> methods_of(const MotionRequest& request);

// A cell for each number of threads, in a group for each scene with each of the overrides. A query is a
// body in a step; what is graded are pairs. Throws InputError if a scene cannot be read or does not
// move.
std::vector<kinds::PlannedSet> plan_motion(const MotionRequest& request);

// Reads names joined by '+'. Throws InputError.
CastChain cast_chain(const std::string& names);
NarrowChain narrow_chain(const std::string& names);

// points.csv and front.csv of a trade of motion: one way through a scene's steps.
struct MotionPointRow {
  std::string point;
  bool baseline = false, on_front = false;
  std::string status, method;
  int substeps = 0;
  std::string broad, narrow, scalar;
  double error = Outcome::none, seconds = Outcome::none;
  double low = Outcome::none, high = Outcome::none;
  std::int64_t rounds = 0, true_hits = 0, hits = 0, missed = 0, false_hits = 0, unknown = 0;
};
template <record::row_of<MotionPointRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("point", row.point, "Name of the method.");
  visit("baseline", row.baseline, "1: the first; nothing is relative to it.");
  visit("front", row.on_front, "1: on the Pareto front.");
  visit("status", row.status, "`ok`, or how it failed; unsupported, if it takes not all pairs.");
  visit("method", row.method, "`continuous` (casts), or `discrete` (substeps).");
  visit("substeps", row.substeps, "Substeps of a step, of discrete ones; else 0.");
  visit("broad", row.broad, "Broad phase.");
  visit("narrow", row.narrow, "Casts or narrow phases: a pair goes to the first that takes it.");
  visit("scalar", row.scalar, "Scalar of narrow phases: float, double.");
  visit("error", row.error, "Share of the pairs that touch in a step which it misses, 0 to 1.");
  visit("seconds", record::rounded(row.seconds, 4), "Median time of a step, seconds.");
  visit("seconds_low", record::rounded(row.low, 4), "Lower end of its interval at 95 %.");
  visit("seconds_high", record::rounded(row.high, 4), "Upper end.");
  visit("rounds", row.rounds, "Rounds that the median is of.");
  visit("true_hits", row.true_hits, "Pairs that touch in a step, summed over the steps.");
  visit("hits", row.hits, "Pairs that it found to touch.");
  visit("missed", row.missed, "Pairs that touch, of which it says that they do not.");
  visit("false_hits", row.false_hits, "Pairs that do not touch, of which it says that they do.");
  visit("unknown", row.unknown, "Pairs that it gave up, and said so.");
}

// What a trade of motion measures without further wishes: every cast that is built, ours in one
// chain too, and 1, 2, 4... 64 substeps of the narrow phases that are fastest.
MotionRequest default_motion_trade(const std::filesystem::path& scene,
                                   const scene::SceneOverrides& overrides, int threads);

struct MotionTrade {
  CellRequest cells;
  std::vector<MotionMethod> methods;
  std::size_t bodies = 0, steps = 0;
};

// `seconds` is for all of it, about.
MotionTrade plan_motion_trade(const MotionRequest& request, double seconds);

// Writes points.csv, front.csv and front.md from the folder's times, and returns the front for the
// screen.
std::string write_motion_front(const MotionTrade& trade, const std::filesystem::path& folder);

}  // namespace touchstone::cells
