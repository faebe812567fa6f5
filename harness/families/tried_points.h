// Points at, off and in line with what triangles share.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "harness/families/draws.h"

namespace touchstone::families {

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
