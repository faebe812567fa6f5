// Our meshes as FCL's.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <memory>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"

namespace touchstone::fcl_shapes {

// BV is the volume of the model's tree. The mesh has a triangle.
template <class BV>
std::shared_ptr<fcl::BVHModel<BV>> make_fcl_mesh(const TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& corners : mesh.triangles) {
    triangles.emplace_back(corners[0], corners[1], corners[2]);
  }
  const auto model = std::make_shared<fcl::BVHModel<BV>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(mesh.vertices.size()));
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

}  // namespace touchstone::fcl_shapes
