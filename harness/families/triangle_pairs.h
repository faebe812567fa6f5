// Pairs of triangles that algorithms find hard, in families.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algorithms/core/pose.h"
#include "harness/families/draws.h"

namespace touchstone::families {

struct TrianglePair {
  std::array<Vec3d, 3> a, b;
  Pose pose_a, pose_b;
};

struct TriangleFamily {
  std::string name;  // lower case, words joined by '-'
  TrianglePair (*make)(Draws& random, double size);
  double size = 0;         // of what is small in it: a gap or depth, a width (metres), or 0
  bool only_hits = false;  // nearly all pairs meet by their making

  TrianglePair draw(Draws& random) const { return make(random, size); }
};

const std::vector<TriangleFamily>& triangle_families();

// Those with a size, at any: edges or a vertex and a face that near to each other or that deep; triangles that
// narrow; planes so little apart or tilted.
TrianglePair edges_near(Draws& random, double size);
TrianglePair vertex_near_face(Draws& random, double size);
TrianglePair slivers(Draws& random, double size);
TrianglePair parallel_planes(Draws& random, double size);

// How a pair of a family is given to the algorithms.
enum class TriangleForm { as_drawn, float_vertices, one_pose, two_poses, far_away };
inline constexpr std::array all_triangle_forms = {
    TriangleForm::as_drawn, TriangleForm::float_vertices, TriangleForm::one_pose,
    TriangleForm::two_poses, TriangleForm::far_away};

// one_pose and far_away place both bodies alike, so that points that coincide still do; two_poses
// turns b's vertices back, so that touches come apart by rounding. far_away also has vertices at 1e6.
TrianglePair in_form(TrianglePair pair, TriangleForm form, Draws& random);

}  // namespace touchstone::families
