// Part of gjk-lanes: GJK between small bodies, and EPA if it ends around the origin, one pair per
// lane of vectors. A lane whose pair is answered takes the next pair of the batch.
//
// It takes all bounded shapes but hulls with a support cube map, with matrices whose greatest entry
// is about that of a rotation. Hulls of at most `most_turned_vertices` vertices are rotated into
// their lane, and every lane tests the next vertex of its own hull. Larger hulls are scanned one
// lane after the other, sixteen vertices at a time; then all lanes step together. Round cores
// are an image of the unit ball, cylinder or cone, and their axes are rotated like a box's.
// Answers are proven by the bounds of gjk_iteration.h: a support plane, a tetrahedron around the
// origin, or a point of the difference nearer than the radii. Distances lie between the first and
// the last, depths between the bounds of expanding_polytope.h. All other pairs are returned for a
// serial query. Results have the same bits at every level of vector instructions and in any batch.
// Includes core and kernels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"
#include "algorithms/kernels/minkowski/support_shape.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {

inline constexpr std::uint32_t most_turned_vertices = hull_scan::VertexBlock<float>::size;

// The data of a shape that the lanes need.
template <class Scalar>
struct LaneShape {
  // {unit, radius, bounding radius, unused}, in metres.
  alignas(32) double numbers[4];
  alignas(32) Scalar extents[4];  // extents of the core in its unit, and one unused
  alignas(32) double centre[3];   // like SupportShape's
  std::uint32_t block_count;      // hull
  bool fits;                      // the lanes take it
  bool scans;                     // the lanes take it as a hull that is scanned
  const hull_scan::VertexBlock<Scalar>* vertices;  // hull: block_count blocks
  const hull_scan::VertexBlock<float>* rough;      // as in ScannedHull

  hull_scan::ScannedHull<Scalar> scanned_hull() const { return {{vertices, block_count}, rough}; }
};

// The tetrahedron of a GJK search that ended around the origin: points of the difference, and on
// the core of a.
template <class Scalar>
struct alignas(sizeof(simd::Quad<Scalar>)) DepthStart {
  simd::Quad<Scalar> points[4], on_a[4];
  std::uint32_t place;  // of the pair in the batch
  std::int32_t iterations;
};
template <class Scalar>
struct DepthStarts {
  std::vector<DepthStart<Scalar>> all;
  std::size_t count = 0;  // number of valid entries
};

// A plane that parts the pair at a place.
struct LanePlane {
  std::uint32_t place;
  Vec3d normal;  // from a to b in the world: of about unit length
  double gap;    // metres; a lower bound on the distance of the bodies along it
};

template <class Scalar>
class GjkLanes {
 public:
  // `support_shapes` are made from `shapes`. Both must outlive this object's use.
  void bind(std::span<const Shape> shapes, std::span<const SupportShape<Scalar>> support_shapes);

  static bool takes(ShapeKind kind) { return kind != ShapeKind::halfspace; }
  // Cylinders, cones and ellipsoids.
  static bool is_curved(ShapeKind kind) {
    return kind >= ShapeKind::cylinder && kind <= ShapeKind::ellipsoid;
  }

  struct Goal {
    Task task = Task::intersect;
    Scalar tolerance = 0;  // of distance and depth, in the unit of SupportPair
    int most_iterations = 0, most_expansions = 0;
    // Unless null, by place: the direction from a to b in which the search begins, or zero to begin
    // at the centres. Its length is 1/2 to 3.
    const std::array<float, 4>* directions = nullptr;
    // Unless null, the planes that parted pairs in an iteration are appended.
    std::vector<LanePlane>* planes = nullptr;
  };
  // Solves the pairs at these places, which are of kinds that it takes. Writes outcomes, except for
  // the pairs whose places it writes to `left`, which must have room for all and must not overlap
  // `places`. Returns the number of those.
  std::size_t solve(ShapeKind kind_a, ShapeKind kind_b, const BodyPairs& pairs, const Goal& asked,
                    std::span<const std::uint32_t> places, std::span<Outcome> outcomes,
                    std::uint32_t* left);

 private:
  std::vector<LaneShape<Scalar>> shapes_;
  const hull_scan::VertexBlock<Scalar>* some_vertices_ = nullptr;  // of a hull that fits
  std::uint32_t most_vertices_ = 0;                                // of hulls that are rotated
  bool all_fit_ = true;
  bool some_scan_ = false;
  bool centred_ = true;  // the centres of all shapes that fit are the origins of their bodies
  // Scratch: the places of pairs that fit, without and with scanned hulls.
  std::vector<std::uint32_t> turned_, scanned_;
  DepthStarts<Scalar> starts_;  // scratch
};

extern template class GjkLanes<float>;
extern template class GjkLanes<double>;

}  // namespace touchstone
