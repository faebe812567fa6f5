// Loops over the planes of EPA's faces, many at once: the nearest plane, the planes below a point,
// and the planes of new faces. Used by epa_hull.h alone. Results are equal at every level of vector
// instructions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone::face_planes {

// Outward planes of sixteen faces. An empty place has infinite distance and key.
template <class Scalar>
struct Block {
  static constexpr std::size_t size = 16;
  alignas(64) Scalar x[size], y[size], z[size];
  Scalar distance[size];  // from the origin
  Scalar key[size];       // the distance used to choose a face; infinite: set aside
  bool measured[size];    // the key is the distance of the triangle instead of its plane

  Vec3<Scalar> normal(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// Number of faces that have their bits in one word.
inline constexpr std::size_t faces_a_word = 64;

// Returns the first face with the least key.
template <class Scalar>
int least_key(std::span<const Block<Scalar>> blocks);

// Sets the bits of the faces whose plane is more than `above` below the point, 64 faces a word.
template <class Scalar>
void seen_from(std::span<const Block<Scalar>> blocks, const Vec3<Scalar>& point, Scalar above,
               std::uint64_t* seen);

// The triangles from a tip to the edges of a ring. `ring` holds indices of points: `size` vertices,
// the first one again, and up to `overhang` more valid indices that fill the last vector.
template <class Scalar>
struct Cone {
  const DifferencePoint<Scalar>* points;
  const int* ring;
  std::size_t size;
  const Vec3<Scalar>& tip;
};
inline constexpr std::size_t overhang = 16;

// Planes of the cone's triangles, in columns with `overhang` extra elements.
template <class Scalar>
struct ConePlanes {
  explicit ConePlanes(std::size_t most);

  std::vector<Scalar> x, y, z, distance;  // the distance of a flat triangle is NaN
  std::vector<Scalar> key;                // the distance; infinite if it exceeds `furthest`
  // Positive if the plane is certain enough that, if the face is nearest to the origin, the
  // origin's projection lies in the triangle.
  std::vector<Scalar> margin;
};

// Applies triangle_plane of simplex.h to the triangles of a cone. Returns true if all planes are
// farther than `inside` from the origin.
template <class Scalar>
bool planes_through(const Cone<Scalar>& cone, Scalar inside, Scalar furthest,
                    ConePlanes<Scalar>& planes);

}  // namespace touchstone::face_planes
