// Draws pairs of triangles, meshes, compounds and convex bodies.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/core/bounds.h"
#include "harness/families/meshes.h"
#include "harness/families/moving_pairs.h"
#include "harness/families/triangle_pairs.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/kinds/mesh/mesh_kind.h"

namespace touchstone::kinds {
namespace {

using families::Draws;
using files::ConcaveCase;

ConcaveBody body_of(TriangleMesh mesh) {
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), {}};
}
ConcaveBody body_of(Shape shape) { return {nullptr, {{std::move(shape), {}, 0}}}; }

ConcaveCase triangles(const families::TriangleFamily& family, Draws& draws, std::uint64_t index) {
  const auto form = families::all_triangle_forms[index % families::all_triangle_forms.size()];
  const families::TrianglePair pair = in_form(family.draw(draws), form, draws);
  ConcaveCase c;
  c.a = triangle_body(pair.a);
  c.b = triangle_body(pair.b);
  c.pose_a = pair.pose_a;
  c.pose_b = pair.pose_b;
  return c;
}

// A mesh of a size about 1, of at most some tens of triangles.
TriangleMesh small_mesh(Draws& draws, std::uint64_t index) {
  switch (index % 6) {
    case 0: return families::torus(6, 4, 0.75, 0.25, draws.below(2) == 0);
    case 1: return families::moved(families::ellipsoid_mesh({1, 1, 1}, 6, 4), 1, {0, 0, 0});
    case 2: return families::moved(families::soup_mesh(16, index), 0.25, {0, 0, 0});
    case 3: return families::moved(families::terrain_mesh(4, 1, index), 0.5, {-1, -1, 0});
    case 4: return families::box_mesh(0.5, 1, 0.25, draws.below(2) == 0);
    default:
      return families::moved(families::ellipsoid_mesh({2, 1, 2}, 6, 4), 1 / 3.0, {0.1, 0, 0});
  }
}

Pose any_pose(Draws& draws, double reach) {
  Pose pose;
  pose.rotation = draws.rotation();
  pose.translation = draws.vector(reach);
  return pose;
}

ConcaveCase mesh_pair(Draws& draws, std::uint64_t index) {
  ConcaveCase c;
  c.a = body_of(small_mesh(draws, index));
  c.b = body_of(small_mesh(draws, index / 6 + 1));
  c.pose_a = any_pose(draws, 1);
  c.pose_b = any_pose(draws, 1);
  c.pose_b.translation += 0.8 * draws.direction();
  return c;
}

// A mesh against itself, in one pose or an ulp off.
ConcaveCase itself(Draws& draws, std::uint64_t index) {
  ConcaveCase c;
  c.a = c.b = body_of(small_mesh(draws, index));
  c.pose_a = c.pose_b = any_pose(draws, 1);
  if (draws.below(2) == 0) {
    double& x = c.pose_b.translation[draws.below(3)];
    x = std::nextafter(x, 9);
  }
  return c;
}

// Boxes on a grid: faces flush, edges along edges, one inside of the other.
ConcaveCase boxes_on_a_grid(Draws& draws, std::uint64_t /*index*/) {
  const auto half = [&] { return (1 + draws.below(4)) / 4.0; };
  const auto place = [&] { return draws.below(9) / 4.0 - 1; };
  const auto box = [&](bool solid) {
    const double x = half(), y = half();
    return families::box_mesh(x, y, half(), solid);
  };
  ConcaveCase c;
  c.a = body_of(box(draws.below(2) == 0));
  c.b = body_of(box(draws.below(2) == 0));
  const double x = place(), y = place();
  c.pose_b.translation = {x, y, place()};
  return c;
}

