// The broad phase of motion: all pairs of moving boxes that meet in a step, by any broad phase. The
// harness and programs that cast bodies include this.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/motion.h"
#include "algorithms/core/moving_box.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Returns a box that holds every point of the body at every time of the step, whatever the rounding
// (kernels/motion/swept_box.h).
MovingBox moving_box(const Shape& shape, const Pose& pose, const Motion& motion);

// Returns the box that holds a moving box for the whole step, cut to the range of floats.
Aabb swept_box(const MovingBox& body);

// Steps: 1. The step is cut into 1, 2, 4... or 64 parts of equal time. Boxes that move far sweep much
//           that they are not in at the same time; each cut halves what they sweep.
//        2. For each part, the broad phase finds the pairs of swept boxes that overlap. If there are
//           at least as many parts as threads, and the broad phase is not a library's, each thread
//           searches parts of its own: they do not wait for each other as the steps of one search do.
//        3. An exact test decides which of these pairs' moving boxes meet at some time of the whole
//           step, so the result does not depend on the cut, the broad phase or the threads, but for
//           its order.
//        4. Of those that meet, a pair whose swept boxes overlap in an earlier part too is dropped: it
//           has been seen. Few pairs are left to be looked up.
//
// The number of parts is the one with the least expected cost: a search costs a box as much as
// `box_cost` candidates cost, and the candidates are estimated on a sample of bodies in the middle of
// the step. It is doubled as long as that pays.
class MovingPairs {
 public:
  static constexpr int most_parts = 64;
  static constexpr double box_cost = 12;

  // `parts` is 0, or a power of two up to most_parts. The broad phase is built (algorithm_info.h). Both
  // references outlive it.
  MovingPairs(const BroadPhaseEntry& broad_phase, Executor& executor, int parts = 0);
  ~MovingPairs();

  // Writes every pair whose moving boxes share a point in the step, each once, a < b, in an order
  // that does not depend on the executor's width. The boxes have no NaN. Returns what the broad
  // phase does; the pairs are all only with Status::ok.
  Status find_pairs(std::span<const MovingBox> bodies, std::vector<IndexPair>& pairs);
  // The same where swept[i] == swept_box(bodies[i]) is known, as it is at little cost to a loop that
  // makes the moving boxes. There is one for each body, and the broad phase may refer to them until the
  // next call.
  Status find_pairs(std::span<const MovingBox> bodies, std::span<const Aabb> swept,
                    std::vector<IndexPair>& pairs);

  // Of the last call: the parts, and the pairs that the broad phase found in all of them.
  int parts() const { return parts_; }
  std::size_t candidates() const { return candidates_; }

 private:
  // A search of one part. Several run at once.
  struct Search {
    std::unique_ptr<BroadPhase> broad_phase;
    PairSink found;
    PairSink meeting;  // those whose moving boxes meet, a chunk for each piece
    Status status = Status::ok;
  };
  // A piece of what a search found.
  struct Piece {
    Search* search = nullptr;
    std::size_t chunk = 0;
    std::span<const IndexPair> pairs;
  };

  double expected_candidates(std::span<const MovingBox> bodies, std::span<const Aabb> swept,
                             int parts);
  int cheapest_parts(std::span<const MovingBox> bodies, std::span<const Aabb> swept);
  std::span<const Aabb> sweep(std::span<const MovingBox> bodies, int part);
  int parts_at_once() const;
  void keep_all_meeting(std::span<const MovingBox> bodies, std::span<Search> searches);
  void append_new(int part, const PairSink& meeting, std::vector<IndexPair>& pairs) const;

  const BroadPhaseEntry* broad_phase_;
  Executor* executor_;
  int asked_parts_;
  int parts_ = 1;
  std::size_t candidates_ = 0;
  std::vector<std::vector<Aabb>> swept_;  // for each part, where there are several
  std::vector<Aabb> whole_;               // swept in the step, where the caller has no boxes
  struct Sample;
  std::unique_ptr<Sample> sample_;
  std::vector<Search> searches_;
  std::vector<Piece> pieces_;  // what all searches of the moment found
};

}  // namespace touchstone
