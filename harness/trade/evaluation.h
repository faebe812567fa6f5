// The errors of configurations on a scene: each one plays the frames whose exact answers are known, and its answers are
// counted: verdicts by the true gap, distances, depths. With the Pareto front of time against error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/process/isolate.h"
#include "harness/trade/pipeline/frame_pipeline.h"
#include "harness/trade/pipeline/truth.h"

namespace touchstone::trade {

// True signed gaps as parts of the smaller body's size, from deep to far; contact is at 0 and
// below. The last bin holds contacts whose depth is not known.
inline constexpr std::array<double, 6> gap_decades = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
inline constexpr std::size_t gap_bins = 2 * (gap_decades.size() + 1);
inline constexpr std::size_t unknown_depth_bin = gap_bins;
std::size_t gap_bin(Answer truth, double gap_over_size);
struct GapRange {
  double low, high;  // NaN if not known; may be infinite
};
GapRange gap_range(std::size_t bin);

struct GapBin {
  std::int64_t pairs = 0;
  std::int64_t wrong = 0;   // false negatives if in contact, false positives if apart
  std::int64_t failed = 0;  // the algorithm reported that it has no answer
};

struct Spread {
  double mean = 0, p99 = 0, greatest = 0;
};
Spread spread_of(std::vector<double> values);

// Sums over the frames whose truth is known; plain data, which a child process can send.
struct PointErrors {
  std::int64_t near = 0;  // the number of pairs that are near each other and whose truth is known
  std::int64_t contacts = 0;  // the number of near pairs that are truly in contact
  std::int64_t false_positives = 0, false_negatives = 0, failed = 0;  // counts among near pairs
  std::int64_t far = 0;  // the number of pairs that are not near but were called a contact
  std::array<GapBin, gap_bins + 1> bins{};
  // The errors |answered - true| as parts of the smaller body's size. In a distance, contact is 0;
  // in a depth, separation is 0. A wrong verdict is an error of that size; a number that is missing
  // is an error of 1.
  std::int64_t values = 0;
  Spread value;

  // The share of wrong verdicts among all that were due, or given without need, 0 to 1.
  double wrong_share() const;
  double false_negative_share() const;  // a share of the true contacts
};

class ErrorCount {
 public:
  explicit ErrorCount(Task task) : task_(task) {}
  // Adds the answers to a frame. Pairs that the truth does not list count if they are contacts. A
  // pair without an answer was not found, and counts as separated.
  void add(const FrameTruth& truth, std::span<const PairAnswer> answers);
  PointErrors errors();

 private:
  void add(const TruePair& truth, const PairAnswer* answer);

  Task task_;
  PointErrors errors_;
  std::vector<double> values_;
};

// A configuration that is compared on a scene, with what stands for the bodies there.
struct TradePoint {
  Configuration configuration;
  std::shared_ptr<const StandIns> stand_ins;
};

struct Evaluation {
  PointErrors errors;
  PipelineCounters counters;
  StageSeconds rough{};  // seconds a frame, from one reading: only for planning
  process::ItemState state =
      process::ItemState::done;  // if it is not `done`, the other members mean nothing
  std::string words;             // the reason of a failure

  bool ok() const { return state == process::ItemState::done; }
  double rough_seconds() const;
};

struct EvaluationLimits {
  double seconds = 60;  // the limit for one configuration
  std::size_t memory = std::size_t{4} << 30;
};

// Evaluates one after the other in a child process, so that a crash costs only its own
// configuration.
std::vector<Evaluation> evaluate(const SceneFrames& frames, std::span<const TradePoint> points,
                                 std::span<const FrameTruth> truth, Task task,
                                 const EvaluationLimits& limits = {});

// The number that counts as the error of a configuration.
enum class ErrorMeasure : std::uint8_t {
  verdicts,         // share of wrong verdicts
  false_negatives,  // share of the contacts that the configuration missed
  mean,             // mean error of distances or depths, as parts of the size
  p99,
  greatest,
  volume,  // greatest volume that a representation adds or loses, as a part of the body's
  // greatest distance of a representation's surface from the body's, as a part of the size
  hausdorff,
};
inline constexpr std::array<std::string_view, 7> error_measure_names = {
    "verdicts", "false-negatives", "mean", "p99", "greatest", "volume", "hausdorff"};
std::string_view to_string(ErrorMeasure measure);
ErrorMeasure default_measure(Task task);  // verdicts, or `greatest` if the task asks for a number

struct RepresentationSpread {
  Spread volume, hausdorff;  // spreads over bodies, as parts of their volume and of their size
};
RepresentationSpread spread_of(std::span<const proxies::RepresentationError> errors);

double error_of(const PointErrors& errors, const RepresentationSpread& representation,
                ErrorMeasure measure);

struct FrontPoint {
  double seconds, error;
};
// Returns the indices of the points that no other point dominates (as fast and as right, and better
// in one), by rising time. If two points are equal in both, the first is taken. NaN is never on the
// front.
std::vector<std::size_t> pareto_front(std::span<const FrontPoint> points);

}  // namespace touchstone::trade
