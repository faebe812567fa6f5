// Metamorphic relations: changes of a case that must not change its exact answer.
//
// Chen, Cheung, Yiu, "Metamorphic testing: a new approach for generating next test cases", 1998.
// The changed case has the same exact answer, but rounds otherwise and branches otherwise, so an
// algorithm that answers the two differently is wrong about one of them, and no oracle is needed to
// see it.
#pragma once

#include <string>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/base/random.h"
#include "harness/files/cases.h"
#include "harness/geometry/signed_permutation.h"

namespace touchstone::check {

// A changed case: x in the world of the original is 2^exponent * rotation(x) + translation in that
// of the variant, exactly, for every point of both bodies.
struct Variant {
  std::string name;         // "swap", "rotation+y+z+x", "translation", "scale-2^-20", "vertices"
  files::Case transformed;  // with the original's id, a '/' and the name
  bool swapped = false;
  geometry::SignedPermutation rotation;
  Vec3d translation = Vec3d::Zero();  // metres
  int exponent = 0;
};

// The bodies exchanged.
Variant swap_variant(const files::Case& c);
// Both poses turned.
Variant rotation_variant(const files::Case& c, const geometry::SignedPermutation& rotation);
// Both bodies moved by a translation under which no coordinate is rounded. Tries the opposites of
// both translations, and random ones, for each axis; empty where there is none but zero.
std::vector<Variant> translation_variants(const files::Case& c, base::Random& random);
// All lengths times 2^exponent; empty where a number would overflow, or become subnormal.
std::vector<Variant> scale_variants(const files::Case& c, int exponent);
// The vertices of hulls in another order, which may give other facets; empty without a hull.
std::vector<Variant> vertex_variants(const files::Case& c, base::Random& random);

// One of each that is possible, with a random rotation other than none, and a scale up and a scale
// down by up to 2^40.
std::vector<Variant> variants(const files::Case& c, base::Random& random);

// An outcome of the variant, as it would be of the original. Exact as long as nothing overflows or
// becomes subnormal, but that coordinates of witness points are rounded once where the variant was
// translated.
Outcome to_original(const Variant& variant, const Outcome& outcome);

}  // namespace touchstone::check