// A convex body at a gap or depth from a vertex, an edge or a face of a mesh.
ConcaveCase convex_at(double gap, Draws& draws, std::uint64_t index) {
  constexpr std::array kinds = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::hull};
  TriangleMesh mesh = small_mesh(draws, index);
  Shape shape = families::random_shape(kinds[index / 6 % kinds.size()], draws);
  const auto& [i, j, k] = mesh.triangles[static_cast<std::size_t>(
      draws.below(static_cast<int>(mesh.triangles.size())))];
  const Vec3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
  const int which = draws.below(3);
  const Vec3d at = which == 0 ? a : which == 1 ? Vec3d((a + b) / 2) : Vec3d((a + b + 2 * c) / 4);
  Vec3d normal = (b - a).cross(c - a);
  normal = which == 2 && normal.norm() > 1e-9 ? normal.normalized() : draws.direction();
  ConcaveCase drawn;
  drawn.pose_b.rotation = draws.rotation();
  drawn.pose_b.translation = at + gap * normal - support_point(shape, drawn.pose_b, -normal);
  drawn.a = body_of(std::move(mesh));
  drawn.b = body_of(std::move(shape));
  return drawn;
}

// A box whose face lies on a flat terrain, or at a distance from it that only the last bits show.
ConcaveCase flush(Draws& draws, std::uint64_t index) {
  constexpr std::array gaps = {0.0, 0x1p-52, -0x1p-52, 1e-12, -1e-12, 1e-9, -1e-9};
  ConcaveCase c;
  c.a = body_of(families::terrain_mesh(4, 0, 1));
  c.b = body_of(families::box_shape({0.5, 0.25, 0.5}));
  const double x = draws.below(17) / 4.0, y = draws.below(17) / 4.0;
  c.pose_b.translation = {x, y, 0.5 + gaps[index % gaps.size()]};
  return c;
}

// A body in, across or outside of a solid one.
ConcaveCase solids(Draws& draws, std::uint64_t index) {
  ConcaveCase c;
  c.a = body_of(index % 2 == 0 ? families::torus(8, 4, 1, 0.5, true)
                               : families::box_mesh(1, 1, 1, true));
  if (index % 3 == 0) {
    c.b = body_of(families::box_mesh(0.125, 0.125, 0.125));
  } else {
    c.b = body_of(families::round_shape(ShapeKind::sphere, 0.125, 0));
  }
  const auto quarter = [&] { return draws.below(13) / 4.0 - 1.5; };
  const double x = quarter(), y = quarter();
  c.pose_b.translation = {x, y, quarter()};
  if (index % 5 == 0) c.pose_b = any_pose(draws, 1.5);
  return c;
}

ConcaveCase compounds(Draws& draws, std::uint64_t index) {
  constexpr std::array kinds = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::hull};
  const auto compound = [&] {
    ConcaveBody body;
    for (int i = 0; i < 3; ++i) {
      Pose pose;
      pose.translation = families::on_grid(draws.vector(1));
      const auto kind = kinds[static_cast<std::size_t>(draws.below(4))];
      body.parts.push_back({families::random_shape(kind, draws), pose, 0});
    }
    return body;
  };
  ConcaveCase c;
  c.a = compound();
  c.b = index % 2 == 0 ? compound() : body_of(small_mesh(draws, index));
  c.pose_b.translation = families::on_grid(Vec3d(2 * draws.direction()));
  return c;
}

