// What stands for a body: from a sphere around it to its own mesh, outside or inside of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/scene/mesh.h"

namespace touchstone {

enum class Form : std::uint8_t {
  as_given,      // the shape that the scene gives
  sphere,        // least enclosing ball; inner: greatest that was found inside
  box,           // along the body's own axes
  oriented_box,  // turned to fit
  dop14,         // k-DOP: slabs along the axes and the cube's corners (14), edges (18), both (26)
  dop18,
  dop26,
  capsule,       // fitted
  reduced_hull,  // a hull of at most `detail` vertices
  hull,          // the convex hull of all vertices
  parts,         // a decomposition into convex parts, at most `detail` (0: as many as needed)
  mesh,          // each triangle, for a body that has a mesh
  icosphere,     // round shapes as polytopes of level `detail`, 0 to 5; others as given
};

enum class Side : std::uint8_t {
  outer,    // holds the body: no contact is missed
  inner,    // inside the body: no contact is made up
  nearest,  // neither: what fits best
};

struct Representation {
  Form form = Form::as_given;
  Side side = Side::outer;
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
// mesh's convex hull). At least one part. Throws InputError where there is no such representation:
// an inner one of a flat body, anything but as_given of a half-space, a mesh of a body without one.
std::vector<Part> represent(const Shape& shape, const Mesh* mesh,
                            const Representation& representation);

// How far a representation is from the body, both as solids.
struct RepresentationError {
  double added = 0;      // volume outside the body, as a part of the body's volume
  double lost = 0;       // volume of the body that it leaves out, the same
  double hausdorff = 0;  // metres: greatest distance of a point of either surface from the other
  double size = 0;       // metres: diameter of the body's bounding ball
  double volume_error() const { return added + lost; }
};
RepresentationError representation_error(const Shape& shape, const Mesh* mesh,
                                         const std::vector<Part>& parts);

}  // namespace touchstone
