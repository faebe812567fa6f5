// Models in the formats of other programs: glTF, COLLADA, FBX and 3DS, as Assimp reads them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone::models {

struct ModelMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // polygons are split
};

// x becomes linear * x + translation.
struct Affine {
  Mat3d linear = Mat3d::Identity();
  Vec3d translation = Vec3d::Zero();
};

struct ModelNode {
  std::string name;  // as the file has it; may be empty, or no UTF-8
  Affine to_file;    // from its frame to the root frame of the file, in the file's units
  std::vector<std::uint32_t> meshes;
};

// How many of each the file has that no body is made of.
struct LeftOut {
  std::uint64_t lines = 0, points = 0, animations = 0, cameras = 0, lights = 0;
  std::uint64_t morph_targets = 0;  // shapes into which a mesh may change; the mesh itself is read
  // Words such as "2 lines, 1 animation"; empty if nothing was left out.
  std::string words() const;
};

struct Model {
  std::vector<ModelMesh>
      meshes;  // in the frames of their nodes, in the file's units; may be without triangles
  std::vector<ModelNode> nodes;  // parents first
  double metres = 1;             // a unit of length of the file
  Mat3d z_up =
      Mat3d::Identity();  // turns the file's axes to those with z up: a permutation with signs
  LeftOut left_out;
  std::uint64_t skinned = 0;          // meshes that bones bend; they are as they are without bones
  std::vector<std::string> warnings;  // what Assimp says of parts that it does not find

  // The axis of the file that points up: "x", "y" or "z", with "-" before it if that end of it does.
  std::string up() const;
};

// The files' endings, in small letters.
inline constexpr std::array<std::string_view, 5> model_endings = {".glb", ".gltf", ".dae", ".fbx",
                                                                  ".3ds"};
bool is_model_file(const std::filesystem::path& file);

// The process that reads a model.
struct ModelProcess {
  std::filesystem::path program;  // empty: touchstone_read_model of this build or installation
  double seconds = 60;            // wall clock, after which it is killed
  std::size_t memory = std::size_t{4} << 30;  // bytes that it may take, and that it may answer
};

// Reads a file with one of these endings. Warns of skinned meshes, which are read in their bind pose, and of parts that the file names and does not have. Throws
// InputError with the file: if Assimp cannot read it, crashes, takes more than the limits, or answers what is no
// model (indices out of range, numbers that are not finite); if it has no triangles; and where this build has no
// Assimp.
Model read_model(const std::filesystem::path& file, const ModelProcess& process = {});

// Reads what touchstone_read_model writes. Throws InputError with `file`.
Model parse_model(const std::string& file, std::string_view stream);

// Puts meshes together. Corners of equal coordinates become one vertex, and vertices that no triangle has are left
// out.
class Joiner {
 public:
  // Adds the triangles of a mesh at a place. A mirror turns them, so that they face the same side.
  void add(const ModelMesh& mesh, const Affine& place);
  // What was added since the beginning, or since the last time.
  ModelMesh take();

 private:
  std::uint32_t number_of(const Vec3d& point);
  std::uint32_t* slot_of(const Vec3d& point);
  void grow();

  ModelMesh mesh_;
  std::vector<std::uint32_t> slots_;  // by a hash of the coordinates: the vertex's number, or none
};

// Throws InputError with `file` if the nodes' meshes, each counted where it is, have more triangles than this.
inline constexpr std::size_t most_triangles = 100'000'000;
void expect_few(const std::string& file, const Model& model);

// All triangles of the model in the root frame of its file, in metres. Throws InputError with `file` if a vertex is not
// finite there.
ModelMesh whole_mesh(const std::string& file, const Model& model);

}  // namespace touchstone::models
