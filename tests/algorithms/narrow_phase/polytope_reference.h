// What an algorithm that goes by support functions is compared with: signed distances and normals
// of bodies whose cores are polytopes, from their vertices alone, in long double; and the bodies to
// try. Takes points, segments and flat bodies as well, and hulls that came without faces; the time
// grows with the fifth power of the vertices, so these are few.
// brute_force.h is for boxes and hulls with their faces and edges, and much faster.
#pragma once

#include <array>
#include <memory>
#include <random>
#include <vector>

#include "algorithms/narrow_phase.h"

namespace touchstone::reference {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;

struct Body {
  Shape shape;
  Pose pose;
};

Shape make_sphere(double radius);
Shape make_capsule(double radius, double half_length);
Shape make_box(double x, double y, double z);
Shape make_cylinder(double radius, double half_length);
Shape make_cone(double radius, double half_length);
Shape make_ellipsoid(double x, double y, double z);
Shape make_hull(std::vector<Vec3d> vertices);  // vertices only: no faces, edges or neighbours
Shape make_halfspace(const Vec3d& normal, double offset);

// The gap between two bodies whose cores are polytopes with a few vertices, or minus their depth:
// boxes, hulls, spheres and capsules, at the poses as they stand. By definition: apart, the least
// distance of all vertices, segments and triangles between vertices of one and of the other;
// otherwise, the least height of the Minkowski difference over all normals that its faces can have.
// `normal` becomes the direction from a to b.
Real signed_distance(const Body& a, const Body& b, Vec3d& normal);
// The greatest of the bodies' extents from their centres, and of the distance between those.
double pair_size(const Body& a, const Body& b);
// How far a point is from being in the body; 0 inside. Any kind but hull.
double outside_by(const Body& body, const Vec3d& point);

// One query. Swaps the bodies for the call where their kinds are in the wrong order, and turns the
// outcome around again.
Outcome query(NarrowPhase& algorithm, Task task, const Body& a, const Body& b);

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  Vec3d direction();
  Mat3d rotation();
  Vec3d vector(double reach) {
    return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace touchstone::reference
