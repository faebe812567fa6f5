// Scenes that are written and read.
#include "harness/scene/scene.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "harness/families/ray_scenes.h"
#include "harness/geometry/concave_bodies.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

std::vector<SceneBody> bodies_in(const scene::Scene& scene) {
  std::vector<SceneBody> bodies;
  for (const scene::Body& body : scene.bodies) {
    SceneBody& made = bodies.emplace_back();
    made.pose = body.pose;
    if (const ConcaveBody* concave = scene.concave_of(body.shape)) {
      made.body = *concave;
    } else {
      made.body.parts.push_back({scene.shapes[body.shape], {}, 0});
    }
  }
  return bodies;
}

// The names and texts of all files.
std::map<std::string, std::string> files_of(const TemporaryFolder& folder) {
  std::map<std::string, std::string> texts;
  for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
    const std::string name = file.path().filename().string();
    texts[name] = folder.read(name);
  }
  return texts;
}

TEST(SceneWriter, WritesWhatIsReadAsItWas) {
  for (const families::RayScene kind :
       {families::RayScene::mixed, families::RayScene::on_a_grid, families::RayScene::crowd}) {
    SCOPED_TRACE(std::string(to_string(kind)));
    families::RandomDraws draws(7);
    const std::vector<SceneBody> bodies = families::bodies_of(kind, draws);
    const TemporaryFolder first, second;
    scene::write_scene(first.path() / "some.toml", bodies);
    const scene::Scene scene = scene::load_scene(first.path() / "some.toml");
    const std::vector<SceneBody> again = bodies_in(scene);
    ASSERT_EQ(again.size(), bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      EXPECT_EQ(again[i].pose.rotation, bodies[i].pose.rotation);
      EXPECT_EQ(again[i].pose.translation, bodies[i].pose.translation);
      EXPECT_EQ(again[i].body.part_count(), bodies[i].body.part_count());
      EXPECT_FALSE(scene.bodies[i].moving);
    }
    scene::write_scene(second.path() / "some.toml", again);
    EXPECT_EQ(files_of(first), files_of(second));
  }
}

TEST(SceneWriter, KeepsSolidsAndTheirPlacesInCompounds) {
  families::RandomDraws draws(3);
  SceneBody body;
  body.body.parts.push_back({Shape{}, {draws.rotation(), {1, 2, 3}}, 0});
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}},
                    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                    true};
  geometry::add_surface(std::make_shared<const TriangleMesh>(mesh), {draws.rotation(), {4, 5, 6}},
                        {}, body.body);
  const TemporaryFolder folder;
  scene::write_scene(folder.path() / "a.toml", {&body, 1});
  const auto again = bodies_in(scene::load_scene(folder.path() / "a.toml"));
  ASSERT_EQ(again.size(), 1u);
  ASSERT_EQ(again[0].body.surfaces.size(), 1u);
  EXPECT_TRUE(again[0].body.has_inside());
  EXPECT_EQ(again[0].body.surfaces[0].first, 1u);
  EXPECT_EQ(again[0].body.surfaces[0].mesh->vertices, mesh.vertices);
  EXPECT_EQ(again[0].body.parts[4].pose.rotation, body.body.parts[4].pose.rotation);
}

}  // namespace
}  // namespace touchstone
