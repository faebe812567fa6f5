// Scenes with bodies that are not convex.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "harness/base/error.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/geometry/mesh_shapes.h"
#include "harness/scene/player.h"
#include "tests/harness/scene/scene_text.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

// Two tetrahedra that lie apart.
constexpr const char* two_parts =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";
constexpr const char* open_surface = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n";

std::string fault(const std::string& content) {
  const TemporaryFolder folder;
  folder.write("open.obj", open_surface);
  try {
    scene::load_scene(folder.write("scene.toml", content));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(ConcaveScene, AMeshIsWhatTheFileSays) {
  const TemporaryFolder folder;
  folder.write("two.obj", two_parts);
  const auto load = [&](const std::string& keys, const std::string& top = "") {
    return scene::load_scene(
        folder.write("scene.toml", top + "body = [{mesh = \"two.obj\"" + keys + "}]\n"));
  };
  const scene::Scene surface = load("");
  ASSERT_NE(surface.concave_of(0), nullptr);
  EXPECT_EQ(surface.concave_of(0)->mesh->triangles.size(), 8u);
  EXPECT_FALSE(surface.concave_of(0)->mesh->solid);
  EXPECT_EQ(surface.shapes[0].kind, ShapeKind::hull);

  EXPECT_TRUE(load(", as = \"solid\"").concave_of(0)->mesh->solid);
  EXPECT_EQ(load(", as = \"hull\"").concave_of(0), nullptr);
  EXPECT_EQ(load("", "meshes = \"hull\"\n").concave_of(0), nullptr);
  EXPECT_NE(load(", as = \"surface\"", "meshes = \"hull\"\n").concave_of(0), nullptr);
  const scene::Scene compound = load(", as = \"compound\"");
  EXPECT_EQ(compound.concave_of(0)->mesh, nullptr);
  EXPECT_EQ(compound.concave_of(0)->parts.size(), 2u);

  const scene::Scene parts = load(", parts = true");
  ASSERT_EQ(parts.bodies.size(), 2u);
  EXPECT_EQ(parts.concave_of(parts.bodies[1].shape)->mesh->triangles.size(), 4u);
  EXPECT_EQ(load(", parts = true, as = \"hull\"").concave.size(), 0u);

  // Every use has a hash of its own.
  EXPECT_NE(scene_hash(surface), scene_hash(load(", as = \"solid\"")));
  EXPECT_NE(scene_hash(surface), scene_hash(load(", as = \"hull\"")));
}

TEST(ConcaveScene, AnImportSaysWhatMeshesAre) {
  const TemporaryFolder folder;
  folder.write("two.obj", two_parts);
  folder.write("inner.toml",
               "meshes = \"hull\"\nframes = 3\nbody = [{mesh = \"two.obj\", parts = true}]\n");
  const auto load = [&](const std::string& keys) {
    return scene::load_scene(folder.write("outer.toml", "import = \"inner.toml\"\n" + keys));
  };
  const scene::Scene same = load("");
  EXPECT_EQ(same.name, "outer");
  EXPECT_EQ(same.frames, 3);
  EXPECT_EQ(same.bodies.size(), 2u);
  EXPECT_TRUE(same.concave.empty());
  const scene::Scene whole = load("meshes = \"compound\"\n");
  ASSERT_EQ(whole.bodies.size(), 1u);
  EXPECT_EQ(whole.concave_of(0)->parts.size(), 2u);
  folder.write("inner.toml", "generator = \"uniform\"\n");
  EXPECT_EQ(load("").bodies.size(), 1000u);
}

TEST(ConcaveScene, CompoundsAreNested) {
  const scene::Scene scene = load_text(R"(
[[body]]
translation = [0, 0, 1]
[body.shape]
type = "compound"
parts = [
  {shape = {type = "sphere", radius = 0.5}, translation = [3, 0, 0]},
  {translation = [0, 2, 0], quaternion_wxyz = [0.7071067811865476, 0, 0, 0.7071067811865476], shape = {type = "compound", parts = [
    {shape = {type = "capsule", radius = 0.25, half_length = 1, axis = "x"}, translation = [1, 0, 0]},
  ]}},
  {quaternion_wxyz = [0.9, 0.1, 0.2, 0.3], shape = {type = "compound", parts = [
    {shape = {type = "sphere", radius = 0.1}, translation = [0.1, 0.2, 0.3], quaternion_wxyz = [0.7, 0.5, 0.1, 0.1]},
  ]}},
]
)");
  const ConcaveBody& body = *scene.concave_of(0);
  ASSERT_EQ(body.parts.size(), 3u);
  EXPECT_EQ(body.parts[0].rounding, 0);
  EXPECT_EQ(body.parts[1].rounding, 0);  // a quarter turn is exact
  EXPECT_GT(body.parts[2].rounding, 0);
  EXPECT_LT(body.parts[2].rounding, 1e-13);
  // A quarter turn about z takes x to y, and so the part's centre to y = 3.
  EXPECT_NEAR(body.parts[1].pose.translation.y(), 3, 1e-12);
  EXPECT_NEAR((body.parts[1].pose.rotation * Vec3d(0, 0, 1)).cwiseAbs().y(), 1, 1e-12);

  // The box holds the round parts, not only their polytopes; the loose one any attitude.
  const scene::ScenePlayer tight(scene, scene::BoxKind::tight), loose(scene, scene::BoxKind::loose);
  const Aabb box = tight.boxes()[0], any = loose.boxes()[0];
  EXPECT_GE(box.max[0], 3.5f);
  EXPECT_LT(box.max[0], 3.50001f);
  EXPECT_GE(box.max[1], 4.25f - 1e-6f);
  EXPECT_LE(box.min[2], 0.5f);
  EXPECT_GE(any.max[2], 1 + 4.25f - 1e-5f);
}

TEST(ConcaveScene, CompoundsTakeMeshes) {
  const TemporaryFolder folder;
  folder.write("two.obj", two_parts);
  const auto load = [&](const std::string& as) {
    return scene::load_scene(
        folder.write("scene.toml",
                     "body = [{shape = {type = \"compound\", parts = [\n"
                     "{shape = {type = \"sphere\", radius = 1}},\n"
                     "{translation = [0, 9, 0], shape = {mesh = \"two.obj\", as = \"" +
                         as + "\"}}]}}]\n"));
  };
  const scene::Scene solid = load("solid"), surface = load("surface");
  const ConcaveBody& body = *solid.concave_of(0);
  ASSERT_EQ(body.parts.size(), 9u);
  ASSERT_EQ(body.surfaces.size(), 1u);
  EXPECT_EQ(body.surfaces[0].first, 1u);
  EXPECT_EQ(body.parts[8].pose.translation, Vec3d(0, 9, 0));
  EXPECT_TRUE(body.has_inside());
  EXPECT_FALSE(surface.concave_of(0)->has_inside());
  EXPECT_NE(scene_hash(solid), scene_hash(surface));
  // The mesh is there as it is, and closed.
  const geometry::Mesh& mesh = *solid.mesh_of(0);
  EXPECT_FALSE(geometry::open_edge(mesh.vertices, mesh.triangles));
  EXPECT_EQ(mesh.vertices.front(), Vec3d(0, 9, 0));
  // The hulls of its two parts, and its own.
  EXPECT_EQ(load("compound").concave_of(0)->parts.size(), 3u);
  EXPECT_TRUE(load("compound").concave_of(0)->surfaces.empty());
  EXPECT_EQ(load("hull").concave_of(0)->parts.size(), 2u);
}

TEST(ConcaveScene, FaultsAreNamed) {
  EXPECT_THAT(fault("body = [{mesh = \"open.obj\", as = \"solid\"}]"),
              AllOf(HasSubstr("surface is open at the edge"), HasSubstr("scene.toml:1")));
  EXPECT_THAT(fault("body = [{shape = {type = \"compound\", parts = []}}]"), HasSubstr("parts"));
  EXPECT_THAT(
      fault("body = [{shape = {type = \"compound\", parts = [{shape = {mesh = \"open.obj\", "
            "as = \"solid\"}}]}}]"),
      AllOf(HasSubstr("surface is open at the edge"), HasSubstr("scene.toml:1")));
  EXPECT_THAT(fault("body = [{shape = {type = \"gear\", root_radius = 0.2}}]"),
              HasSubstr("less than root_radius"));
  EXPECT_THAT(fault("body = [{mesh = \"open.obj\", as = \"ball\"}]"),
              HasSubstr("surface, solid, hull, compound"));
  EXPECT_THAT(fault("generator = \"chain\"\ncount = 4\n"), HasSubstr("no link is longer"));
  EXPECT_THAT(fault("body = [{shape = {type = \"compound\", parts = [{shape = {type = \"sphere\", "
                    "radius = 1}, wheel = 4}]}}]"),
              HasSubstr("wheel"));
}

TEST(ConcaveScene, GearsAreClosed) {
  for (const std::size_t teeth : {3u, 16u}) {
    const geometry::Mesh gear = geometry::gear(teeth, 0.8, 0.3, 0.25);
    EXPECT_EQ(gear.triangles.size(), 32 * teeth);
    EXPECT_FALSE(geometry::open_edge(gear.vertices, gear.triangles));
  }
}

TEST(ConcaveScene, GeneratorsPlaceThem) {
  const scene::Scene gears =
      load_text("generator = \"uniform\"\ncount = 50\nshapes = [{type = \"gear\"}, \"sphere\"]\n");
  // All gears share a shape, and prepare once.
  EXPECT_EQ(std::ranges::count_if(gears.concave, [](const auto& body) { return body != nullptr; }),
            1);

  const scene::Scene hills = load_text(
      "generator = \"terrain\"\ncount = 20\ncells = 16\nshapes = [{type = \"compound\", parts = "
      "[{shape = {type = \"box\", half_extents = [1, 0.5, 0.5]}}]}]\n");
  ASSERT_EQ(hills.bodies.size(), 20u);
  const ConcaveBody& ground = *hills.concave_of(hills.bodies[0].shape);
  EXPECT_EQ(ground.mesh->triangles.size(), 512u);
  EXPECT_FALSE(hills.bodies[0].moving);

  const scene::Scene chain = load_text(
      "generator = \"chain\"\ncount = 7\nstrands = 2\nslack = 0.1\n"
      "shapes = [{type = \"torus\", tube_radius = 0.25}]\n");
  EXPECT_NEAR(chain.bodies[1].pose.translation.x(), 1.5 * 0.9, 1e-6);
  EXPECT_EQ(chain.bodies[4].pose.translation.x(), 0);
  EXPECT_GT(chain.bodies[4].pose.translation.y(), 2);
  // Links of one chain are turned by a quarter against each other.
  EXPECT_EQ(chain.bodies[1].pose.rotation * Vec3d(0, 1, 0), Vec3d(0, 0, 1));
}

}  // namespace
}  // namespace touchstone
