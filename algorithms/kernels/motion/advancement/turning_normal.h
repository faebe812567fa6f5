// How the normal between two bodies turns with the features that are nearest. Used by the loop of conservative
// advancement (advancement.h).
//
// A plane that keeps its direction soon meets the corners of a face that turns. One that turns with the face meets
// nothing before the other body does.
// Steps:   1. Three corners of a, or of b, span a face: the normal turns with that body.
//          2. An edge of each: the normal is along their cross product, whose rate of turn follows from theirs. About
//             itself the normal may turn at any rate; the mean of the bodies' keeps the bounds on them small.
//          3. Other features leave the normal to the distance between them: it has no rate of its own.
// Fails:   nothing is told of edges that are nearly parallel.
#pragma once

#include "algorithms/core/vec.h"
#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// The normal's angular velocity (radians in the whole time, world axes), or zero where features of polytopes do not
// tell. `nearest` is the simplex of the difference a - b nearest to the origin; `turn_a` and `turn_b` are the bodies'
// angular velocities. It is a choice, not a bound: any angular velocity is as right, and serves a shorter time.
Vec3d turning_of_normal(const Simplex<double>& nearest, const Vec3d& normal, const Vec3d& turn_a,
                        const Vec3d& turn_b);

// The same for a normal across an edge of each body (of any length).
Vec3d turning_across_edges(const Vec3d& edge_a, const Vec3d& edge_b, const Vec3d& normal,
                           const Vec3d& turn_a, const Vec3d& turn_b);

}  // namespace touchstone
