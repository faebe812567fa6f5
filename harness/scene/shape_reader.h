// Shapes in scene files.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/core/shape.h"
#include "harness/files/toml_table.h"
#include "harness/geometry/mesh.h"

namespace touchstone::scene {

// A shape with its rotation within its body, for capsules, cylinders and cones along x or y. The
// rotation is a permutation of the axes and therefore exact.
struct TurnedShape {
  Shape shape;
  Mat3d turn = Mat3d::Identity();
  std::shared_ptr<const geometry::Mesh> mesh = nullptr;  // the shape is this mesh's convex hull
};

// The names of all shapes in a file: all_shape_kinds in order.
std::span<const std::string_view> shape_names();

// A part of a mesh as its convex hull, relative to the centre of the part's box.
struct MeshPart {
  Shape shape;
  std::shared_ptr<const geometry::Mesh> mesh;  // of the part, relative to the same centre
  Vec3d centre;                                // in the mesh's frame, scaled
};

class ShapeReader {
 public:
  // Mesh files are relative to `folder`. `get` describes how to get them; it is printed if one
  // is missing.
  explicit ShapeReader(std::filesystem::path folder, std::string get = "")
      : folder_(std::move(folder)), get_(std::move(get)) {}

  // Reads `type` with its sizes, named as in the case format, or `mesh` with an optional `scale`
  // (one number, or one for each axis): the mesh's convex hull. Makes the keys known to the table;
  // the caller calls finish.
  TurnedShape read(files::TomlTable& table);
  // Reads `mesh` and `scale` as above, with each connected part of the mesh as its own hull.
  const std::vector<MeshPart>& read_parts(files::TomlTable& table);

  // The file named by the key; it must exist.
  std::filesystem::path existing_file(files::TomlTable& table, std::string_view key,
                                      std::string_view expected) const;

 private:
  using MeshAndScale = std::tuple<std::string, double, double, double>;

  TurnedShape read_mesh_hull(files::TomlTable& table);
  MeshAndScale mesh_and_scale(files::TomlTable& table) const;

  std::filesystem::path folder_;
  std::string get_;
  // Each mesh and scale is read once and shared.
  std::map<MeshAndScale, TurnedShape> hulls_;
  std::map<MeshAndScale, std::vector<MeshPart>> parts_;
};

}  // namespace touchstone::scene
