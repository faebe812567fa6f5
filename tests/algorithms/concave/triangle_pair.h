// Pairs of triangles that algorithms find hard, in families.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algorithms/core/pose.h"
#include "tests/algorithms/random.h"

namespace touchstone::reference {

struct TrianglePair {
  std::array<Vec3d, 3> a, b;
  Pose pose_a, pose_b;
};

struct TriangleFamily {
  std::string name;
  TrianglePair (*draw)(Random& random);
  bool only_hits = false;  // nearly all pairs meet by their making
};

const std::vector<TriangleFamily>& triangle_families();

// How a pair of a family is given to the algorithms.
enum class Form { as_drawn, float_vertices, one_pose, two_poses, far_away };
inline constexpr std::array all_forms = {Form::as_drawn, Form::float_vertices, Form::one_pose,
                                         Form::two_poses, Form::far_away};

// one_pose and far_away place both bodies alike, so that points that coincide still do; two_poses
// turns b's vertices back, so that touches come apart by rounding. far_away also has vertices at 1e6.
TrianglePair in_form(TrianglePair pair, Form form, Random& random);

}  // namespace touchstone::reference
