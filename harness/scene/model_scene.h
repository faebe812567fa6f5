// Scenes of other programs: a model's nodes as bodies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/core/pose.h"
#include "harness/geometry/mesh.h"
#include "harness/scene/concave_shape.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// What a model is as a scene, in metres, with z up.
struct PlacedModel {
  struct Node {
    std::string name;  // that of the file's node, in UTF-8; no two have the same
    std::uint32_t mesh = 0;
    Pose pose;
  };
  std::vector<geometry::Mesh> meshes;
  std::vector<Node> nodes;  // those with triangles, parents first
  // Such as "model: 3 bodies, 2 shapes; unit 0.01 m, y up, turned to z up".
  std::string words;
  std::string left_out;  // such as "2 lines, 1 animation"; may be empty
};

// Reads a model (models/model.h): each node with triangles is a body. What of its transform is no rotation (scale, shear,
// a mirror) is applied to the vertices. A mesh with the same of these to 2e-6 is read once, and one within 2e-6 of none
// has none. Throws InputError as models::read_model, and for places that are not finite.
PlacedModel place_model(const std::filesystem::path& file);

// The same as a scene at rest, of one frame. A mesh is what `use` says. Throws InputError, also for an open surface of a
// solid.
Scene import_model(const std::filesystem::path& file, MeshUse use);

// Writes a scene file of the same bodies, and beside it an OFF file for each mesh, NAME-NUMBER.off. Returns the files'
// paths.
std::vector<std::filesystem::path> write_model(const PlacedModel& model,
                                               const std::filesystem::path& file);

}  // namespace touchstone::scene
