// Two bodies at a distance from each other that the oracle sees to, for tests of planes.
#pragma once

#include <utility>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::reference {

struct PlacedPair {
  Shape a, b;
  Pose pose_a = {}, pose_b = {};

  oracle::Measure measure(oracle::Oracle& oracle) const {
    const oracle::Solid solid_a(a), solid_b(b);
    return oracle.measure({solid_a, pose_a}, {solid_b, pose_b});
  }

  // Turns both, with matrices that may be a little skewed, and moves b until the signed distance is
  // about this (metres). `size` is that of the scene.
  void place(Random& random, double size, double distance, oracle::Oracle& oracle) {
    for (Pose* pose : {&pose_a, &pose_b}) {
      pose->rotation = random.rotation();
      if (random.below(3) == 0) pose->rotation.col(1) += random.vector(1e-3);
      pose->translation = random.vector(3 * size);
    }
    for (int k = 0; k < 3; ++k) {
      const oracle::Measure now = measure(oracle);
      pose_b.translation += (distance - now.middle()) * now.normal;
    }
  }
};

// A hull of points on a sphere somewhere near the origin.
inline Shape hull_somewhere(Random& random, double size, int count) {
  std::vector<Vec3d> vertices;
  const Vec3d centre = random.vector(size);
  for (int i = 0; i < count; ++i) vertices.push_back(centre + size * random.direction());
  return make_hull(std::move(vertices));
}

}  // namespace touchstone::reference
