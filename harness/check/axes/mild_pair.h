// What the draws of several axes share: pairs of given kinds in a mild contact.
#pragma once

#include <string>

#include "harness/base/random.h"
#include "harness/check/regimes/features.h"
#include "harness/files/cases.h"

namespace touchstone::check {

struct KindPair {
  ShapeKind a, b;
};
// Each algorithm's kinds come in every sixteen slots, polytopes most.
KindPair kinds_of_slot(std::uint64_t slot);

// Of a tenth, a hundredth or a thousandth; < 0: a depth.
struct MildAmount {
  std::string name;  // "gap-1e-2"
  double value;      // as a part of some length
};
MildAmount mild_amount(base::Random& random);

// Puts b of a case whose shapes and whose pose of a are set at `gap` (metres; < 0: a depth) between
// random features, and turns it. `fine` as in placement.h. Returns the features' names.
std::string place_at_features(files::Case& c, double gap, bool fine, base::Random& random);

// The same at a mild part of `length` (metres), or now and then anywhere. Returns what it did.
std::string place_mildly(files::Case& c, double length, base::Random& random);

}  // namespace touchstone::check
