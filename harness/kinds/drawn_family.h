// The families of pairs of bodies that need not be convex, and of moving bodies.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/check/axes/axes.h"
#include "harness/families/draws.h"
#include "harness/files/cases.h"
#include "harness/files/concave/concave_cases.h"

namespace touchstone::kinds {

template <class Case>
struct DrawnFamily {
  std::string name, group;
  int one_in = 1;
  // Draws the case of an index, without its id.
  std::function<Case(families::Draws& draws, std::uint64_t index)> draw;
  // Of a family that is a value of an axis of stress; empty for others.
  std::string axis = {}, value = {};
};

// The values of an axis of stress from 10^first to 10^last, with names such as "1e-3".
std::vector<AxisValue> decades(int first, int last);

std::span<const DrawnFamily<files::ConcaveCase>> concave_families();
std::span<const DrawnFamily<files::CastCase>> cast_families();

}  // namespace touchstone::kinds
