// Makes meshes and compounds of stand-ins.
#include "harness/trade/pipeline/whole_bodies.h"

#include <memory>

#include "harness/geometry/shapes/compound.h"

namespace touchstone::trade {

std::vector<ConcaveBody> whole_bodies(const SceneFrames& frames, const StandIns& stand_ins,
                                      const Configuration& configuration) {
  const scene::Scene& scene = *frames.scene;
  std::vector<ConcaveBody> bodies(scene.shapes.size());
  std::vector<char> made(scene.shapes.size(), 0);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::uint32_t shape = scene.bodies[i].shape;
    if (made[shape] != 0) continue;
    made[shape] = 1;
    ConcaveBody& body = bodies[shape];
    const geometry::Mesh* mesh = frames.mesh_of[shape];
    const auto& wanted = configuration.representations.of[frames.kind_of(i)];
    if (mesh != nullptr && wanted && wanted->form == proxies::Form::mesh) {
      const bool closed = !geometry::open_edge(mesh->vertices, mesh->triangles);
      body.mesh = std::make_shared<const TriangleMesh>(
          TriangleMesh{mesh->vertices, mesh->triangles, closed});
      continue;
    }
    for (const proxies::Part& part : stand_ins.of[i]->parts) {
      body.parts.push_back({part.shape, part.pose});
    }
  }
  return bodies;
}

}  // namespace touchstone::trade
