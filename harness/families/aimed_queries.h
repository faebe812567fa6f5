// Rays and points that are aimed at what triangles share, along it, off it, and from it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/ray_cast.h"
#include "harness/families/draws.h"

namespace touchstone::families {

enum class RayAim : std::uint8_t {
  vertex,        // at a vertex, from around
  edge,          // at the middle of an edge
  face,          // at a point of a face
  to_the_end,    // at one of these, with t_max at the hit or just before it
  from_surface,  // from one of these
  far,           // at one of these, from a million metres
  axis,          // at one of these along an axis, with zeros of either sign
  axis_plane,    // at one of these along a plane of two axes
  along_edge,    // along an edge, from before, after or inside of it
  in_plane,      // in the plane of a face, along no edge
  random,        // in any direction, half of them at a point near a vertex
};
inline constexpr std::array all_ray_aims = {
    RayAim::vertex,       RayAim::edge,     RayAim::face,  RayAim::to_the_end,
    RayAim::from_surface, RayAim::far,      RayAim::axis,  RayAim::axis_plane,
    RayAim::along_edge,   RayAim::in_plane, RayAim::random};

std::string_view to_string(RayAim aim);

// A ray at the triangle of the mesh, whose coordinates are exact in the sums and halves that it
// takes if they are on the grid of meshes.h. The direction is not zero. A mesh without triangles
// has random rays alone.
Ray aimed_ray(RayAim aim, const TriangleMesh& mesh, std::size_t triangle, Draws& draws);

// A ray at a vertex, an edge or a face from so far away (metres).
Ray ray_from(double distance, const TriangleMesh& mesh, std::size_t triangle, Draws& draws);

// Rays of every aim at this share of the mesh's triangles.
std::vector<Ray> aimed_rays(const TriangleMesh& mesh, double share, std::uint64_t seed);
// Random rays.
std::vector<Ray> random_rays(const TriangleMesh& mesh, int count, std::uint64_t seed);
// Rays in sixteens that go the same way: from one point, or beside each other, at vertices, edges and
// faces of triangles that are numbered one after the other, and past them.
std::vector<Ray> rays_in_sixteens(const TriangleMesh& mesh, int count, std::uint64_t seed);

enum class PointPlace : std::uint8_t {
  on_surface,  // a vertex, the middle of an edge or a point of a face, exact on the grid of meshes.h
  off_1e_3,    // so far from one of these (metres), as the next four
  off_1e_5,
  off_1e_7,
  off_1e_11,
  off_1e_15,
  in_line,       // with one or two coordinates of one of these
  from_corners,  // with a coordinate of each of a triangle's corners
  around,
  far,  // a million metres away
};
inline constexpr std::array all_point_places = {
    PointPlace::on_surface, PointPlace::off_1e_3,  PointPlace::off_1e_5, PointPlace::off_1e_7,
    PointPlace::off_1e_11,  PointPlace::off_1e_15, PointPlace::in_line,  PointPlace::from_corners,
    PointPlace::around,     PointPlace::far};

std::string_view to_string(PointPlace place);

Vec3d tried_point(PointPlace place, const TriangleMesh& mesh, std::size_t triangle, Draws& draws);

// A point so far from a vertex, an edge or a face (metres).
Vec3d point_off(double distance, const TriangleMesh& mesh, std::size_t triangle, Draws& draws);

// Points of every place at this share of the mesh's triangles, and the origin.
std::vector<Vec3d> tried_points(const TriangleMesh& mesh, double share, std::uint64_t seed);

}  // namespace touchstone::families
