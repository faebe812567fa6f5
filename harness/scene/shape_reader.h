// Shapes in scene files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tuple>

#include "algorithms/core/shape.h"
#include "harness/scene/toml_table.h"

namespace touchstone {

// A shape, and how it is turned within its body: capsules, cylinders and cones along x or y. The
// turn is a permutation of the axes, so that it is exact.
struct TurnedShape {
  Shape shape;
  Mat3d turn = Mat3d::Identity();
};

// The names of all shapes that a file can give: all_shape_kinds in order.
std::span<const std::string_view> shape_names();

class ShapeReader {
 public:
  // Mesh files are named relative to `folder`.
  explicit ShapeReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // `type` with its sizes, in the words of the case format, or `mesh` with an optional `scale` (a
  // number, or one for each axis): the mesh's convex hull. Makes the keys known to the table;
  // the caller calls finish.
  TurnedShape read(TomlTable& table);

 private:
  TurnedShape read_mesh_hull(TomlTable& table);

  std::filesystem::path folder_;
  // Each mesh and scale is read once and shared.
  std::map<std::tuple<std::string, double, double, double>, std::shared_ptr<const Hull>> hulls_;
};

}  // namespace touchstone
