// Part of auto: chooses by counts. See choice.h.
#include "algorithms/broad_phase/auto/choice.h"

namespace touchstone {

Candidate Choice::wants(std::size_t changes, const Answers& answers) const {
  if (are_few(changes, answers)) return Candidate::dynamic_bvh;
  if (bodies_ > many_bodies) return Candidate::packed_rtree;
  const bool has_few_pairs = answers.is_known && 2 * answers.pairs < 3 * bodies_;
  return has_few_pairs ? Candidate::verlet_list : Candidate::packed_rtree;
}

bool Choice::update_slowly(std::size_t changes, const Answers& answers) {
  const Candidate wanted = wants(changes, answers);
  wanted_for_ = wanted == candidate_ ? 0 : wanted_for_ + 1;
  if (wanted_for_ < patience_) return false;
  candidate_ = wanted;
  wanted_for_ = 0;
  patience_ = std::min(2 * patience_, most_patience);
  looks_.start();
  return true;
}

bool Choice::look(const FrameChange& change, const Answers& answers) {
  const std::size_t churn = change.inserted.size() + change.removed.size();
  const FrameCounts counts{.bodies = static_cast<double>(bodies_),
                           .moved = static_cast<double>(change.moved.size()),
                           .churn = static_cast<double>(churn),
                           .pairs = static_cast<double>(answers.pairs),
                           .changes = static_cast<double>(answers.changes),
                           .asked = answers.asked,
                           .motion = {}};
  if (!looks_.look(change, candidate_, counts)) return false;
  candidate_ = candidate_ == Candidate::dynamic_bvh ? Candidate::incremental_sweep_and_prune
                                                    : Candidate::dynamic_bvh;
  return true;
}

}  // namespace touchstone
