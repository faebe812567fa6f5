// Meshes that a scene describes without a file of triangles.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string_view>

#include "harness/files/toml_table.h"
#include "harness/geometry/mesh.h"

namespace touchstone::scene {

inline constexpr std::array<std::string_view, 5> made_names = {"torus", "trefoil", "gear",
                                                               "terrain", "height_field"};

// Returns the file that a key names, which exists; `expected` is for the message if it does not.
using FindFile =
    std::function<std::filesystem::path(std::string_view key, std::string_view expected)>;

// Makes the mesh of one of these names, before its scale, and the keys known to the table.
geometry::Mesh made_mesh(files::TomlTable& table, std::string_view type, const FindFile& file);

}  // namespace touchstone::scene
