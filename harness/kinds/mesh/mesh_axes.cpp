// Draws pairs of triangles at the values of axes of stress.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "harness/families/triangle_pairs.h"
#include "harness/kinds/mesh/mesh_draws.h"

namespace touchstone::kinds {
namespace {

using families::Draws;
using files::ConcaveCase;

ConcaveCase plain(const families::TrianglePair& pair) {
  ConcaveCase c;
  c.a = triangle_body(pair.a);
  c.b = triangle_body(pair.b);
  return c;
}

// Triangles that share a point on a grid, at a distance from the origin that may round them.
ConcaveCase far_triangles(double distance, Draws& draws) {
  const auto& all = families::triangle_families();
  families::TrianglePair pair = all[draws.below(2) == 0 ? 4 : 5].draw(draws);
  const Vec3d away = distance * draws.direction();
  for (auto* corners : {&pair.a, &pair.b}) {
    for (Vec3d& corner : *corners) corner += away;
  }
  return plain(pair);
}

}  // namespace

ConcaveBody triangle_body(const std::array<Vec3d, 3>& corners) {
  return {std::make_shared<const TriangleMesh>(
              TriangleMesh{{corners.begin(), corners.end()}, {{0, 1, 2}}, false}),
          {}};
}

void add_mesh_axes(std::vector<DrawnFamily<ConcaveCase>>& list) {
  const auto add = [&](const char* axis, int first, int last, const auto& draw) {
    for (const AxisValue& at : decades(first, last)) {
      list.push_back(
          {fmt::format("{}-{}", axis, at.name), "axes", 1,
           [draw, size = at.value](Draws& draws, std::uint64_t) { return draw(size, draws); }, axis,
           at.name});
    }
  };
  const auto sized = [](families::TrianglePair (*make)(Draws&, double)) {
    return [make](double size, Draws& draws) { return plain(make(draws, size)); };
  };
  add("edge-gap", -1, -17, sized(families::edges_near));
  add("face-gap", -1, -17, sized(families::vertex_near_face));
  add("sliver-width", -1, -17, sized(families::slivers));
  add("plane-angle", -1, -17, sized(families::parallel_planes));
  add("mesh-distance", 0, 15, far_triangles);
}

}  // namespace touchstone::kinds
