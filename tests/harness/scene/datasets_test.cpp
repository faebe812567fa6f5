// The data sets that need more than a generator: the home and CGAL's meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "algorithms/core/bounds.h"
#include "harness/base/error.h"
#include "harness/scene/player.h"
#include "harness/scene/scene.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

const std::filesystem::path datasets =
    std::filesystem::path(touchstone::project_folder) / "datasets";

TEST(Home, IsAFurnishedFlat) {
  const scene::Scene scene = scene::load_scene(datasets / "home.toml");
  EXPECT_EQ(scene.name, "home");
  EXPECT_GT(scene.bodies.size(), 1000u);
  std::size_t moving = 0;
  for (const scene::Body& body : scene.bodies) moving += body.moving;
  EXPECT_GT(moving, 10u);
  EXPECT_LT(moving, 50u);
  for (const Shape& shape : scene.shapes) {
    EXPECT_TRUE(shape.kind == ShapeKind::box || shape.hull->dimension < 3 ||
                !shape.hull->faces.empty());
  }
  const scene::ScenePlayer player(scene, scene::BoxKind::tight);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Aabb& box = player.boxes()[i];
    for (std::size_t k = 0; k < 3; ++k) {  // all of it is within the walls, up to a millimetre
      EXPECT_GE(box.min[k], k == 2 ? -0.2002f : -0.001f);
      EXPECT_LE(box.max[k], (k == 0 ? 10.001f : k == 1 ? 9.001f : 2.501f));
    }
    for (std::size_t j = i + 1; j < scene.size(); ++j) pairs += overlap(box, player.boxes()[j]);
  }
  EXPECT_GT(pairs, 1000u);
  EXPECT_LT(pairs, 10000u);
}

TEST(ScenesAtRest, NothingMovesAndBodiesTouch) {
  for (const auto& [file, bodies] :
       {std::pair{"brick_wall.toml", 201u}, std::pair{"rock_pile_at_rest.toml", 251u}}) {
    SCOPED_TRACE(file);
    const scene::Scene scene = scene::load_scene(datasets / file);
    EXPECT_EQ(scene.bodies.size(), bodies);
    EXPECT_EQ(std::ranges::count(scene.bodies, true, &scene::Body::moving), 0);
    scene::ScenePlayer player(scene, scene::BoxKind::tight);
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < scene.size(); ++i) {
      for (std::size_t j = i + 1; j < scene.size(); ++j)
        pairs += overlap(player.boxes()[i], player.boxes()[j]);
    }
    EXPECT_GT(pairs, 2 * scene.size());
  }
}

struct MadeScene {
  const char* file;
  std::size_t bodies, least_pairs, most_pairs;  // of boxes, in the first frame
};

TEST(MadeScenes, AreThereAndMoveALittle) {
  for (const MadeScene& made :
       {MadeScene{"rock_pile.toml", 251, 500, 3000}, MadeScene{"crowd.toml", 1025, 700, 5000},
        MadeScene{"arch.toml", 118, 100, 400}, MadeScene{"chain_net.toml", 2800, 3000, 30000}}) {
    SCOPED_TRACE(made.file);
    const scene::Scene scene = scene::load_scene(datasets / made.file);
    EXPECT_EQ(scene.bodies.size(), made.bodies);
    EXPECT_GE(scene.frames, 16);
    scene::ScenePlayer player(scene, scene::BoxKind::tight);
    std::size_t pairs = 0, moved = 0;
    const std::vector<Aabb> first(player.boxes().begin(), player.boxes().end());
    for (std::size_t i = 0; i < scene.size(); ++i) {
      for (std::size_t j = i + 1; j < scene.size(); ++j) pairs += overlap(first[i], first[j]);
    }
    EXPECT_GE(pairs, made.least_pairs);
    EXPECT_LE(pairs, made.most_pairs);
    while (player.frame() + 1 < scene.frames) player.next();
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const float by = std::abs(player.boxes()[i].min[0] - first[i].min[0]) +
                       std::abs(player.boxes()[i].min[1] - first[i].min[1]) +
                       std::abs(player.boxes()[i].min[2] - first[i].min[2]);
      moved += by > 1e-4f;
      EXPECT_LT(by, 1.5f);
    }
    EXPECT_GT(moved, scene.size() / 2);
  }
}

