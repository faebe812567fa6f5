// Shapes as a module gets them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/core/shape.h"
#include "algorithms/module/touchstone_module.h"

namespace touchstone::modules {

class ModuleShapes {
 public:
  // The shapes outlive this.
  explicit ModuleShapes(std::span<const Shape> shapes);

  const TouchstoneModuleShape* const* data() const { return pointers_.data(); }
  std::size_t size() const { return pointers_.size(); }

 private:
  // The lists of a hull, one behind another.
  struct Lists {
    std::vector<std::uint32_t> neighbour_starts, neighbours, face_starts, face_vertices;
    std::vector<double> face_normals;
  };

  std::vector<TouchstoneModuleShape> shapes_;
  std::vector<const TouchstoneModuleShape*> pointers_;
  std::vector<std::unique_ptr<Lists>> lists_;
};

}  // namespace touchstone::modules
