// The walk of one ray through a wide tree of triangles.
#pragma once

#include "algorithms/kernels/rays/ray_mesh.h"
#include "algorithms/kernels/rays/ray_query.h"
#include "algorithms/kernels/rays/winding_query.h"

namespace touchstone::ray_tree {

// A ray in the frame of the tree: origin + tau * direction. The direction's greatest component is 1
// to 2, and the origin has been moved to where the ray comes near the mesh. tau = t * per_t - moved.
// Where rounding could lose a box, the box is met: origins of planes differ for the near and the far
// ones by more than all errors of the ray's origin.
struct LocalRay {
  std::array<float, 3> near_origin, far_origin, inverse;
  std::array<std::size_t, 3> near, far;  // which of a node's planes is met first on each axis
  // For the triangles: the axes with the direction's greatest last, the origin on them, and the shear.
  std::array<std::size_t, 3> axes;
  std::array<float, 3> origin;
  float shear_x, shear_y;
  float inverse_z;
  // Bounds on the rounding of a sheared coordinate, and of a triangle's tau, in floats.
  float off, tau_off;
  double per_t, moved;

  // A tau, rounded up, beyond which nothing is at t or before it.
  float tau_end(double t) const;
};

// Returns false if the ray is so far from the mesh (2^30 times its size) that doubles are too coarse.
bool localise(const RayMesh& mesh, const Ray& ray, LocalRay& local);

// Offers to the query every triangle that may be hit and may matter: all hits at t < query.t_end()
// are found. With `any`, it ends at the first that the query says is hit.
void walk(const RayMesh& mesh, const LocalRay& local, RayTask task, RayQuery& query);
void walk(const RayMesh& mesh, const LocalRay& local, RayTask task, WindingQuery& query);

}  // namespace touchstone::ray_tree