TEST(FarClumps, AreFarApart) {
  const scene::Scene scene = scene::load_scene(datasets / "broad/far_clumps.toml");
  ASSERT_EQ(scene.bodies.size(), 10'000u);
  const scene::ScenePlayer player(scene, scene::BoxKind::tight);
  Aabb world = Aabb::empty();
  for (const Aabb& box : player.boxes()) {
    for (std::size_t k = 0; k < 3; ++k) {
      world.min[k] = std::min(world.min[k], box.min[k]);
      world.max[k] = std::max(world.max[k], box.max[k]);
    }
  }
  // The boxes along x are in at most fifty groups with wide gaps between them.
  std::vector<std::array<float, 2>> along;
  for (const Aabb& box : player.boxes()) along.push_back({box.min[0], box.max[0]});
  std::ranges::sort(along);
  const float width = world.max[0] - world.min[0];
  float covered = 0;
  float end = world.min[0];
  for (const auto& [low, high] : along) {
    covered += std::max(0.0f, high - std::max(low, end));
    end = std::max(end, high);
  }
  EXPECT_LT(covered, 0.1f * width);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < 1'000; ++i) {
    for (std::size_t j = 0; j < scene.size(); ++j) {
      pairs += i != j && overlap(player.boxes()[i], player.boxes()[j]) ? 1 : 0;
    }
  }
  EXPECT_GT(pairs, 2'000u);  // five a body are asked for
  EXPECT_LT(pairs, 10'000u);
}

TEST(Home, EachPieceIsOneFileUnderAMegabyteInAll) {
  std::uintmax_t bytes = 0;
  int pieces = 0;
  for (const auto& entry : std::filesystem::directory_iterator(datasets / "home")) {
    if (entry.path().extension() != ".obj") continue;
    bytes += entry.file_size();
    ++pieces;
  }
  EXPECT_EQ(pieces, 42);
  EXPECT_LT(bytes, 1'000'000u);
}

class Parts : public testing::Test {
 protected:
  scene::Scene load(const std::string& body) {
    folder_.write("two.obj",
                  "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
                  "v 10 0 0\nv 14 0 0\nv 10 4 0\nv 10 0 4\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\n");
    folder_.write("points.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n");
    return scene::load_scene(folder_.write("scene.toml", body));
  }
  std::string fault(const std::string& body) {
    return input_fault([&] { load(body); });
  }
  TemporaryFolder folder_;
};

TEST_F(Parts, AreBodiesWhereTheyAreInTheWhole) {
  const scene::Scene scene = load(
      "body = [{mesh = \"two.obj\", parts = true, scale = 0.5, translation = [0, 0, 1],"
      "         quaternion_wxyz = [1, 0, 0, 1], velocity = [1, 0, 0]},\n"
      "        {mesh = \"two.obj\", parts = true, scale = 0.5, moving = false},\n"
      "        {mesh = \"two.obj\"}]\n");
  ASSERT_EQ(scene.bodies.size(), 5u);
  EXPECT_EQ(scene.shapes.size(), 3u) << "bodies of the same part share it";
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    ASSERT_NE(scene.mesh_of(i), nullptr);
    EXPECT_EQ(scene.mesh_of(i)->triangles.size(), i < 2 ? 4u : 8u);
    // The mesh is in the frame of the hull.
    for (const Vec3d& v : scene.shapes[i].hull->vertices) {
      EXPECT_NE(std::find(scene.mesh_of(i)->vertices.begin(), scene.mesh_of(i)->vertices.end(), v),
                scene.mesh_of(i)->vertices.end());
    }
  }
  EXPECT_EQ(scene.bodies[0].shape, scene.bodies[2].shape);
  // The parts are relative to the centres of their boxes: (0.5, 0.5, 0.5) and (6, 1, 1); rotated,
  // (-y, x, z).
  EXPECT_LT((scene.bodies[0].pose.translation - Vec3d(-0.5, 0.5, 1.5)).norm(), 1e-14);
  EXPECT_LT((scene.bodies[1].pose.translation - Vec3d(-1, 6, 2)).norm(), 1e-14);
  EXPECT_EQ(scene.bodies[3].pose.translation, Vec3d(6, 1, 1));
  EXPECT_EQ(scene.bodies[1].velocity, Vec3d(1, 0, 0));
  EXPECT_FALSE(scene.bodies[3].moving);
  EXPECT_EQ(scene.shapes[1].hull->vertices.front(), Vec3d(-1, -1, -1));
}

TEST_F(Parts, FaultsSayWhere) {
  using testing::HasSubstr;
  EXPECT_THAT(fault("body = [{mesh = \"two.obj\", parts = true, angular_velocity = [1, 0, 0]}]\n"),
              HasSubstr("scene.toml:1: "));
  EXPECT_THAT(fault("body = [\n{mesh = \"points.obj\", parts = true}]\n"),
              testing::AllOf(HasSubstr("scene.toml:2: "), HasSubstr("no triangles")));
  EXPECT_THAT(fault("body = [{shape = {type = \"sphere\", radius = 1}, parts = true}]\n"),
              HasSubstr("parts"));
  EXPECT_THAT(fault("body = [{mesh = \"two.obj\", scale = 1e308}]\n"), HasSubstr("two.obj: "));
}

TEST_F(Parts, MissingFilesSayHowToGetThem) {
  const std::string message = fault("get = \"sh get_them.sh\"\nbody = [\n{mesh = \"none.obj\"}]\n");
  EXPECT_THAT(message,
              testing::AllOf(testing::HasSubstr("scene.toml:3: "), testing::HasSubstr("none.obj"),
                             testing::HasSubstr("To get it: sh get_them.sh")));
  EXPECT_THAT(fault("get = \"elsewhere\"\nimport = \"none.json\"\n"),
              testing::HasSubstr("To get it: elsewhere"));
}

TEST(CgalMeshes, LoadOrSayHowToGetThem) {
  const bool present = std::filesystem::exists(datasets / "local" / "cgal" / "elephant.off");
  try {
    const scene::Scene scene = scene::load_scene(datasets / "cgal_meshes.toml", {.count = 100});
    EXPECT_TRUE(present);
    EXPECT_EQ(scene.bodies.size(), 100u);
    for (const Shape& shape : scene.shapes) {
      EXPECT_FALSE(shape.hull->faces.empty());
      EXPECT_GT(loose_reach(shape, Mat3d::Identity()), 0);
    }
  } catch (const base::InputError& error) {
    EXPECT_FALSE(present) << error.what();
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("libcgal-demo"),
                                             testing::HasSubstr("get_cgal_meshes.sh")));
  }
}

}  // namespace
}  // namespace touchstone
