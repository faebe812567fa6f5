// What stands for a body: from a sphere around it to its own mesh, outside or inside of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"

namespace touchstone {

enum class Form : std::uint8_t {
  as_given,      // the shape that the scene gives; of a mesh its convex hull
  sphere,        // least enclosing ball; inner: the greatest inside, of a mesh that is found
  box,           // along the body's own axes
  oriented_box,  // turned to fit
  dop14,         // k-DOP: slabs along the axes and the cube's corners (14), edges (18), both (26)
  dop18,
  dop26,
  capsule,       // fitted
  reduced_hull,  // a hull of at most `detail` vertices, 8 or more
  hull,          // the convex hull of all vertices; a convex shape is its own
  parts,         // a decomposition into convex parts, at most `detail` (0: as many as are worth it)
  mesh,          // each triangle, for a body that has a mesh: its surface, with nothing inside
  icosphere,     // round shapes as polytopes of level `detail`, 0 to 5; others as given
};

enum class Side : std::uint8_t {
  outer,    // holds the body: no contact is missed
  inner,    // inside the body: no contact is made up
  nearest,  // neither: the outer one (icosphere: the inner one) scaled to the body's volume
};

struct Representation {
  Form form = Form::as_given;
  Side side = Side::outer;  // means nothing to as_given and mesh, which have no other
  int detail = 0;

  friend bool operator==(const Representation&, const Representation&) = default;
};

// "sphere", "hull-16 inner", "icosphere-2 nearest"; outer is not said.
std::string to_string(const Representation& representation);
// Its inverse. Throws InputError with what was expected.
Representation parse_representation(std::string_view text);

// A convex piece of what stands for a body.
struct Part {
  Shape shape;
  Pose pose;  // in the body's frame
};

// What stands for a body of this shape (and of this mesh, where it has one: then the shape is the
// mesh's convex hull). At least one part. Outer and inner ones are proven to be so in spite of
// rounding; how good each is, is said in outer_fits.h, inner_fits.h, mesh_inside.h and
// decomposition.h. A mesh's solid is that of mesh_solid.h. Throws InputError where there is no such
// representation: an inner one of a flat body or of a mesh that is not closed, a nearest one of a
// flat body or of several parts, anything but as_given of a half-space, a mesh of a body without
// one, another side of as_given and mesh.
std::vector<Part> represent(const Shape& shape, const Mesh* mesh,
                            const Representation& representation);

// How far a representation is from the body, both as solids (the union of the parts).
struct RepresentationError {
  double added = 0;      // volume outside the body, as a part of the body's volume
  double lost = 0;       // volume of the body that it leaves out, the same
  double hausdorff = 0;  // metres: greatest distance of a point of either surface from the other
  double size = 0;       // metres: diameter of the body's bounding ball
  // Standard error of the volumes, as a part of the body's. 0: exact to rounding, as it is where
  // one of two convex solids holds the other and where both are polytopes. Else the volumes are
  // integrals of exact lengths along 8 times 4,096 parallel lines, and this is what the eight
  // differ by. Infinite where the body has no volume but the parts have; then `added` is so too.
  double volume_deviation = 0;
  // Metres: the Hausdorff distance may be greater or less by so much. 0: exact to rounding, as it
  // is between convex polytopes, balls and capsules. Round rims: 2e-5 of the radius; ellipsoids:
  // 1e-3. Of meshes and unions it is the greatest distance between neighbours of the points that
  // stand for the surfaces.
  double hausdorff_deviation = 0;
  double volume_error() const { return added + lost; }
};
RepresentationError representation_error(const Shape& shape, const Mesh* mesh,
                                         const std::vector<Part>& parts);

}  // namespace touchstone
