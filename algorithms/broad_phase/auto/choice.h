// Part of auto: the counts of the frames, and the broad phase that they speak for.
#pragma once

#include <algorithm>
#include <cstddef>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/auto/frame_costs.h"
#include "algorithms/broad_phase/auto/looks.h"

namespace touchstone {

// What was asked, and found in the last frame.
struct Answers {
  Tally tally;
  bool are_changes = false;  // find_changes has been called
  bool is_known = false;     // the number of the pairs is
  std::size_t pairs = 0;     // their number
  std::size_t changes = 0;   // number of those that began and ended, if these were asked for
  // How many bodies find_pairs_of was last asked about, if any, and how many pairs it found.
  std::size_t asked_bodies = 0, found_pairs = 0;

  bool tell_pairs() const { return is_known || asked_bodies > 0; }
  // Returns the number of the pairs among `bodies` bodies. Where it is not known, those asked about
  // are taken to be in as many pairs as others, and each pair to be of one such body: so it is where
  // all rest on one ground, and elsewhere it is up to twice as many.
  double pairs_among(double bodies) const {
    if (is_known || asked_bodies == 0) return static_cast<double>(pairs);
    return static_cast<double>(found_pairs) * bodies / static_cast<double>(asked_bodies);
  }
};

class Choice {
 public:
  Candidate candidate() const { return candidate_; }
  // Begins with a build.
  void start(Candidate candidate, std::size_t bodies) {
    candidate_ = candidate;
    bodies_ = bodies;
    wanted_for_ = 0;
    patience_ = 1;
    looks_ = {};
  }

  // Returns true if another candidate is to take over with this frame.
  bool update(const FrameChange& change, Answers& answers) {
    if (const std::size_t churn = change.inserted.size() + change.removed.size(); churn > 0) {
      bodies_ += change.inserted.size();
      bodies_ -= change.removed.size();
      answers.tally.churn += churn;
      ++answers.tally.churning;
    }
    if (!is_for_rest(candidate_) || !are_few(change, answers)) {
      return update_slowly(change, answers);
    }
    wanted_for_ = 0;
    return answers.tell_pairs() && looks_.is_due() && look(change, answers);
  }

  std::size_t held_bytes() const { return looks_.held_bytes(); }

 private:
  static constexpr int most_patience = 64;

  static bool is_for_rest(Candidate candidate) {
    return candidate == Candidate::dynamic_bvh || candidate == Candidate::sweep_and_prune;
  }
  // True if the changes are few enough for a world that nearly rests, or if bodies only move and
  // are in so few pairs that the dynamic BVH costs a fifth less than the packed R-tree. What is
  // chosen is kept up to twice the threshold, or while it costs no more. The two for such worlds
  // alone tell changes without all pairs.
  bool are_few(const FrameChange& change, const Answers& answers) const {
    const std::size_t churn = change.inserted.size() + change.removed.size();
    const std::size_t changes = change.moved.size() + churn;
    const bool is_kept = is_for_rest(candidate_);
    if ((answers.are_changes ? 8 : 32) * changes <= (is_kept ? 2 : 1) * bodies_) return true;
    if (churn > 0 || !answers.tell_pairs()) return false;
    const auto bodies = static_cast<double>(bodies_);
    const double pairs_a_body = answers.pairs_among(bodies) / bodies;
    return moving_cost(pairs_a_body) * static_cast<double>(changes) <=
           (is_kept ? 1.0 : 0.8) * searching_cost(pairs_a_body) * bodies;
  }
  // Returns what update does where it is not one of the two for such worlds that goes on.
  bool update_slowly(const FrameChange& change, const Answers& answers);
  bool look(const FrameChange& change, Answers& answers);

  Candidate candidate_ = Candidate::verlet_list;
  std::size_t bodies_ = 0;
  int wanted_for_ = 0;  // frames in a row in which another candidate was wanted
  int patience_ = 1;    // frames
  Looks looks_;
};

}  // namespace touchstone
