// Places pairs of given kinds in a mild contact.
#include "harness/check/axes/mild_pair.h"

#include <array>

#include "harness/check/regimes/placement.h"
#include "harness/grade/pair_size.h"

namespace touchstone::check {

KindPair kinds_of_slot(std::uint64_t slot) {
  using enum ShapeKind;
  constexpr std::array<KindPair, 16> pairs = {{{box, box},
                                               {hull, hull},
                                               {sphere, box},
                                               {capsule, capsule},
                                               {box, hull},
                                               {ellipsoid, ellipsoid},
                                               {capsule, hull},
                                               {cylinder, box},
                                               {sphere, hull},
                                               {cone, hull},
                                               {capsule, box},
                                               {box, halfspace},
                                               {box, box},
                                               {hull, hull},
                                               {sphere, capsule},
                                               {cylinder, ellipsoid}}};
  return pairs[slot % pairs.size()];
}

MildAmount mild_amount(base::Random& random) {
  constexpr std::array<const char*, 3> names = {"1e-1", "1e-2", "1e-3"};
  constexpr std::array<double, 3> values = {1e-1, 1e-2, 1e-3};
  const std::uint64_t k = random.below(3);
  if (random.below(2) == 0) return {std::string("gap-") + names[k], values[k]};
  return {std::string("depth-") + names[k], -values[k]};
}

std::string place_at_features(files::Case& c, double gap, bool fine, base::Random& random) {
  const FeatureKind kind_a = random_feature_kind(c.shape_a, random);
  const FeatureKind kind_b = random_feature_kind(c.shape_b, random);
  const Feature a = pick_feature(c.shape_a, kind_a, grade::shape_size(c.shape_b) / 2, random);
  const Feature b = pick_feature(c.shape_b, kind_b, grade::shape_size(c.shape_a) / 2, random);
  c.pose_b.rotation = facing(c.pose_a.rotation, a, b, false, random);
  place(c, a, b, gap, fine);
  return std::string(to_string(a.kind)) + "-" + std::string(to_string(b.kind));
}

std::string place_mildly(files::Case& c, double length, base::Random& random) {
  if (random.below(8) == 0) {
    c.pose_b.rotation = random.rotation();
    place_at_random(c, random);
    return "random";
  }
  const MildAmount amount = mild_amount(random);
  return place_at_features(c, amount.value * length, false, random) + "-" + amount.name;
}

}  // namespace touchstone::check
