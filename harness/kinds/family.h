// Families of cases: hard queries of one make, drawn from a seed.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/families/draws.h"

namespace touchstone::kinds {

class Kind;

struct Family {
  std::string name;  // "triangles-edges-1e-9": lower case, words joined by '-'
  std::string
      group;  // "triangles", "bodies", "rays", "points", "casts", "turns", "vertex-face", ...
  const Kind* kind = nullptr;
  std::uint32_t number = 0;  // among those of its kind
  int one_in = 1;            // so many times fewer cases, since the exact answer takes long
  // Of a family that is a value of an axis, along which one property grows; empty for others. The values
  // of an axis follow each other.
  std::string axis = {}, value = {};
};

// A value of an axis.
struct AxisValue {
  std::string name;  // such as "1e-3"; "0" if the property is absent
  double value = 0;
};

// The values from 10^first to 10^last, with names such as "1e-3".
std::vector<AxisValue> decades(int first, int last);

// Adds a family for each value of an axis.
void add_axis(std::vector<Family>& list, const std::string& axis,
              std::span<const AxisValue> values);

// A family that draws whole cases.
template <class Case>
struct DrawnFamily {
  std::string name, group;
  int one_in = 1;
  // Draws the case of an index, without its id.
  std::function<Case(families::Draws& draws, std::uint64_t index)> draw;
  std::string axis = {}, value = {};  // see Family
};

// The families as a kind lists them.
template <class Case>
std::vector<Family> families_of(std::span<const DrawnFamily<Case>> drawn) {
  std::vector<Family> list;
  for (const DrawnFamily<Case>& one : drawn) {
    list.push_back({.name = one.name,
                    .group = one.group,
                    .one_in = one.one_in,
                    .axis = one.axis,
                    .value = one.value});
  }
  return list;
}

}  // namespace touchstone::kinds
