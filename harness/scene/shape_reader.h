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

namespace touchstone {

// A shape, and how it is turned within its body: capsules, cylinders and cones along x or y. The
// turn is a permutation of the axes, so that it is exact.
struct TurnedShape {
  Shape shape;
  Mat3d turn = Mat3d::Identity();
  std::shared_ptr<const Mesh> mesh = nullptr;  // of which the shape is the convex hull
};

// The names of all shapes that a file can give: all_shape_kinds in order.
std::span<const std::string_view> shape_names();

// A part of a mesh as its convex hull about the centre of the part's box.
struct MeshPart {
  Shape shape;
  std::shared_ptr<const Mesh> mesh;  // of the part, about the same centre
  Vec3d centre;                      // in the mesh's frame, scaled
};

class ShapeReader {
 public:
  // Mesh files are named relative to `folder`. `get` says how to have them; it is told where one is
  // missing.
  explicit ShapeReader(std::filesystem::path folder, std::string get = "")
      : folder_(std::move(folder)), get_(std::move(get)) {}

  // `type` with its sizes, in the words of the case format, or `mesh` with an optional `scale` (a
  // number, or one for each axis): the mesh's convex hull. Makes the keys known to the table;
  // the caller calls finish.
  TurnedShape read(TomlTable& table);
  // `mesh` and `scale` again, but each connected part of the mesh as a hull of its own.
  const std::vector<MeshPart>& read_parts(TomlTable& table);

  // The file that the key names, which must be there.
  std::filesystem::path existing_file(TomlTable& table, std::string_view key,
                                      std::string_view expected) const;

 private:
  using MeshAndScale = std::tuple<std::string, double, double, double>;

  TurnedShape read_mesh_hull(TomlTable& table);
  MeshAndScale mesh_and_scale(TomlTable& table) const;

  std::filesystem::path folder_;
  std::string get_;
  // Each mesh and scale is read once and shared.
  std::map<MeshAndScale, TurnedShape> hulls_;
  std::map<MeshAndScale, std::vector<MeshPart>> parts_;
};

}  // namespace touchstone
