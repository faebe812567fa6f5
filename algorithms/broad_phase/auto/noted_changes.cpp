// Part of auto: notes changes. See noted_changes.h.
#include "algorithms/broad_phase/auto/noted_changes.h"

#include "algorithms/core/memory_usage.h"
#include "algorithms/core/pair_history.h"

namespace touchstone {
namespace {

void append(std::vector<IndexPair>& pairs, const PairSink& sink) {
  for (const PairBuffer& chunk : sink.chunks()) {
    pairs.insert(pairs.end(), chunk.pairs().begin(), chunk.pairs().end());
  }
}

}  // namespace

void NotedChanges::note(BroadPhase& replaced) {
  PairSink began, ended;
  replaced.find_changes(began, ended);
  add(began, ended);
  are_noted_ = true;
}

void NotedChanges::join(PairSink& began, PairSink& ended) {
  add(began, ended);
  write_difference(came_, went_, began, ended);
  came_.clear();
  went_.clear();
  are_noted_ = false;
}

void NotedChanges::add(const PairSink& began, const PairSink& ended) {
  append(came_, began);
  append(went_, ended);
}

std::size_t NotedChanges::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(came_, went_));
}

}  // namespace touchstone
