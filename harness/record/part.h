// A part of planned work that is done by itself.
#pragma once

#include "harness/base/unit_range.h"
#include "harness/record/facts.h"

namespace touchstone::record {

// The folder of a part holds the rows of its units, without what is made of all rows.
struct Part {
  base::UnitRange units;
  // Facts of machine.csv that say whose part it is: the plan, the shard, and more. They must be
  // equal to resume.
  Facts facts;
  Facts notes = {};  // further ones, which may differ
};

inline constexpr const char* part_fact = "part";

// Appends the facts of a part.
inline void append_facts(const Part& part, Facts& facts) {
  facts.emplace_back(part_fact, to_string(part.units));
  facts.insert(facts.end(), part.facts.begin(), part.facts.end());
}

}  // namespace touchstone::record
