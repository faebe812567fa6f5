// Small meshes that algorithms find hard. Unless said, coordinates are multiples of 2^-10, so that sums,
// differences and halves of them are exact.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/vec.h"

namespace touchstone::families {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

inline double on_grid(double x) { return std::round(x * 1024) / 1024; }
inline Vec3d on_grid(const Vec3d& v) { return {on_grid(v[0]), on_grid(v[1]), on_grid(v[2])}; }

// A closed ellipsoid; at its two poles `around` triangles meet.
TriangleMesh ellipsoid_mesh(const Vec3d& radii, std::uint32_t around, std::uint32_t rings);

// An open grid of side * side squares of size 1, with heights up to `height`.
TriangleMesh terrain_mesh(std::uint32_t side, double height, std::uint64_t seed);

// Triangles without order, some of them degenerate or there twice.
TriangleMesh soup_mesh(int count, std::uint64_t seed);

void add(TriangleMesh& mesh, const TriangleMesh& other, double scale, const Vec3d& by);

TriangleMesh moved(const TriangleMesh& mesh, double scale, const Vec3d& by);

// The meshes of the families, small enough for the oracle.
std::vector<NamedMesh> ray_meshes();

// A closed torus about z, of 2 around * across triangles. Its surface looks outward.
TriangleMesh torus(int around, int across, double radius, double tube, bool solid = false);

// The twelve triangles of a box about the origin, outward.
TriangleMesh box_mesh(double x, double y, double z, bool solid = false);

// Closed ones, for which a point has a side: none, balls, one with a cavity and a piece that pokes out, and one
// whose vertices are no floats.
std::vector<NamedMesh> closed_meshes();

}  // namespace touchstone::families
