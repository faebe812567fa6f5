// What the tests of casts without rotation share.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/algorithms/cast/moving_bodies.h"

namespace touchstone::reference {

inline constexpr std::array bounded_kinds = {
    ShapeKind::sphere, ShapeKind::capsule,   ShapeKind::box, ShapeKind::cylinder,
    ShapeKind::cone,   ShapeKind::ellipsoid, ShapeKind::hull};
inline constexpr std::array features = {ContactFeature::vertices, ContactFeature::face,
                                        ContactFeature::edges};

// The casts that must be right.
inline std::vector<const CastEntry*> proven_casts() {
  std::vector<const CastEntry*> all;
  for (const CastEntry& entry : registry::entries<CastEntry>()) {
    if (entry.info.origin != Origin::peer) all.push_back(&entry);
  }
  return all;
}

template <class Visit>
void for_each_pair_of_kinds(const Visit& visit) {
  for (const ShapeKind a : bounded_kinds) {
    for (const ShapeKind b : bounded_kinds) visit(a, b);
  }
}

class LinearCast : public testing::TestWithParam<const CastEntry*> {
 protected:
  const CastEntry& entry() const { return *GetParam(); }
  bool takes(const MovingPairCase& c) const {
    return offers(entry(), c.a.kind, c.b.kind, c.motion_a.turns() || c.motion_b.turns());
  }
  void check(const MovingPairCase& c, double tolerance) {
    if (!takes(c)) return;
    ++asked;
    CastSettings settings;
    settings.tolerance = tolerance;
    expect_true(entry(), c, solve(entry(), c, settings), tolerance, counts);
  }

  CastCounts counts;
  int asked = 0;
};

inline std::string name_of(const testing::TestParamInfo<const CastEntry*>& tested) {
  std::string name = tested.param->info.name;
  std::erase(name, '-');
  return name;
}

}  // namespace touchstone::reference
