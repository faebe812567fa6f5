// The axes of the stress sweep: along each, one property of a pair grows to its extreme.
//
// Everything else stays mild: bodies of a metre whose sides are within a factor of four of each
// other, near the origin, at gaps and depths of a tenth to a thousandth. So the first value at
// which an algorithm fails says what that property alone did to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/regimes/regimes.h"

namespace touchstone::check {

struct AxisValue {
  std::string name;  // "1e-3"; "0" where the property is not there at all
  double value = 0;
};

struct StressAxis {
  std::string name;               // "scale-down": lower case, words joined by '-'
  std::string unit;               // of the values, in words
  std::string what;               // one line for people
  std::vector<AxisValue> values;  // from mild to extreme
  bool extreme = true;            // see Regime
  RegimeCase (*draw)(RegimeDraw&) = nullptr;
  // Whether the exact answer is what the value asks for (size: pair_size, metres). Null: what the
  // bodies are decides the value, and not how they lie.
  bool (*accepts)(double value, const oracle::Measure& exact, double size) = nullptr;
  // Of the cases of a value; the rest is not drawn where bodies are large.
  std::uint64_t most_cases(double value) const;
};

// A place on an axis, and the regime that its cases are drawn from.
struct StressCell {
  const StressAxis* axis = nullptr;
  std::size_t place = 0;  // in the axis' values
  Regime regime;          // its parameter is the value

  const AxisValue& value() const { return axis->values[place]; }
};

std::span<const StressAxis> axes();
// Those of these axes, in order. The axes stay alive.
std::vector<StressCell> cells_of(std::span<const StressAxis* const> axes);

// A case's index in its regime: of several tries to draw a slot the first that is accepted counts.
inline constexpr std::uint64_t tries = 8;
inline std::uint64_t slot_of(std::uint64_t index) { return index / tries; }

}  // namespace touchstone::check
