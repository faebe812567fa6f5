// Collision proxies of a body: from a sphere around it to its own mesh, outside or inside it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"

namespace touchstone::proxies {

enum class Form : std::uint8_t {
  as_given,      // the scene's shape
  sphere,        // least enclosing ball; inner: the greatest inside, found by search for a mesh
  box,           // along the body's own axes
  oriented_box,  // along fitted axes
  dop14,         // k-DOP: slabs along the axes and the cube's corners (14), edges (18), both (26)
  dop18,
  dop26,
  capsule,       // fitted
  reduced_hull,  // a hull of at most `detail` vertices, at least 8
  hull,          // the convex hull of all vertices; a convex shape itself
  parts,         // a decomposition into at most `detail` convex parts (0: as many as worthwhile)
  mesh,          // every triangle of a mesh body: its surface, with nothing inside
  icosphere,     // round shapes as polytopes of level `detail`, 0 to 5; other shapes unchanged
};

enum class Side : std::uint8_t {
  outer,    // contains the body: no contact is missed
  inner,    // is inside the body: no contact is invented
  nearest,  // the outer one (icosphere: the inner one) scaled to the body's volume
};

struct Representation {
  Form form = Form::as_given;
  Side side = Side::outer;  // unused for as_given and mesh
  int detail = 0;

  friend bool operator==(const Representation&, const Representation&) = default;
};

// Names such as "sphere", "hull-16 inner", "icosphere-2 nearest"; "outer" is not printed.
std::string to_string(const Representation& representation);
// The inverse of to_string. Throws InputError with the expected values.
Representation parse_representation(std::string_view text);

// A convex piece of a body's proxy.
struct Part {
  Shape shape;
  Pose pose;  // in the body's frame
};

// Returns the proxy of a body with this shape, and with this mesh if it has one; the shape is then
// the mesh's convex hull. It has at least one part. Outer and inner proxies are proven in spite of
// rounding; their quality is described in fits.h and
// decomposition.h. A mesh's solid is that of mesh_solid.h. Throws InputError if there is no such
// proxy: an inner one of a flat body or of an open mesh, a nearest one of a flat body or of several
// parts, any but as_given of a half-space, a mesh of a body without one, and another side of
// as_given and mesh.
std::vector<Part> represent(const Shape& shape, const geometry::Mesh* mesh,
                            const Representation& representation);

// The difference between a proxy and the body, both as solids (the union of the parts).
struct RepresentationError {
  double added = 0;      // volume outside the body, relative to the body's volume
  double lost = 0;       // volume of the body outside the proxy, relative to the body's volume
  double hausdorff = 0;  // metres: greatest distance of a point of either surface from the other
  double size = 0;       // metres: diameter of the body's bounding ball
  // Standard error of added + lost, relative to the body's volume. 0: exact to rounding, which holds
  // between convex polytopes, and if one of two solids contains the other and their volumes are
  // known: those of convex solids, of unions without overlap, and of meshes whose pieces do not
  // overlap. Otherwise what is common is integrated along 8 times 4,096 parallel lines, and the
  // error follows from the differences of the eight. Infinite if the body has no volume but the parts have; `added` is
  // then infinite too.
  double volume_deviation = 0;
  // Error of the Hausdorff distance in metres, in both directions. 0: exact to rounding, which
  // holds between convex polytopes, balls and capsules. Round rims: 2e-5 of the radius; ellipsoids:
  // 1e-3. For meshes and unions it is the greatest distance between neighbouring sample points of
  // the surfaces.
  double hausdorff_deviation = 0;
  double volume_error() const { return added + lost; }
};
RepresentationError representation_error(const Shape& shape, const geometry::Mesh* mesh,
                                         const std::vector<Part>& parts);

}  // namespace touchstone::proxies
