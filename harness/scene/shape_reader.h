// Shapes in scene files.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/core/shape.h"
#include "harness/files/toml_table.h"
#include "harness/geometry/mesh.h"
#include "harness/scene/concave_shape.h"

namespace touchstone::scene {

// A shape with its rotation within its body, for capsules, cylinders and cones along x or y. The
// rotation is a permutation of the axes and therefore exact.
struct TurnedShape {
  Shape shape;
  Mat3d turn = Mat3d::Identity();
  std::shared_ptr<const geometry::Mesh> mesh = nullptr;  // the shape is this mesh's convex hull
  std::shared_ptr<const ConcaveBody> body = nullptr;     // the shape is this body's convex hull
};

// The names of all convex shapes in a file: all_shape_kinds in order.
std::span<const std::string_view> shape_names();

// Whether it is the name of a shape that is not convex: a compound, or one of the meshes that need no
// file.
bool is_concave_name(std::string_view type);

// A part of a mesh, relative to the centre of the part's box.
struct MeshPart {
  ConcaveShape shape;
  Vec3d centre;  // in the mesh's frame, scaled
};

// What the meshes of a file are, if it says so, and what another file that imports it says instead.
struct MeshUses {
  std::optional<MeshUse> own = {}, instead = {};
};
MeshUses read_mesh_uses(files::TomlTable& table, std::optional<MeshUse> instead);

class ShapeReader {
 public:
  // Mesh files are relative to `folder`. `get` describes how to get them; it is printed if one
  // is missing.
  explicit ShapeReader(std::filesystem::path folder, std::string get = "", MeshUses uses = {})
      : folder_(std::move(folder)), get_(std::move(get)), uses_(uses) {}

  // Reads `type` with its sizes, named as in the case format, or `mesh`. A mesh, from a file or of
  // the types torus, trefoil, gear, terrain and height_field, has an optional `scale` (one number, or
  // one for each axis) and `as`, what it is (MeshUse). A compound has `parts`, each with `shape` and
  // its place; of a mesh among them each triangle is a part. Makes the keys known to the table; the
  // caller calls finish.
  TurnedShape read(files::TomlTable& table);
  // Reads `mesh`, `scale` and `as` as above, with each connected part of the mesh as its own body.
  const std::vector<MeshPart>& read_parts(files::TomlTable& table);
  // What the table's mesh is.
  MeshUse use_of(files::TomlTable& table, MeshUse fallback = MeshUse::surface) const;

  // The files of meshes and height fields that were read.
  std::vector<std::filesystem::path> files() const;

  // The file named by the key, or by one of its texts; it must exist.
  std::filesystem::path existing_file(files::TomlTable& table, std::string_view key,
                                      const std::string& name, std::string_view expected) const;
  std::filesystem::path existing_file(files::TomlTable& table, std::string_view key,
                                      std::string_view expected) const;

 private:
  using MeshKey = std::tuple<std::string, double, double, double, MeshUse>;

  TurnedShape read_mesh(files::TomlTable& table);
  TurnedShape read_made(files::TomlTable& table, std::string_view type);
  TurnedShape read_compound(files::TomlTable& table);
  void add_parts(files::TomlTable& table, std::vector<Pose>& around, ConcaveBody& compound);
  MeshKey mesh_key(files::TomlTable& table) const;

  std::filesystem::path folder_;
  std::string get_;
  MeshUses uses_;
  // Each mesh, scale and use is read once and shared.
  std::map<MeshKey, ConcaveShape> meshes_;
  std::map<MeshKey, std::vector<MeshPart>> parts_;
  std::vector<std::filesystem::path> height_files_;
};

}  // namespace touchstone::scene
