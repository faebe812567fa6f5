// The table of all axes, and the regimes of their values.
#include "harness/check/axes/axes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/base/error.h"
#include "harness/check/axes/axis_draws.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/selection.h"

namespace touchstone::check {
namespace {

// The double nearest to each power of ten.
constexpr std::array<double, 17> powers = {1e0, 1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7, 1e8,
                                           1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16};
constexpr std::array<double, 17> parts = {1e0,   1e-1,  1e-2,  1e-3,  1e-4,  1e-5,
                                          1e-6,  1e-7,  1e-8,  1e-9,  1e-10, 1e-11,
                                          1e-12, 1e-13, 1e-14, 1e-15, 1e-16};

std::vector<kinds::AxisValue> up_to(std::size_t exponent) {
  std::vector<kinds::AxisValue> values;
  for (std::size_t k = 0; k <= exponent; ++k) values.push_back({fmt::format("1e{}", k), powers[k]});
  return values;
}

std::vector<kinds::AxisValue> down_to(std::size_t exponent) {
  std::vector<kinds::AxisValue> values = {{"1e0", 1}};
  for (std::size_t k = 1; k <= exponent; ++k) values.push_back({fmt::format("1e-{}", k), parts[k]});
  return values;
}

std::vector<kinds::AxisValue> from_zero(std::vector<kinds::AxisValue> values) {
  values.insert(values.begin(), {"0", 0});
  return values;
}
// Drops the value 1, so that the values begin at a tenth.
std::vector<kinds::AxisValue> from_a_tenth(std::vector<kinds::AxisValue> values) {
  values.erase(values.begin());
  return values;
}
std::vector<kinds::AxisValue> and_zero(std::vector<kinds::AxisValue> values) {
  values.push_back({"0", 0});
  return values;
}

std::vector<kinds::AxisValue> counts() {
  std::vector<kinds::AxisValue> values = {{"4", 4}};
  for (std::size_t k = 1; k <= 5; ++k) values.push_back({fmt::format("1e{}", k), powers[k]});
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
      {"scale-down", "metres", "both bodies so large", down_to(12), true, draw_at_scale},
      {"scale-up", "metres", "both bodies so large", up_to(12), true, draw_at_scale},
      {"aspect", "longest side over shortest", "needles and plates of such proportions", up_to(10),
       true, draw_at_aspect},
      {"distance", "metres from the origin", "bodies of a metre, both so far away",
       from_zero(up_to(12)), true, draw_at_distance},
      {"ratio", "size over size", "a body of a metre and a smaller one", up_to(12), true,
       draw_at_ratio},
      {"gap", "parts of the size", "apart by so much", down_to(16), false, draw_at_gap, has_gap},
      {"depth", "parts of the size", "overlapping by so much", down_to(16), false, draw_at_depth,
       has_depth},
      {"vertices", "vertices of a hull", "a hull of so many vertices and another body", counts(),
       false, draw_with_vertices},
      {"coplanar", "parts of the size",
       "faces that bulge by so much, and boxes side by side whose faces miss one plane by it",
       and_zero(from_a_tenth(down_to(16))), true, draw_near_coplanar},
      {"parallel", "radians", "edges, sides or faces in contact at such an angle",
       and_zero(down_to(16)), true, draw_near_parallel},
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

std::vector<const Regime*> select_axes(const std::string& names) {
  static const std::vector<std::vector<Regime>> all = [] {
    std::vector<std::vector<Regime>> list;
    for (const Axis& axis : axes()) list.push_back(regimes_of(axis));
    return list;
  }();
  std::vector<const Regime*> chosen;
  const auto choose = [&](const Axis& axis) {
    for (const Regime& one : all[static_cast<std::size_t>(&axis - axes().data())]) {
      if (std::ranges::find(chosen, &one) == chosen.end()) chosen.push_back(&one);
    }
  };
  if (names.empty()) {
    for (const Axis& axis : axes()) choose(axis);
    return chosen;
  }
  for (const std::string& name : kinds::split_names(names)) {
    const auto at = std::ranges::find(axes(), name, &Axis::name);
    if (at == axes().end()) {
      std::vector<std::string_view> known;
      for (const Axis& axis : axes()) known.push_back(axis.name);
      for (const kinds::Family* family : kinds::axis_families()) {
        if (known.back() != family->axis) known.push_back(family->axis);
      }
      throw base::InputError(
          fmt::format("no axis is called '{}'; expected some of {}", name, fmt::join(known, ", ")));
    }
    choose(*at);
  }
  return chosen;
}

}  // namespace touchstone::check
