// Triangle meshes of simple bodies that are not convex, or that strain algorithms. Used by cells and
// tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "harness/geometry/mesh.h"

namespace touchstone::geometry {

// All coordinates are floats (metres), the same on every machine. All but the terrain are closed, their
// triangles anticlockwise seen from outside. Counts are at least 3.

// A ring around z: `around` quadrilaterals along the centre line of radius 1, `across` around the tube of
// this radius (below 1).
Mesh torus(std::size_t around, std::size_t across, double tube_radius);

// A tube around a trefoil knot that is about 3 across: `along` quadrilaterals along it, `across` around it.
Mesh trefoil(std::size_t along, std::size_t across, double tube_radius);

// The ellipsoid of these semi-axes: `stacks` rings of `slices` triangles. Both poles have `slices` triangles.
Mesh ellipsoid_with_poles(const Vec3d& radii, std::size_t stacks, std::size_t slices);

// A toothed wheel about z with a hole: its tips are 1 from the axis, the roots between the teeth
// `root_radius` (between `hole_radius` and 1). 32 triangles a tooth.
Mesh gear(std::size_t teeth, double root_radius, double hole_radius, double thickness);

// A square of hills over [-1, 1] on x and y, `cells` by `cells` quadrilaterals; heights by
// octaves of value noise from this seed.
Mesh terrain(std::size_t cells, double height, std::uint64_t seed);

// A surface over a grid about the origin of x and y, whose cells are `x` by `y` metres. `heights` has rows
// from the greatest y down, each from the least x up; there are two at least of each. A cell is split
// along its diagonal from the least x and y to the greatest.
Mesh height_field(std::size_t rows, std::size_t columns, std::span<const double> heights, double x,
                  double y);

// A mesh by its name: a file, or one of those above with a number of triangles.

// "torus-2000", "trefoil-10000", "ellipsoid-5000" and "terrain-100000" are of about so many triangles
// (32 to 10 million); any other name is a file, relative to `home`. Throws InputError as read_surface does,
// and for another number.
Mesh named_mesh(const std::string& name, const std::filesystem::path& home);

}  // namespace touchstone::geometry
