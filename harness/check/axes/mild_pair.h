// Pairs of given kinds in a mild contact, for the draws of several axes.
#pragma once

#include <string>

#include "harness/base/random.h"
#include "harness/check/regimes/features.h"
#include "harness/files/cases.h"

namespace touchstone::check {

struct KindPair {
  ShapeKind a, b;
};
// Returns the kinds of a slot. Every algorithm's kinds come within sixteen slots, polytopes most
// often.
KindPair kinds_of_slot(std::uint64_t slot);

// A gap of a tenth, a hundredth or a thousandth; < 0: a depth.
struct MildAmount {
  std::string name;  // such as "gap-1e-2"
  double value;      // part of a length
};
MildAmount mild_amount(base::Random& random);

// Places b at `gap` (metres; < 0: a depth) between random features of both bodies, and turns it.
// The shapes and the pose of a must be set; `fine` is as in placement.h. Returns the features'
// names.
std::string place_at_features(files::Case& c, double gap, bool fine, base::Random& random);

// Places b at a mild part of `length` (metres), or now and then anywhere. Returns the detail of the
// case.
std::string place_mildly(files::Case& c, double length, base::Random& random);

}  // namespace touchstone::check
