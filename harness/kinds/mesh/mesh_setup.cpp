// Makes convex bodies and concave phases.
#include "harness/kinds/mesh/mesh_setup.h"

#include <utility>
#include <vector>

#include "algorithms/core/nearest_float.h"
#include "algorithms/hull/convex_hull.h"
#include "algorithms/registry.h"

namespace touchstone::kinds {

Shape convex_shape(std::string_view name, double size, base::Random& random) {
  Shape shape;
  if (name == "hull-32") {
    std::vector<Vec3d> points;
    for (int i = 0; i < 32; ++i) points.push_back(nearest_float(Vec3d(size * random.on_sphere())));
    return hull_of(std::move(points));
  }
  const auto rounded = [&](double part) { return nearest_float(Vec3d::Constant(part * size))[0]; };
  shape.kind = name == "sphere"    ? ShapeKind::sphere
               : name == "capsule" ? ShapeKind::capsule
                                   : ShapeKind::box;
  shape.radius = rounded(name == "sphere" ? 1 : 0.4);
  shape.half_length = rounded(0.6);
  shape.half_extents = {rounded(1), rounded(0.8), rounded(0.6)};
  return shape;
}

std::unique_ptr<ConcavePhase> make_phase(const ConcaveEntry& entry, Precision scalar, bool welds) {
  ConcaveSettings settings;
  settings.scalar = scalar;
  settings.mid_phase = registry::find<MidPhaseEntry>("wide-bvh")->make;
  settings.narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); };
  settings.welds = welds;
  return entry.make(settings);
}

}  // namespace touchstone::kinds
