// Shapes of bodies that are not convex, with the hull that stands for them, and meshes that a scene
// describes without a file of triangles.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/shape.h"
#include "harness/files/toml_table.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/geometry/mesh.h"

namespace touchstone::scene {

using geometry::MeshUse;

struct ConcaveShape {
  Shape hull;
  std::shared_ptr<const geometry::Mesh> mesh;
  std::shared_ptr<const ConcaveBody> body;  // null: the hull is the body
};

ConcaveShape mesh_shape(geometry::Mesh mesh, MeshUse use);
// `body` is a compound.
ConcaveShape compound_shape(ConcaveBody body);

// The tight box of a body that has triangles or parts, rounded outward.
Aabb concave_box(const ConcaveBody& body, const Shape& hull, const Pose& pose);
// As loose_reach.
double concave_reach(const ConcaveBody& body, const Shape& hull, const Mat3d& rotation);

inline constexpr std::array<std::string_view, 5> made_names = {"torus", "trefoil", "gear",
                                                               "terrain", "height_field"};

// Returns the file that a key names, which exists; `expected` is for the message if it does not.
using FindFile =
    std::function<std::filesystem::path(std::string_view key, std::string_view expected)>;

// Makes the mesh of one of these names, before its scale, and the keys known to the table.
geometry::Mesh made_mesh(files::TomlTable& table, std::string_view type, const FindFile& file);

}  // namespace touchstone::scene
