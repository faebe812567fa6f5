// Part of verlet-list: chooses the rebuild interval by a cost model, and corrects the model by each
// list that ended.
#include "algorithms/broad_phase/verlet_list/rebuild_interval.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

// Costs for each body, in nanoseconds of the machine that they were measured on; only their ratios
// matter. The tests of candidates take as long at each level of vectors, and searches do not: without
// AVX2 they cost three times as much, so lists pay for more scenes.
struct Costs {
  double search, search_pair;  // a search of the packed R-tree, and each pair found there
  double list, list_pair;      // a list, which grows the boxes too, and each candidate in it
  double look, test;           // the check whether a box has escaped, and the test of a candidate
};

// The costs where all lies in the caches, and where it does not. They were fitted to the parts of
// frames of six scenes of 1,000 to 100,000 boxes, with lists for 2 to 32 frames and with none.
struct Fit {
  Costs near, far;
};
constexpr double near_bodies = 1e4, far_bodies = 1e5;

constexpr Fit fit_of(Isa level) {
  switch (level) {
    case Isa::avx512: return {{6.2, 1.3, 13, 2.2, 2.9, 1.4}, {9.5, 1.9, 16, 2.7, 3.9, 2}};
    case Isa::avx2: return {{7.5, 1.6, 15, 2.4, 2.9, 1.4}, {11.5, 2, 18, 2.8, 3.9, 2}};
    case Isa::baseline: break;
  }
  return {{13, 10, 28, 10, 2.9, 1.4}, {21, 10, 34, 10.5, 3.9, 2}};
}

Costs costs_of(std::size_t bodies) {
  const Fit fit = fit_of(isa());
  const double ratio =
      std::log(static_cast<double>(std::max<std::size_t>(bodies, 1)) / near_bodies);
  const double way = std::clamp(ratio / std::log(far_bodies / near_bodies), 0.0, 1.0);
  const auto at = [&](double Costs::*cost) {
    return std::lerp(fit.near.*cost, fit.far.*cost, way);
  };
  return {at(&Costs::search),    at(&Costs::search_pair), at(&Costs::list),
          at(&Costs::list_pair), at(&Costs::look),        at(&Costs::test)};
}

double a_body(std::size_t count, std::size_t bodies) {
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(bodies, 1));
}

}  // namespace

double RebuildInterval::choose(const MeanMotion& motion, std::size_t bodies, std::size_t pairs) {
  constexpr std::array<double, 12> choices{2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96};
  // Even if nothing overlaps yet, grown boxes will.
  const double found = std::max(a_body(pairs, bodies), 0.25);
  double best = 0;
  const Costs costs = costs_of(bodies);
  double least = costs.search + costs.search_pair * found;
  for (const double frames : choices) {
    const double grown = 1 + growth_ * motion.share * frames;
    const double candidates = found * grown * grown * grown;
    // This bound keeps the memory in proportion to the output.
    if (candidates > 2.5 * found + 2) break;
    const double lasts = std::max(1.0, frames * lasted_);
    const double cost =
        (costs.list + costs.list_pair * candidates) / lasts + costs.test * candidates + costs.look;
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
