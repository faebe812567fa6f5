// Part of mpr-ray-cast: the search for a portal around the path of one pair.
#pragma once

#include <array>

#include "algorithms/kernels/motion/linear/linear_cast.h"

namespace touchstone {

// The shortest path, in the pair's unit, whose direction doubles tell well. Shorter ones are left to GJK.
inline constexpr double least_path = 1e-6;
// Twice the area of the least portal, in that unit, whose normal has unit length: squares of lesser ones underflow.
inline constexpr double least_area = 1e-150;

// How far directions lean to the entry while a portal is looked for.
double lean_of(const MovingPair& pair);

// The unit normal of a portal with these corners, from a to b; zero if it has no area.
Vec3d portal_normal(const std::array<Vec3d, 3>& places);

// Moves the pair to where the path meets a closed portal, and returns `hit` if the portal is nearer there than the
// tolerance: at time 0, where no plane parted them, the bodies touch. `along` is the unit direction of the path,
// `places` are the portal's corners relative to the path, and the first three points of `found.simplex` are these
// corners.
PathEnd meet_portal(MovingPair& pair, const Vec3d& along, const std::array<Vec3d, 3>& places,
                    double tolerance, PathContact& found);

// Both cores are polytopes. GJK searches where no portal is found.
PathEnd search_by_portal(MovingPair& pair, double tolerance, int most_iterations,
                         PathContact& found);

}  // namespace touchstone
