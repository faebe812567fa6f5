// The planes of a polytope's faces, looked at together: the nearest one, those that a point sees,
// and those of new faces. At each level of vector instructions the results are the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone::face_planes {

// The planes of sixteen faces, outward. Where there is no face, distance and key are infinite.
template <class Scalar>
struct Block {
  static constexpr std::size_t size = 16;
  alignas(64) Scalar x[size], y[size], z[size];
  Scalar distance[size];  // from the origin
  Scalar key[size];       // the distance that the face is chosen by; infinite: set aside
  bool measured[size];    // it is that of the triangle, not only of its plane

  Vec3<Scalar> normal(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// A word has a bit for each of so many faces.
inline constexpr std::size_t faces_a_word = 64;

// The first of the faces with the least key.
template <class Scalar>
int least_key(std::span<const Block<Scalar>> blocks);

// Bits of the faces whose plane is further than `above` below the point, in one word after the
// other.
template <class Scalar>
void seen_from(std::span<const Block<Scalar>> blocks, const Vec3<Scalar>& point, Scalar above,
               std::uint64_t* seen);

// The triangles from a tip to the edges of a ring, which is places of points: each vertex, the
// first again, and up to `overhang` more, of any points, to fill up a vector.
template <class Scalar>
struct Cone {
  const DifferencePoint<Scalar>* points;
  const int* ring;
  std::size_t size;
  const Vec3<Scalar>& tip;
};
inline constexpr std::size_t overhang = 16;

// Their planes, in columns that are longer by the overhang.
template <class Scalar>
struct ConePlanes {
  explicit ConePlanes(std::size_t most);

  std::vector<Scalar> x, y, z, distance;  // the distance of a flat triangle is NaN
  std::vector<Scalar> key;  // the distance, infinite where it exceeds what is asked for
  // Positive where the plane is so certain that, were the face the nearest to the origin, the
  // origin's projection would be in the triangle.
  std::vector<Scalar> margin;
};

// triangle_plane of simplex.h for the triangles of a cone. Whether all planes are more than
// `inside` away from the origin.
template <class Scalar>
bool planes_through(const Cone<Scalar>& cone, Scalar inside, Scalar furthest,
                    ConePlanes<Scalar>& planes);

}  // namespace touchstone::face_planes
