// Plays a scene with a configuration: boxes, broad phase, parts, narrow phase; one answer a pair of
// bodies. What the scene does not need is not done, and the counters say so.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/core/executor.h"
#include "harness/grade/grade.h"
#include "harness/grade/pair_groups.h"
#include "harness/trade/pipeline/body_boxes.h"
#include "harness/trade/pipeline/stand_ins.h"

namespace touchstone::trade {

// The stages of a frame in order: bodies' boxes and parts' poses; build or update; find_pairs; from
// pairs of bodies to batches of pairs of parts; their answers.
enum class Stage : std::uint8_t { boxes, update, find_pairs, parts, narrow };
inline constexpr std::array<std::string_view, 5> stage_names = {"boxes", "update", "find_pairs",
                                                                "parts", "narrow"};
using StageSeconds = std::array<double, stage_names.size()>;

// Counts of the work done, over all frames so far.
struct PipelineCounters {
  std::int64_t hulls_built = 0;                        // beyond the scene's own
  std::int64_t shapes_bound = 0;                       // by narrow phases, over all their instances
  std::int64_t boxes = 0;                              // computed
  std::int64_t builds = 0, updates = 0, searches = 0;  // calls of the broad phase
  std::int64_t pairs = 0;                              // of bodies, that were asked about
  std::int64_t settled = 0;    // found again, of two bodies at rest: not asked again
  std::int64_t queries = 0;    // of pairs of parts
  std::int64_t witnesses = 0;  // queries that gave witness points; only where they are counted
};

// The answer for a pair of bodies, taken as it is given even where the algorithm did not converge.
// Bodies of several parts are in contact if some pair of parts is, else unknown if some pair is,
// with the least signed distance of all pairs.
struct PairAnswer {
  IndexPair pair;
  Answer answer = Answer::unknown;
  Status status = Status::unsupported;
  double distance = Outcome::none;  // metres, signed, where the task asks for it
};

class FramePipeline {
 public:
  // All outlive it. The configuration's narrow phases take all that the scene can ask of them.
  FramePipeline(const SceneFrames& frames, const StandIns& stand_ins,
                const Configuration& configuration, Task task, Executor& executor);

  // A frame from nothing. `asked`: only pairs with a body that moves are asked about, unless it is
  // frame 0, at which those at rest are settled for good.
  void start(std::size_t frame);
  // The one behind.
  void advance();
  // Starts a frame without its narrow phase, to get to the one behind it.
  void pass(std::size_t frame);

  std::size_t frame() const { return frame_; }
  const StageSeconds& seconds() const { return seconds_; }  // of the last frame
  // The answers of the last frame, in an order of their own; valid until the next frame.
  std::span<const PairAnswer> answers();
  // All pairs of bodies that it found, settled ones among them.
  std::span<const IndexPair> pairs() const { return pairs_; }
  // From now on witness points are counted, which takes time.
  void count_witnesses() { counts_witnesses_ = true; }
  PipelineCounters counters() const;

 private:
  struct Piece {  // of a batch, for one task
    std::size_t batch, begin, end, outcome;
  };
  void prepare(std::size_t frame, bool anew);
  void find_pairs(bool anew);
  void split_into_parts();
  void append_parts(const IndexPair& pair, std::vector<PartPair>& found) const;
  void solve();
  void place(std::uint32_t body, std::uint32_t part);
  void reduce();

  const SceneFrames* frames_;
  const StandIns* stand_ins_;
  const Configuration* configuration_;
  Task task_;
  Executor* executor_;
  BodyBoxes boxes_;
  std::unique_ptr<BroadPhase> broad_;
  PairSink sink_;
  // Narrow phases that are needed: one instance a worker; and which of them takes a pair of kinds.
  std::vector<std::vector<std::unique_ptr<NarrowPhase>>> narrow_;
  std::array<std::uint8_t, grade::PairGrouping::kinds * grade::PairGrouping::kinds> takes_{};

  std::size_t frame_ = 0;
  std::vector<IndexPair> pairs_, asked_;
  std::vector<Pose> part_poses_;          // empty where parts are where bodies are
  std::vector<std::uint32_t> placed_at_;  // of each part: frame + 1 of its pose; several parts only
  std::vector<std::vector<PartPair>> part_pairs_;  // of each task
  grade::PairGrouping batches_;                    // of pairs of parts
  // The pair of bodies of each pair of parts: a place in asked_.
  std::array<std::vector<std::uint32_t>, grade::PairGrouping::kinds * grade::PairGrouping::kinds>
      owners_;
  std::vector<Piece> pieces_;
  std::vector<Outcome> outcomes_;
  std::vector<PairAnswer> answers_;
  bool reduced_ = false, counts_witnesses_ = false;
  StageSeconds seconds_{};
  PipelineCounters counters_;
};

}  // namespace touchstone::trade
