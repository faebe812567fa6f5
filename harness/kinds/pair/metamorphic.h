// Metamorphic relations: changes of a case that must not change its exact answer.
//
// The variant has the same exact answer, but is rounded otherwise and takes other branches. So an
// algorithm whose two answers differ is wrong about one of them, and no oracle is needed to see it.
//
// Chen, Cheung, Yiu, "Metamorphic testing: a new approach for generating next test cases", 1998.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/base/random.h"
#include "harness/files/cases.h"
#include "harness/geometry/signed_permutation.h"

namespace touchstone::kinds {

// A changed case. In world coordinates, it maps every point x of both bodies exactly to 2^exponent
// * rotation(x) + translation.
struct Variant {
  std::string name;  // such as "swap", "rotation+y+z+x", "translation", "scale-2^-20", "vertices"
  files::Case transformed;  // has the original's id, a '/' and the name
  bool swapped = false;
  geometry::SignedPermutation rotation;
  Vec3d translation = Vec3d::Zero();  // metres
  int exponent = 0;
};

// Exchanges the bodies.
Variant swap_variant(const files::Case& c);
// Rotates both poses.
Variant rotation_variant(const files::Case& c, const geometry::SignedPermutation& rotation);
// Translates both bodies without rounding any coordinate. For each axis it tries the opposites of
// both translations and a random one; the result is empty if only zero is possible.
std::vector<Variant> translation_variants(const files::Case& c, base::Random& random);
// Multiplies all lengths by 2^exponent; empty if a number would overflow or become subnormal.
std::vector<Variant> scale_variants(const files::Case& c, int exponent);
// Reorders the vertices of hulls, which may give other facets; empty without a hull.
std::vector<Variant> vertex_variants(const files::Case& c, base::Random& random);

// Returns one of each possible variant, with a random rotation other than the identity, and a scale
// up and a scale down by up to 2^40.
std::vector<Variant> variants(const files::Case& c, base::Random& random);

// Returns the variants of a case that is sampled, and none for other cases.
std::vector<Variant> sampled_variants(const files::Case& c, std::uint64_t seed,
                                      std::uint64_t index);
// Returns "rotation" for "rotation+y+z+x".
std::string kind_of(const Variant& variant);

// Maps an outcome of the variant back to the original. Exact as long as nothing overflows or
// becomes subnormal, except that coordinates of witness points are rounded once if the variant was
// translated.
Outcome to_original(const Variant& variant, const Outcome& outcome);

}  // namespace touchstone::kinds
