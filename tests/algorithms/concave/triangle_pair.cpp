// The families of pairs.
#include "tests/algorithms/concave/triangle_pair.h"

#include <cmath>

namespace touchstone::reference {
namespace {

using Corners = std::array<Vec3d, 3>;

Corners any(Random& random, double reach = 1) {
  return {random.vector(reach), random.vector(reach), random.vector(reach)};
}
TrianglePair of(const Corners& a, const Corners& b) { return {a, b, {}, {}}; }

// A number that no rounding of sums and products of a few others touches.
double eighth(Random& random, int reach) {
  return static_cast<double>(random.below(2 * reach + 1) - reach) / 8;
}
Vec3d grid_point(Random& random) {
  return {eighth(random, 16), eighth(random, 16), eighth(random, 16)};
}
Corners on_grid(Random& random) {
  return {grid_point(random), grid_point(random), grid_point(random)};
}
// A point of the triangle whose weights are eighths: exact for corners on the grid.
Vec3d inside(const Corners& t, Random& random) {
  const int u = random.below(9), v = random.below(9 - u);
  return t[0] + (t[1] - t[0]) * (u / 8.0) + (t[2] - t[0]) * (v / 8.0);
}
double tiny(Random& random, std::array<double, 3> sizes) {
  return sizes[random.below(3)] * (random.below(2) == 0 ? 1 : -1);
}

TrianglePair generic(Random& random) { return of(any(random), any(random)); }

TrianglePair coplanar(Random& random) {
  const Vec3d origin = grid_point(random), u = grid_point(random), v = grid_point(random);
  const auto point = [&] { return Vec3d(origin + u * random.below(7) + v * random.below(7)); };
  return of({point(), point(), point()}, {point(), point(), point()});
}

TrianglePair shared_vertex(Random& random) {
  TrianglePair pair = generic(random);
  pair.b[random.below(3)] = pair.a[random.below(3)];
  return pair;
}

TrianglePair shared_edge(Random& random) {
  TrianglePair pair = generic(random);
  const int at = random.below(3);
  pair.b[at] = pair.a[0];
  pair.b[(at + 1) % 3] = pair.a[1];
  return pair;
}

TrianglePair vertex_on_face(Random& random) {
  TrianglePair pair = of(on_grid(random), on_grid(random));
  pair.b[0] = inside(pair.a, random);
  return pair;
}

TrianglePair edge_on_edge(Random& random) {
  TrianglePair pair = of(on_grid(random), on_grid(random));
  const Vec3d middle = (pair.a[0] + pair.a[1]) / 2, way = grid_point(random);
  pair.b[0] = middle - way * 2;
  pair.b[1] = middle + way;
  return pair;
}

TrianglePair edges_near(Random& random) {
  TrianglePair pair = edge_on_edge(random);
  Vec3d normal = (pair.a[1] - pair.a[0]).cross(pair.b[1] - pair.b[0]);
  if (normal.norm() < 1e-3) normal = Vec3d::UnitX();
  const Vec3d step = normal.normalized() * tiny(random, {1e-3, 1e-6, 1e-9});
  for (Vec3d& corner : pair.b) corner += step;
  return pair;
}

TrianglePair vertex_near_face(Random& random) {
  TrianglePair pair = vertex_on_face(random);
  Vec3d normal = (pair.a[1] - pair.a[0]).cross(pair.a[2] - pair.a[0]);
  if (normal.norm() < 1e-3) normal = Vec3d::UnitX();
  const Vec3d step = normal.normalized() * tiny(random, {1e-6, 1e-9, 1e-12});
  for (Vec3d& corner : pair.b) corner += step;
  return pair;
}

TrianglePair slivers(Random& random) {
  TrianglePair pair = generic(random);
  for (Corners* t : {&pair.a, &pair.b}) {
    (*t)[2] = ((*t)[0] + (*t)[1]) / 2 + random.direction() * tiny(random, {1e-6, 1e-9, 1e-15});
  }
  if (random.below(2) == 0) {
    const Vec3d step = (pair.a[0] + pair.a[1]) / 2 - (pair.b[0] + pair.b[1]) / 2;
    for (Vec3d& corner : pair.b) corner += step;
  }
  return pair;
}

TrianglePair degenerate(Random& random) {
  TrianglePair pair = of(on_grid(random), on_grid(random));
  pair.a[2] = random.below(3) == 0 ? pair.a[0] : Vec3d((pair.a[0] + pair.a[1]) / 2);
  if (random.below(3) == 0) pair.a[1] = pair.a[2] = pair.a[0];
  if (random.below(2) == 0) pair.b[2] = pair.b[1];
  if (random.below(2) == 0) pair.b[0] = inside(pair.a, random);
  return pair;
}

TrianglePair parallel(Random& random) {
  TrianglePair pair = generic(random);
  const Vec3d normal = (pair.a[1] - pair.a[0]).cross(pair.a[2] - pair.a[0]).normalized();
  const double size = tiny(random, {1e-6, 1e-9, 1e-15});
  const bool tilted = random.below(2) == 0;
  const Vec3d u = pair.a[1] - pair.a[0], v = pair.a[2] - pair.a[0];
  for (Vec3d& corner : pair.b) {
    corner = pair.a[0] + u * random.uniform(-1, 1) + v * random.uniform(-1, 1) +
             normal * (tilted ? size * random.uniform(-1, 1) : size);
  }
  return pair;
}

TrianglePair itself(Random& random) {
  TrianglePair pair = generic(random);
  pair.b = pair.a;
  if (random.below(2) == 0) {
    double& x = pair.b[random.below(3)][random.below(3)];
    x = std::nextafter(x, 2);
  }
  return pair;
}

Pose any_pose(Random& random) {
  Pose pose;
  pose.rotation = random.rotation();
  pose.translation = random.vector(3);
  return pose;
}

}  // namespace

const std::vector<TriangleFamily>& triangle_families() {
  static const std::vector<TriangleFamily> families = {
      {"generic", generic},
      {"coplanar", coplanar},
      {"shared vertex", shared_vertex, true},
      {"shared edge", shared_edge, true},
      {"vertex on face", vertex_on_face, true},
      {"edge on edge", edge_on_edge, true},
      {"edges near", edges_near},
      {"vertex near face", vertex_near_face},
      {"slivers", slivers},
      {"degenerate", degenerate},
      {"parallel", parallel},
      {"itself", itself, true},
  };
  return families;
}

TrianglePair in_form(TrianglePair pair, Form form, Random& random) {
  if (form == Form::float_vertices) {
    for (auto* corners : {&pair.a, &pair.b}) {
      for (Vec3d& corner : *corners) corner = corner.cast<float>().cast<double>();
    }
  }
  if (form == Form::one_pose) pair.pose_a = pair.pose_b = any_pose(random);
  if (form == Form::two_poses) {
    pair.pose_a = any_pose(random);
    pair.pose_b = any_pose(random);
    for (Vec3d& corner : pair.a) {
      corner = pair.pose_a.rotation.transpose() * (corner - pair.pose_a.translation);
    }
    for (Vec3d& corner : pair.b) {
      corner = pair.pose_b.rotation.transpose() * (corner - pair.pose_b.translation);
    }
  }
  if (form == Form::far_away) {
    const Vec3d away(1e6, -2e6, 3e6);
    for (auto* corners : {&pair.a, &pair.b}) {
      for (Vec3d& corner : *corners) corner += away;
    }
    pair.pose_a = pair.pose_b = any_pose(random);
  }
  return pair;
}

}  // namespace touchstone::reference
