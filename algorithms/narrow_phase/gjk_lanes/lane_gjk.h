// GJK's walk between small bodies, and EPA where it ends around the origin, one pair a lane of
// vectors; a lane whose pair is answered takes the next one of the batch.
// Paper: Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
// objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988. Where the
// nearest feature of a simplex is: Ericson, "Real-Time Collision Detection", 2005, section 9.5.
//
// Spheres, capsules, boxes, and hulls whose vertices are all looked at; matrices whose greatest
// entry is about that of a rotation. Hulls of at most `most_turned_vertices` are turned into their
// lane, and every lane looks at the next vertex of its own; greater ones are scanned one lane after
// the other, sixteen vertices at a time, which waits for nothing either, and then all lanes take
// the step together. What the lanes answer is proven by the same bounds as in simplex_walk.h: a
// support plane, a tetrahedron around the origin, a point of the difference that is nearer than the
// radii; distances between both. Depths are between those of expanding_polytope.h. All else is
// handed back for a walk that takes its time. The same bits at every level of vector instructions,
// in any batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/batch/body_pairs.h"
#include "algorithms/kernels/minkowski/support_shape.h"
#include "algorithms/kernels/simd/real_lanes.h"

namespace touchstone {

inline constexpr std::uint32_t most_turned_vertices = hull_scan::VertexBlock<float>::size;

// What the lanes need of a shape.
template <class Scalar>
struct LaneShape {
  // SupportShape's unit and radius, and how far a rotated body reaches: metres; and nothing.
  alignas(32) double numbers[4];
  alignas(32) Scalar extents[4];  // capsule, box: of the core, in its unit; and nothing
  alignas(32) double centre[3];   // as SupportShape's
  std::uint32_t block_count;      // hull
  bool fits;                      // the lanes take it
  bool scans;                     // ... as a hull of more vertices than are turned
  const hull_scan::VertexBlock<Scalar>* vertices;  // hull: so many blocks
};

// Where a walk has ended around the origin: corners of the difference, and on the core of a.
template <class Scalar>
struct alignas(sizeof(real_lanes::Quad<Scalar>)) DepthStart {
  real_lanes::Quad<Scalar> points[4], on_a[4];
  std::uint32_t place;  // of the pair
  std::int32_t iterations;
};
template <class Scalar>
struct DepthStarts {
  std::vector<DepthStart<Scalar>> all;
  std::size_t count = 0;  // that are there
};

template <class Scalar>
class GjkLanes {
 public:
  // The second are made of the first, and are to stay where they are.
  void bind(std::span<const Shape> shapes, std::span<const SupportShape<Scalar>> support_shapes);

  static bool takes(ShapeKind kind) { return kind <= ShapeKind::box || kind == ShapeKind::hull; }

  struct Goal {
    Task task = Task::intersect;
    Scalar tolerance = 0;  // of distance and depth, in the unit of SupportPair
    int most_iterations = 0, most_expansions = 0;
  };
  // Of kinds that it takes. Answers into outcomes, all but the pairs whose places are written to
  // `left`, which has room for all of them; how many those are.
  std::size_t solve(ShapeKind kind_a, ShapeKind kind_b, const BodyPairs& pairs, const Goal& asked,
                    std::span<Outcome> outcomes, std::uint32_t* left);

 private:
  std::vector<LaneShape<Scalar>> shapes_;
  const hull_scan::VertexBlock<Scalar>* some_vertices_ = nullptr;  // of a hull that fits
  std::uint32_t most_vertices_ = 0;                                // of those that are turned
  bool all_fit_ = true;
  bool some_scan_ = false;
  bool centred_ = true;  // the centres of all that fit are the origins of their bodies
  std::vector<std::uint32_t> places_;  // 0, 1, 2...
  // Scratch: the places of pairs that fit, without such as scan, and with.
  std::vector<std::uint32_t> turned_, scanned_;
  DepthStarts<Scalar> starts_;  // scratch
};

extern template class GjkLanes<float>;
extern template class GjkLanes<double>;

}  // namespace touchstone
