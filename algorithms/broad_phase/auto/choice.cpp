// Part of auto: chooses by counts. See choice.h.
#include "algorithms/broad_phase/auto/choice.h"

#include <algorithm>

namespace touchstone {

bool Choice::update_slowly(const FrameChange& change, const Answers& answers) {
  const Candidate wanted =
      are_few(change, answers) ? Candidate::dynamic_bvh : Candidate::verlet_list;
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
  candidate_ =
      candidate_ == Candidate::dynamic_bvh ? Candidate::sweep_and_prune : Candidate::dynamic_bvh;
  return true;
}

}  // namespace touchstone
