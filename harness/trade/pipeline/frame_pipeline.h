// Plays a scene with a configuration and gives one answer a pair of bodies.
// The stages are boxes, broad phase, parts and narrow phase. It skips work that the scene does not
// need, and the counters show it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "harness/grade/grade.h"
#include "harness/grade/pair_groups.h"
#include "harness/trade/pipeline/body_boxes.h"
#include "harness/trade/pipeline/stand_ins.h"

namespace touchstone::trade {

// The stages of a frame in order: bodies' boxes and parts' poses; build or update; find_pairs; the
// division of pairs of bodies into batches of pairs of parts; their answers.
enum class Stage : std::uint8_t { boxes, update, find_pairs, parts, narrow };
inline constexpr std::array<std::string_view, 5> stage_names = {"boxes", "update", "find_pairs",
                                                                "parts", "narrow"};
using StageSeconds = std::array<double, stage_names.size()>;

// Counts of the work done, over all frames so far.
struct PipelineCounters {
  std::int64_t hulls_built = 0;   // the number beyond the scene's own
  std::int64_t shapes_bound = 0;  // the number bound by all instances of narrow phases
  std::int64_t boxes = 0;         // the number of boxes computed
  std::int64_t builds = 0, updates = 0, searches = 0;  // calls of the broad phase
  std::int64_t pairs = 0;                              // pairs of bodies given to the narrow phase
  // pairs of two bodies at rest that were found again but not solved again
  std::int64_t settled = 0;
  std::int64_t queries = 0;  // pairs of parts
  // queries that gave witness points; 0 unless count_witnesses() was called
  std::int64_t witnesses = 0;
};

// The answer for a pair of bodies, taken as the algorithm gives it even if it did not converge.
// Bodies of several parts are in contact if some pair of parts is, else unknown if some pair is;
// their distance is the least signed distance of all pairs.
struct PairAnswer {
  IndexPair pair;
  Answer answer = Answer::unknown;
  Status status = Status::unsupported;
  double distance = Outcome::none;  // metres, signed, if the task asks for it
  double upper = 0;                 // of `touching`: the upper bound on the signed distance, metres
};

class FramePipeline {
 public:
  // All arguments outlive it. The configuration's narrow phases take all pairs that the scene can
  // have.
  FramePipeline(const SceneFrames& frames, const StandIns& stand_ins,
                const Configuration& configuration, Task task, Executor& executor);

  // Plays a frame from nothing. If `asked`, only pairs with a body that moves are solved, except at
  // frame 0, which settles pairs at rest for good.
  void start(std::size_t frame);
  // Plays the next frame.
  void advance();
  // Starts a frame without its narrow phase, to reach the one behind it.
  void pass(std::size_t frame);

  std::size_t frame() const { return frame_; }
  const StageSeconds& seconds() const { return seconds_; }  // the times of the last frame
  // The answers of the last frame, in an order of their own; valid until the next frame.
  std::span<const PairAnswer> answers();
  // All pairs of bodies that it found, including settled ones.
  std::span<const IndexPair> pairs() const { return pairs_; }
  // Turns on the count of witness points, which takes time.
  void count_witnesses() { counts_witnesses_ = true; }
  PipelineCounters counters() const;

 private:
  struct Piece {  // a piece of a batch, for one task
    std::size_t batch, begin, end, outcome;
  };
  void prepare(std::size_t frame, bool anew);
  void find_pairs(bool anew);
  void split_into_parts();
  void append_parts(const IndexPair& pair, std::vector<PartPair>& found) const;
  void solve();
  void solve_whole();
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
  // The narrow phases that are needed, one instance a worker; and the index of the one that takes a
  // pair of kinds.
  std::vector<std::vector<std::unique_ptr<NarrowPhase>>> narrow_;
  std::array<std::uint8_t, grade::PairGrouping::kinds * grade::PairGrouping::kinds> takes_{};
  // The bodies of a configuration with a concave phase, one for each shape, and its instances, one a
  // worker, with memory for the parts that they find.
  std::vector<ConcaveBody> bodies_;
  std::vector<std::unique_ptr<ConcavePhase>> concave_;
  std::vector<std::vector<IndexPair>> found_;

  std::size_t frame_ = 0;
  std::vector<IndexPair> pairs_, asked_;
  std::vector<Pose> part_poses_;  // empty if the poses of parts are those of bodies
  // for each part: frame + 1 of its pose; only for several parts
  std::vector<std::uint32_t> placed_at_;
  std::vector<std::vector<PartPair>> part_pairs_;  // for each task
  grade::PairGrouping batches_;                    // batches of pairs of parts
  // For each pair of parts, its pair of bodies: an index into asked_.
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
