// The axes of pairs: along each, one property of a pair grows to its extreme.
//
// Everything else stays mild: bodies of a metre whose sides are within a factor of four of each
// other, near the origin, at gaps and depths of a tenth to a thousandth. So the first value at
// which an algorithm fails shows the effect of that property alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/kinds/pair/regimes/regimes.h"

namespace touchstone::kinds {

struct Axis {
  std::string name;               // "scale-down": lower case, words joined by '-'
  std::string unit;               // unit of the values, in words
  std::string what;               // one line of description
  std::vector<AxisValue> values;  // from mild to extreme
  bool extreme = true;            // see Regime
  RegimeCase (*draw)(RegimeDraw&) = nullptr;
  // Returns whether the exact answer is the requested one (size: pair_size, metres). Null if the
  // shapes alone decide the value, and not their poses.
  bool (*accepts)(double value, const oracle::Measure& exact, double size) = nullptr;
  // Returns the limit on the cases of a value; it is lower for large hulls.
  std::uint64_t most_cases(double value) const;
};

inline const AxisValue& value_of(const Regime& regime) { return regime.axis->values[regime.place]; }

std::span<const Axis> axes();
// Returns the regimes of an axis, one for each of its values, which draw their cases. The axis must outlive
// the result.
std::vector<Regime> regimes_of(const Axis& axis);
// Returns the regimes of all axes.
std::span<const Regime> regimes_of_axes();

// A slot of a value has this many case indices: it takes the first case that is accepted.
inline constexpr std::uint64_t tries = 8;
inline std::uint64_t slot_of(std::uint64_t index) { return index / tries; }

}  // namespace touchstone::kinds