// Anything in, across or outside of a compound that has solid meshes among its parts.
ConcaveCase solid_parts(Draws& draws, std::uint64_t index) {
  const auto add = [](TriangleMesh mesh, const Vec3d& at, std::span<const Pose> around,
                      ConcaveBody& to) {
    geometry::add_surface(std::make_shared<const TriangleMesh>(std::move(mesh)),
                          {Mat3d::Identity(), at}, around, to);
  };
  const auto is_solid = [&] { return draws.below(4) != 0; };
  const auto quarter = [&] { return draws.below(13) / 4.0 - 1.5; };
  ConcaveCase c;
  // Within a turned pose places are rounded.
  std::vector<Pose> around;
  if (index % 4 == 3) around.push_back(any_pose(draws, 0.5));
  add(index % 2 == 0 ? families::torus(8, 4, 1, 0.5, is_solid())
                     : families::box_mesh(1, 1, 1, is_solid()),
      {0, 0, 0}, around, c.a);
  add(families::box_mesh(0.25, 0.5, 0.25, is_solid()), {0, 2.5, 0}, around, c.a);
  const Shape ball = families::round_shape(ShapeKind::sphere, 0.125, 0);
  switch (index % 5) {
    case 0: c.b = body_of(ball); break;
    case 1: c.b = body_of(families::box_mesh(0.125, 0.125, 0.125)); break;
    case 2:
      c.b.parts.push_back({ball, {Mat3d::Identity(), {0, -1.5, 0}}, 0});
      add(families::box_mesh(0.125, 0.125, 0.125), {0, 0, 0}, {}, c.b);
      break;
    case 3:
      // Large enough to hold a part of the other.
      add(families::box_mesh(0.75, 1.5, 0.75, is_solid()), {0, 0, 0}, {}, c.b);
      break;
    default: {
      Shape& floor = c.b.parts.emplace_back().shape;
      floor.kind = ShapeKind::halfspace;
      floor.normal = draws.direction();
      break;
    }
  }
  const double x = quarter(), y = quarter() + draws.below(2);
  c.pose_b.translation = {x, 1.5 * y, quarter()};
  if (index % 7 == 0) c.pose_b.rotation = draws.rotation();
  if (draws.below(2) == 0) {
    std::swap(c.a, c.b);
    std::swap(c.pose_a, c.pose_b);
  }
  return c;
}

// A mesh of 10^9 times the other's size, at one of its vertices.
ConcaveCase sizes(Draws& draws, std::uint64_t index) {
  ConcaveCase c;
  const TriangleMesh large = small_mesh(draws, index);
  const Vec3d at =
      large
          .vertices[static_cast<std::size_t>(draws.below(static_cast<int>(large.vertices.size())))];
  c.a = body_of(large);
  c.b = body_of(families::moved(small_mesh(draws, index + 1), 0x1p-30, {0, 0, 0}));
  c.pose_b.rotation = draws.rotation();
  c.pose_b.translation = at + 0x1p-30 * draws.vector(1.5);
  return c;
}

}  // namespace

std::span<const DrawnFamily<ConcaveCase>> mesh_families() {
  static const auto all = [] {
    std::vector<DrawnFamily<ConcaveCase>> list;
    for (const families::TriangleFamily& family : families::triangle_families()) {
      list.push_back({"triangles-" + family.name, "triangles", 1,
                      [&family](Draws& draws, std::uint64_t index) {
                        return triangles(family, draws, index);
                      }});
    }
    const auto add = [&](const char* name, int one_in, auto draw) {
      list.push_back({name, "bodies", one_in, draw});
    };
    add("bodies-mesh-pairs", 2, mesh_pair);
    add("bodies-itself", 4, itself);
    add("bodies-on-a-grid", 1, boxes_on_a_grid);
    constexpr std::array<std::pair<const char*, double>, 8> gaps = {
        {{"bodies-gap-1e-3", 1e-3},
         {"bodies-gap-1e-6", 1e-6},
         {"bodies-gap-1e-9", 1e-9},
         {"bodies-gap-1e-12", 1e-12},
         {"bodies-depth-1e-3", -1e-3},
         {"bodies-depth-1e-6", -1e-6},
         {"bodies-depth-1e-9", -1e-9},
         {"bodies-depth-1e-12", -1e-12}}};
    for (const auto& [name, gap] : gaps) {
      add(name, 2,
          [gap](Draws& draws, std::uint64_t index) { return convex_at(gap, draws, index); });
    }
    add("bodies-flush", 1, flush);
    add("bodies-solid", 1, solids);
    add("bodies-compounds", 2, compounds);
    add("bodies-sizes", 4, sizes);
    add_mesh_axes(list);
    // Cases depend on the number of their family, so that new ones come last.
    add("bodies-solid-parts", 1, solid_parts);
    return list;
  }();
  return all;
}

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
