// Part of verlet-list: chooses the rebuild interval by a cost model, and corrects the model by each
// list that ended.
#include "algorithms/broad_phase/verlet_list/rebuild_interval.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone {
namespace {

// Relative costs for each body: a search of the packed R-tree, and each pair found there; a list,
// which grows the boxes too, and each candidate in it; the test of a candidate, and the check whether
// a box has escaped from its grown one. They were fitted to frames of six scenes of 1,000 and 10,000
// boxes with lists for 2 to 16 frames and with none.
constexpr double search = 20;
constexpr double search_pair = 2.8;
constexpr double list = 38;
constexpr double list_pair = 4;
constexpr double test = 5.5;
constexpr double look = 4.6;

double a_body(std::size_t count, std::size_t bodies) {
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(bodies, 1));
}

}  // namespace

double RebuildInterval::choose(const MeanMotion& motion, std::size_t bodies, std::size_t pairs) {
  constexpr std::array<double, 12> choices{2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96};
  // Even if nothing overlaps yet, grown boxes will.
  const double found = std::max(a_body(pairs, bodies), 0.25);
  double best = 0;
  double least = search + search_pair * found;
  for (const double frames : choices) {
    const double grown = 1 + growth_ * motion.share * frames;
    const double candidates = found * grown * grown * grown;
    // This bound keeps the memory in proportion to the output.
    if (candidates > 2.5 * found + 2) break;
    const double lasts = std::max(1.0, frames * lasted_);
    const double cost = (list + list_pair * candidates) / lasts + test * candidates + look;
    if (cost < least) {
      least = cost;
      best = frames;
    }
  }
  return best;
}

void RebuildInterval::made(const MeanMotion& motion, double frames, std::size_t bodies,
                           std::size_t candidates) {
  share_ = motion.share;
  frames_ = frames;
  candidates_ = a_body(candidates, bodies);
}

// Averages each estimate with the value observed.
void RebuildInterval::ended(int age, std::size_t bodies, std::size_t pairs) {
  const double found = std::max(a_body(pairs, bodies), 0.25);
  if (share_ > 0) {
    const double grown = std::cbrt(std::max(candidates_ / found, 1.0)) - 1;
    growth_ = std::clamp((growth_ + grown / (share_ * frames_)) / 2, 0.25, 8.0);
  }
  lasted_ = std::clamp((lasted_ + age / frames_) / 2, 0.05, 4.0);
}

}  // namespace touchstone
