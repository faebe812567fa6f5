// The families of pairs.
#include "harness/families/triangle_pairs.h"

#include <cmath>

namespace touchstone::families {
namespace {

using Corners = std::array<Vec3d, 3>;

Corners any(Draws& random, double reach = 1) {
  return {random.vector(reach), random.vector(reach), random.vector(reach)};
}
TrianglePair of(const Corners& a, const Corners& b) { return {a, b, {}, {}}; }

// A number that no rounding of sums and products of a few others touches.
double eighth(Draws& random, int reach) {
  return static_cast<double>(random.below(2 * reach + 1) - reach) / 8;
}
Vec3d grid_point(Draws& random) {
  return {eighth(random, 16), eighth(random, 16), eighth(random, 16)};
}
Corners on_grid(Draws& random) {
  return {grid_point(random), grid_point(random), grid_point(random)};
}
// A point of the triangle whose weights are eighths: exact for corners on the grid.
Vec3d inside(const Corners& t, Draws& random) {
  const int u = random.below(9), v = random.below(9 - u);
  return t[0] + (t[1] - t[0]) * (u / 8.0) + (t[2] - t[0]) * (v / 8.0);
}
double either_sign(Draws& random, double size) { return random.below(2) == 0 ? size : -size; }

TrianglePair generic(Draws& random, double /*size*/) {
  const Corners b = any(random), a = any(random);
  return of(a, b);
}

TrianglePair coplanar(Draws& random, double /*size*/) {
  const Vec3d origin = grid_point(random), u = grid_point(random), v = grid_point(random);
  const auto point = [&] {
    const int on_v = random.below(7), on_u = random.below(7);
    return Vec3d(origin + u * on_u + v * on_v);
  };
  const Corners b = {point(), point(), point()}, a = {point(), point(), point()};
  return of(a, b);
}

TrianglePair shared_vertex(Draws& random, double /*size*/) {
  TrianglePair pair = generic(random, 0);
  pair.b[random.below(3)] = pair.a[random.below(3)];
  return pair;
}

TrianglePair shared_edge(Draws& random, double /*size*/) {
  TrianglePair pair = generic(random, 0);
  const int at = random.below(3);
  pair.b[at] = pair.a[0];
  pair.b[(at + 1) % 3] = pair.a[1];
  return pair;
}

TrianglePair pair_on_grid(Draws& random) {
  const Corners b = on_grid(random), a = on_grid(random);
  return of(a, b);
}

TrianglePair vertex_on_face(Draws& random, double /*size*/) {
  TrianglePair pair = pair_on_grid(random);
  pair.b[0] = inside(pair.a, random);
  return pair;
}

TrianglePair edge_on_edge(Draws& random, double /*size*/) {
  TrianglePair pair = pair_on_grid(random);
  const Vec3d middle = (pair.a[0] + pair.a[1]) / 2, way = grid_point(random);
  pair.b[0] = middle - way * 2;
  pair.b[1] = middle + way;
  return pair;
}

TrianglePair degenerate(Draws& random, double /*size*/) {
  TrianglePair pair = pair_on_grid(random);
  pair.a[2] = random.below(3) == 0 ? pair.a[0] : Vec3d((pair.a[0] + pair.a[1]) / 2);
  if (random.below(3) == 0) pair.a[1] = pair.a[2] = pair.a[0];
  if (random.below(2) == 0) pair.b[2] = pair.b[1];
  if (random.below(2) == 0) pair.b[0] = inside(pair.a, random);
  return pair;
}

TrianglePair itself(Draws& random, double /*size*/) {
  TrianglePair pair = generic(random, 0);
  pair.b = pair.a;
  if (random.below(2) == 0) {
    double& x = pair.b[random.below(3)][random.below(3)];
    x = std::nextafter(x, 2);
  }
  return pair;
}

Pose any_pose(Draws& random) {
  Pose pose;
  pose.rotation = random.rotation();
  pose.translation = random.vector(3);
  return pose;
}

// Moves the second triangle by the size along a normal of both, to either side.
TrianglePair moved_along(TrianglePair pair, Vec3d normal, Draws& random, double size) {
  if (normal.norm() < 1e-3) normal = Vec3d::UnitX();
  const Vec3d step = normal.normalized() * either_sign(random, size);
  for (Vec3d& corner : pair.b) corner += step;
  return pair;
}

}  // namespace

TrianglePair edges_near(Draws& random, double size) {
  const TrianglePair pair = edge_on_edge(random, 0);
  return moved_along(pair, (pair.a[1] - pair.a[0]).cross(pair.b[1] - pair.b[0]), random, size);
}

TrianglePair vertex_near_face(Draws& random, double size) {
  const TrianglePair pair = vertex_on_face(random, 0);
  return moved_along(pair, (pair.a[1] - pair.a[0]).cross(pair.a[2] - pair.a[0]), random, size);
}

TrianglePair slivers(Draws& random, double size) {
  TrianglePair pair = generic(random, 0);
  for (Corners* t : {&pair.a, &pair.b}) {
    (*t)[2] = ((*t)[0] + (*t)[1]) / 2 + random.direction() * either_sign(random, size);
  }
  if (random.below(2) == 0) {
    const Vec3d step = (pair.a[0] + pair.a[1]) / 2 - (pair.b[0] + pair.b[1]) / 2;
    for (Vec3d& corner : pair.b) corner += step;
  }
  return pair;
}

TrianglePair parallel_planes(Draws& random, double size) {
  TrianglePair pair = generic(random, 0);
  const Vec3d normal = (pair.a[1] - pair.a[0]).cross(pair.a[2] - pair.a[0]).normalized();
  const double step = either_sign(random, size);
  const bool tilted = random.below(2) == 0;
  const Vec3d u = pair.a[1] - pair.a[0], v = pair.a[2] - pair.a[0];
  for (Vec3d& corner : pair.b) {
    const double off = tilted ? step * random.uniform(-1, 1) : step;
    const double on_v = random.uniform(-1, 1), on_u = random.uniform(-1, 1);
    corner = pair.a[0] + u * on_u + v * on_v + normal * off;
  }
  return pair;
}

const std::vector<TriangleFamily>& triangle_families() {
  static const std::vector<TriangleFamily> families = {
      {"generic", generic},
      {"coplanar", coplanar},
      {"shared-vertex", shared_vertex, 0, true},
      {"shared-edge", shared_edge, 0, true},
      {"vertex-on-face", vertex_on_face, 0, true},
      {"edge-on-edge", edge_on_edge, 0, true},
      {"edges-1e-3", edges_near, 1e-3},
      {"edges-1e-6", edges_near, 1e-6},
      {"edges-1e-9", edges_near, 1e-9},
      {"edges-1e-12", edges_near, 1e-12},
      {"edges-1e-15", edges_near, 1e-15},
      {"vertex-face-1e-6", vertex_near_face, 1e-6},
      {"vertex-face-1e-9", vertex_near_face, 1e-9},
      {"vertex-face-1e-12", vertex_near_face, 1e-12},
      {"vertex-face-1e-15", vertex_near_face, 1e-15},
      {"slivers-1e-6", slivers, 1e-6},
      {"slivers-1e-9", slivers, 1e-9},
      {"slivers-1e-15", slivers, 1e-15},
      {"degenerate", degenerate},
      {"parallel-1e-6", parallel_planes, 1e-6},
      {"parallel-1e-9", parallel_planes, 1e-9},
      {"parallel-1e-15", parallel_planes, 1e-15},
      {"itself", itself, 0, true},
  };
  return families;
}

TrianglePair in_form(TrianglePair pair, TriangleForm form, Draws& random) {
  if (form == TriangleForm::float_vertices) {
    for (auto* corners : {&pair.a, &pair.b}) {
      for (Vec3d& corner : *corners) corner = corner.cast<float>().cast<double>();
    }
  }
  if (form == TriangleForm::one_pose) pair.pose_a = pair.pose_b = any_pose(random);
  if (form == TriangleForm::two_poses) {
    pair.pose_a = any_pose(random);
    pair.pose_b = any_pose(random);
    for (Vec3d& corner : pair.a) {
      corner = pair.pose_a.rotation.transpose() * (corner - pair.pose_a.translation);
    }
    for (Vec3d& corner : pair.b) {
      corner = pair.pose_b.rotation.transpose() * (corner - pair.pose_b.translation);
    }
  }
  if (form == TriangleForm::far_away) {
    const Vec3d away(1e6, -2e6, 3e6);
    for (auto* corners : {&pair.a, &pair.b}) {
      for (Vec3d& corner : *corners) corner += away;
    }
    pair.pose_a = pair.pose_b = any_pose(random);
  }
  return pair;
}

}  // namespace touchstone::families
