// Regimes: named families of pairs that random poses never hit.
//
// A case is made from the regime, a seed and an index alone, with the same bits on every platform
// (as far as Qhull lists a hull's faces in the same order), and none before it has to be made. What
// is asked for (a gap, a depth) comes as close as the rounding of a translation and a rotation to
// doubles allows; what was achieved is for the oracle to say.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "harness/base/random.h"
#include "harness/files/cases.h"
#include "harness/grade/pair_size.h"

namespace touchstone::check {

struct Regime;

// What a case is drawn from.
struct RegimeDraw {
  const Regime& regime;
  std::uint64_t seed, index;
  base::Random random;  // of this case alone
};

// A case without an id, and what tells it from others of its regime, such as "edge-edge".
struct RegimeCase {
  files::Case pair;
  std::string detail;
};

struct Regime {
  std::string name;      // "gap-1e-9": lower case, words joined by '-'
  std::string group;     // "gap", "depth", "touching", "coincident", "degenerate", "aspect", ...
  std::string what;      // one line for people
  bool extreme = false;  // beyond unit scale: proportions, sizes, places or ratios are extreme
  double parameter = 0;  // gap (> 0) or depth (< 0) as a part of the pair's size; aspect, scale in
                         // metres, distance in metres, ratio; 0 where there is none
  RegimeCase (*draw)(RegimeDraw&) = nullptr;
};

// All of them, groups together, in a stable order.
std::span<const Regime> regimes();
// Null where there is none of that name.
const Regime* find_regime(std::string_view name);

// Its id is "regime/kind-kind/detail/index", such as "gap-1e-9/box-box/edge-edge/17". Safe to call
// from several threads.
files::Case make(const Regime& regime, std::uint64_t seed, std::uint64_t index);

}  // namespace touchstone::check
