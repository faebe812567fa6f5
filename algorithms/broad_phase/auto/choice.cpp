// Part of auto: chooses by counts. See choice.h.
#include "algorithms/broad_phase/auto/choice.h"

#include <algorithm>

namespace touchstone {
namespace {

// Returns true if the boxes are of about one size: the standard deviation of their longest sides,
// in a sample, is below the mean.
bool are_alike(std::span<const Aabb> boxes) {
  constexpr std::size_t most_sampled = 128;
  double count = 0, sum = 0, squares = 0;
  const std::size_t stride = boxes.size() / most_sampled + 1;
  for (std::size_t id = 0; id < boxes.size(); id += stride) {
    const Aabb& box = boxes[id];
    if (box.is_empty()) continue;
    double side = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side = std::max(side, double{box.max[axis]} - double{box.min[axis]});
    }
    ++count;
    sum += side;
    squares += side * side;
  }
  return count * squares < 2 * sum * sum;
}

}  // namespace

Candidate Choice::wants(const FrameChange& change, const Answers& answers) const {
  if (are_few(change, answers)) return Candidate::dynamic_bvh;
  if (bodies_ > many_bodies) return Candidate::packed_rtree;
  const bool has_few_pairs = answers.is_known && answers.pairs < 2 * bodies_;
  const bool suits_lists = has_few_pairs || (bodies_ > few_bodies && are_alike(change.boxes));
  return suits_lists ? Candidate::verlet_list : Candidate::packed_rtree;
}

bool Choice::update_slowly(const FrameChange& change, const Answers& answers) {
  const Candidate wanted = wants(change, answers);
  wanted_for_ = wanted == candidate_ ? 0 : wanted_for_ + 1;
  if (wanted_for_ < patience_) return false;
  candidate_ = wanted;
  wanted_for_ = 0;
  patience_ = std::min(2 * patience_, most_patience);
  looks_.start();
  return true;
}

bool Choice::look(const FrameChange& change, Answers& answers) {
  FrameCounts counts;
  counts.bodies = static_cast<double>(bodies_);
  counts.moved = static_cast<double>(change.moved.size());
  counts.pairs = answers.pairs_among(counts.bodies);
  counts.changes = static_cast<double>(answers.changes);
  if (!looks_.look(change, candidate_, counts, answers.tally)) return false;
  candidate_ = candidate_ == Candidate::dynamic_bvh ? Candidate::incremental_sweep_and_prune
                                                    : Candidate::dynamic_bvh;
  return true;
}

}  // namespace touchstone
