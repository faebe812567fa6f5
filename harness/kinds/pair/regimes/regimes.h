// Regimes: named families of pairs that random poses never hit.
//
// A case depends only on the regime, a seed and an index, with the same bits on every platform (as
// far as Qhull lists a hull's faces in the same order), and can be made without those before it.
// The requested value (a gap, a depth) is met as closely as the rounding of a translation and a
// rotation to doubles allows; the oracle computes the value achieved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "harness/base/random.h"
#include "harness/files/cases.h"
#include "harness/grade/margins.h"
#include "harness/kinds/batch.h"

namespace touchstone::kinds {

struct Axis;
struct Regime;

// The input of a draw.
struct RegimeDraw {
  const Regime& regime;
  std::uint64_t seed, index;
  base::Random random;  // random numbers of this case alone
};

// A case without an id, and a detail such as "edge-edge" that distinguishes it within its regime.
struct RegimeCase {
  files::Case pair;
  std::string detail;
};

struct Regime {
  std::string name;      // "gap-1e-9": lower case, words joined by '-'
  std::string group;     // "gap", "depth", "touching", "coincident", "degenerate", "aspect", ...
  std::string what;      // one line of description
  bool extreme = false;  // beyond unit scale: proportions, sizes, places or ratios are extreme
  // The regime's number, or 0: gap (> 0) or depth (< 0) as a part of the pair's size, aspect, scale
  // in metres, distance in metres, ratio.
  double parameter = 0;
  RegimeCase (*draw)(RegimeDraw&) = nullptr;
  // Of a regime that is a value of an axis (axes.h), and its place among the values.
  const Axis* axis = nullptr;
  std::size_t place = 0;
};

// Returns the family of pairs that a regime is. The regime must outlive it.
Family family_of(const Regime& regime);

// Returns all regimes, grouped, in a stable order.
std::span<const Regime> regimes();
// Returns null if there is no regime of that name.
const Regime* find_regime(std::string_view name);

// Makes a case with the id "regime/kind-kind/detail/index", such as
// "gap-1e-9/box-box/edge-edge/17". Safe to call from several threads.
files::Case make(const Regime& regime, std::uint64_t seed, std::uint64_t index);

}  // namespace touchstone::kinds
