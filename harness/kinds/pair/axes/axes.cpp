// The table of all axes, and the regimes of their values.
#include "harness/kinds/pair/axes/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "harness/kinds/pair/axes/axis_draws.h"

namespace touchstone::kinds {
namespace {

std::vector<AxisValue> from_zero(std::vector<AxisValue> values) {
  values.insert(values.begin(), {"0", 0});
  return values;
}
std::vector<AxisValue> and_zero(std::vector<AxisValue> values) {
  values.push_back({"0", 0});
  return values;
}

std::vector<AxisValue> counts() {
  std::vector<AxisValue> values = decades(1, 5);
  values.insert(values.begin(), {"4", 4});
  return values;
}

// Accepts gaps within a tenth of the requested one.
bool has_gap(double value, const oracle::Measure& exact, double size) {
  return exact.lower > 0.9 * value * size && exact.upper < 1.1 * value * size;
}
// Accepts depths from three tenths of the requested one up to a tenth above it: where another
// direction is shorter, the bodies overlap by less than requested.
bool has_depth(double value, const oracle::Measure& exact, double size) {
  return exact.upper < -0.3 * value * size && exact.lower > -1.1 * value * size;
}

std::vector<Axis> all_axes() {
  return {
      {"scale-down", "metres", "both bodies so large", decades(0, -12), true, draw_at_scale},
      {"scale-up", "metres", "both bodies so large", decades(0, 12), true, draw_at_scale},
      {"aspect", "longest side over shortest", "needles and plates of such proportions",
       decades(0, 10), true, draw_at_aspect},
      {"distance", "metres from the origin", "bodies of a metre, both so far away",
       from_zero(decades(0, 12)), true, draw_at_distance},
      {"ratio", "size over size", "a body of a metre and a smaller one", decades(0, 12), true,
       draw_at_ratio},
      {"gap", "parts of the size", "apart by so much", decades(0, -16), false, draw_at_gap,
       has_gap},
      {"depth", "parts of the size", "overlapping by so much", decades(0, -16), false,
       draw_at_depth, has_depth},
      {"vertices", "vertices of a hull", "a hull of so many vertices and another body", counts(),
       false, draw_with_vertices},
      {"coplanar", "parts of the size",
       "faces that bulge by so much, and boxes side by side whose faces miss one plane by it",
       and_zero(decades(-1, -16)), true, draw_near_coplanar},
      {"parallel", "radians", "edges, sides or faces in contact at such an angle",
       and_zero(decades(0, -16)), true, draw_near_parallel},
  };
}

}  // namespace

std::uint64_t Axis::most_cases(double value) const {
  if (name != "vertices" || value < 1e4) return ~std::uint64_t{0};
  return value < 1e5 ? 12 : 6;
}

std::span<const Axis> axes() {
  static const std::vector<Axis> list = all_axes();
  return list;
}

std::vector<Regime> regimes_of(const Axis& axis) {
  std::vector<Regime> regimes;
  for (std::size_t place = 0; place < axis.values.size(); ++place) {
    regimes.push_back({.name = fmt::format("stress-{}-{}", axis.name, axis.values[place].name),
                       .group = axis.name,
                       .what = axis.what,
                       .extreme = axis.extreme,
                       .parameter = axis.values[place].value,
                       .draw = axis.draw,
                       .axis = &axis,
                       .place = place});
  }
  return regimes;
}

std::span<const Regime> regimes_of_axes() {
  static const std::vector<Regime> all = [] {
    std::vector<Regime> list;
    for (const Axis& axis : axes()) {
      for (Regime& regime : regimes_of(axis)) list.push_back(std::move(regime));
    }
    return list;
  }();
  return all;
}

}  // namespace touchstone::kinds
