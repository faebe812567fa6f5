// Part of auto: the changes that a candidate told when it was replaced, and nobody has asked for yet.
#pragma once

#include <cstddef>
#include <vector>

#include "algorithms/broad_phase.h"

namespace touchstone {

class NotedChanges {
 public:
  bool empty() const { return !are_noted_; }
  // Adds what has changed up to now since this one was last asked.
  void note(BroadPhase& replaced);
  // Puts the changes that its replacement tells together with those before, which are forgotten.
  void join(PairSink& began, PairSink& ended);

  std::size_t held_bytes() const;

 private:
  void add(const PairSink& began, const PairSink& ended);

  bool are_noted_ = false;
  std::vector<IndexPair> came_, went_;
};

}  // namespace touchstone
