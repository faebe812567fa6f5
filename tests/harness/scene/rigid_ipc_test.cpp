#include "harness/scene/rigid_ipc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "harness/base/error.h"
#include "harness/geometry/mesh_solid.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

// A box from (0, 0, 0) to (2, 4, 6), with its origin at a corner.
const char* const block_obj = R"(v 0 0 0
v 2 0 0
v 0 4 0
v 2 4 0
v 0 0 6
v 2 0 6
v 0 4 6
v 2 4 6
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
)";

class RigidIpc : public testing::Test {
 protected:
  RigidIpc() {
    fs::create_directories(folder_.path() / "fixtures" / "deep");
    fs::create_directories(folder_.path() / "meshes");
    std::ofstream(folder_.path() / "meshes" / "block.obj") << block_obj;
    std::ofstream pair(folder_.path() / "meshes" / "pair.obj");
    for (int x : {0, 10}) {
      for (int i = 0; i < 4; ++i)
        pair << "v " << x + (i == 1) << ' ' << (i == 2) << ' ' << (i == 3) << '\n';
    }
    for (int at : {1, 5}) {
      for (const char* f : {"021", "013", "123", "203"}) {
        pair << "f " << at + f[0] - '0' << ' ' << at + f[1] - '0' << ' ' << at + f[2] - '0' << '\n';
      }
    }
  }

  scene::Scene import(const std::string& json) {
    const fs::path file = folder_.path() / "fixtures" / "deep" / "made up.json";
    std::ofstream(file) << json;
    return scene::import_rigid_ipc(file);
  }
  scene::Scene import_bodies(const std::string& bodies, const std::string& top = "") {
    return import("{\"scene_type\": \"distance_barrier_rb_problem\"," + top +
                  "\"rigid_body_problem\": {\"gravity\": [0, -9.8, 0], \"rigid_bodies\": [" +
                  bodies + "]}}");
  }
  std::string error(const std::string& json) {
    return input_fault([&] { import(json); });
  }
  std::string body_error(const std::string& body) {
    return error("{\"rigid_body_problem\": {\"rigid_bodies\": [" + body + "]}}");
  }

  TemporaryFolder folder_;
};

// The world's box of a body.
std::pair<Vec3d, Vec3d> extent(const scene::Scene& scene, std::size_t body) {
  const scene::Body& b = scene.bodies[body];
  Vec3d low = Vec3d::Constant(1e300), high = -low;
  for (const Vec3d& v : scene.shapes[b.shape].hull->vertices) {
    low = low.cwiseMin(b.pose(v));
    high = high.cwiseMax(b.pose(v));
  }
  return {low, high};
}

void expect_near(const Vec3d& a, const Vec3d& b) {
  EXPECT_LT((a - b).norm(), 1e-14) << a.transpose() << " and " << b.transpose();
}

TEST_F(RigidIpc, PlacesMeshesAboutTheModelsOrigin) {
  const scene::Scene scene = import_bodies(R"(
      {"mesh": "block.obj", "position": [10, 0, 0]},
      {"mesh": "block.obj", "rotation": [90, 0, 0]},
      {"mesh": "block.obj", "rotation": [90, 0, 90], "position": [0, 0, 1]},
      {"mesh": "block.obj", "rotation": [0, 90, 0], "scale": 0.5},
      {"mesh": "block.obj", "scale": [1, 2, 3]},
      {"mesh": "block.obj", "scale": 7, "dimensions": [1, 1, 1]})");
  EXPECT_EQ(scene.name, "made up");
  ASSERT_EQ(scene.bodies.size(), 6u);
  EXPECT_EQ(scene.shapes.size(), 4u);
  EXPECT_EQ(scene.bodies[0].shape, scene.bodies[2].shape);
  const auto expect_extent = [&](std::size_t body, const Vec3d& low, const Vec3d& high) {
    SCOPED_TRACE(body);
    expect_near(extent(scene, body).first, low);
    expect_near(extent(scene, body).second, high);
  };
  expect_extent(0, {10, 0, 0}, {12, 4, 6});
  expect_near(scene.bodies[0].pose.translation, {11, 2, 3});  // the centre of mass
  expect_extent(1, {0, -6, 0}, {2, 0, 4});                    // y -> z, z -> -y
  expect_extent(2, {0, 0, 1}, {6, 2, 5});                     // then x -> y, y -> -x
  expect_extent(3, {0, 0, -1}, {3, 2, 0});                    // z -> x, x -> -z
  expect_extent(4, {0, 0, 0}, {2, 8, 18});
  expect_extent(5, {0, 0, 0}, {1, 1, 1});
}

TEST_F(RigidIpc, VelocitiesAndFrames) {
  const std::string body = R"({"mesh": "block.obj", "linear_velocity": [1, 2, 3],
      "angular_velocity": [180, 360, 0] )";
  scene::Scene scene = import_bodies(
      body + "}," + body + R"(, "is_dof_fixed": [true, false, false, false, true, false]},)" +
          body + R"(, "type": "static"},)" + body +
          R"(, "is_dof_fixed": true, "type": "kinematic"},)" +
          R"({"mesh": "block.obj", "type": "dynamic", "#type": "static", "density": 3},)" + body +
          R"(, "enabled": false})",
      R"("timestep": 0.25, "max_time": 2.1,)");
  ASSERT_EQ(scene.bodies.size(), 5u);
  EXPECT_EQ(scene.bodies[0].velocity, Vec3d(1, 2, 3));
  expect_near(scene.bodies[0].angular_velocity, Vec3d(1, 2, 0) * std::numbers::pi);
  EXPECT_EQ(scene.bodies[1].velocity, Vec3d(0, 2, 3));
  EXPECT_EQ(scene.bodies[1].angular_velocity.y(), 0);
  std::vector<bool> moving;
  for (const scene::Body& b : scene.bodies) moving.push_back(b.moving);
  EXPECT_EQ(moving, (std::vector<bool>{true, true, false, false, true}));
  EXPECT_EQ(scene.motion.time_step, 0.25);
  EXPECT_EQ(scene.frames, 10);  // nine steps

  EXPECT_EQ(import_bodies(body + "}", "\"max_time\": 50,").frames, 100);
  EXPECT_EQ(import_bodies(body + "}", "\"max_iterations\": 7,").frames, 8);
  EXPECT_EQ(import_bodies(body + "}").frames, 1);
  EXPECT_EQ(import_bodies(R"({"mesh": "block.obj"})", "\"max_time\": 50,").frames, 1);
  EXPECT_EQ(import_bodies(body + R"(, "type": "kinematic", "kinematic_max_time": 0.035})",
                          "\"max_time\": 50,")
                .frames,
            4);
}

TEST_F(RigidIpc, SplitsAMeshIntoItsParts) {
  const scene::Scene whole = import_bodies(R"({"mesh": "pair.obj"})");
  ASSERT_EQ(whole.bodies.size(), 1u);
  expect_near(whole.bodies[0].pose.translation, {5.25, 0.25, 0.25});
  const scene::Scene scene =
      import_bodies(R"({"mesh": "pair.obj", "split_components": true, "rotation": [0, 0, 90]})");
  ASSERT_EQ(scene.bodies.size(), 2u);
  expect_near(scene.bodies[0].pose.translation, {-0.25, 0.25, 0.25});
  expect_near(scene.bodies[1].pose.translation, {-0.25, 10.25, 0.25});
}

TEST_F(RigidIpc, ReadsVerticesInTheFile) {
  const scene::Scene scene = import_bodies(
      R"({"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,2,1],[0,1,3],[1,2,3],[2,0,3]],
          "edges": []})");
  EXPECT_EQ(scene.shapes[0].hull->faces.size(), 4u);
  expect_near(scene.bodies[0].pose.translation, Vec3d::Constant(0.25));
}

TEST_F(RigidIpc, ErrorsSayWhere) {
  using testing::HasSubstr;
  EXPECT_THAT(error("{\n\"a\": 1,\n}"), HasSubstr("made up.json:3: malformed JSON"));
  EXPECT_THAT(error("{\"timestep\": 1e999}"), HasSubstr("malformed JSON"));
  EXPECT_THAT(error("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(error("{}"), HasSubstr("rigid_body_problem"));
  EXPECT_THAT(error("{\"rigid_body_problem\": {}}"), HasSubstr("rigid_bodies"));
  EXPECT_THAT(body_error(""), HasSubstr("at least one"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj"}, {"mesh": "none.obj"})"),
              HasSubstr("body 1: mesh 'none.obj' not found"));
  EXPECT_THAT(body_error(R"({})"), HasSubstr("body 0: expected 'mesh'"));
  EXPECT_THAT(body_error(R"({"mesh": 3})"), HasSubstr("'mesh': expected a text"));
  EXPECT_THAT(body_error(R"({"vertices": [[0, 1]]})"), HasSubstr("three-dimensional"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj", "position": [0, 1]})"),
              HasSubstr("three-dimensional"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj", "rotation": 30})"), HasSubstr("three numbers"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj", "position": [0, 1, "2"]})"),
              HasSubstr("three numbers"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj", "scale": 1e308})"), HasSubstr("not finite"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj", "type": "soft"})"), HasSubstr("'soft'"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj", "is_dof_fixed": [true]})"), HasSubstr("six"));
  EXPECT_THAT(body_error(R"({"mesh": "block.obj", "kinematic_poses": []})"),
              HasSubstr("kinematic_poses"));
  EXPECT_THAT(body_error(R"({"vertices": [[0,0,0]], "faces": [[0,0,1]]})"), HasSubstr("in range"));
  EXPECT_THROW(scene::import_rigid_ipc(folder_.path()), base::InputError);
  EXPECT_THROW(scene::import_rigid_ipc(folder_.path() / "none.json"), base::InputError);
}

TEST(MeshMass, CentreOfSolidSurfaceAndPoints) {
  geometry::Mesh mesh;
  mesh.vertices = {{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1, 1, 3}};
  expect_near(geometry::centre_of_mass(mesh), Vec3d::Constant(1.5));
  mesh.triangles = {{0, 1, 2}};
  expect_near(geometry::centre_of_mass(mesh), {5.0 / 3, 5.0 / 3, 1});
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  expect_near(geometry::centre_of_mass(mesh), Vec3d::Constant(1.5));
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);  // inside out
  expect_near(geometry::centre_of_mass(mesh), Vec3d::Constant(1.5));
}

// Every scene of the project's own folder loads, or says why not.
TEST(RigidIpcFolder, EveryScene) {
  const char* shared = std::getenv("TOUCHSTONE_SHARED");
  if (shared == nullptr) GTEST_SKIP() << "TOUCHSTONE_SHARED is not set";
  const fs::path folder = fs::path(shared) / "datasets" / "rigid-ipc" / "fixtures";
  if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
  int loaded = 0;
  std::vector<std::string> refused;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    try {
      const scene::Scene scene = scene::import_rigid_ipc(entry.path());
      ++loaded;
      EXPECT_GE(scene.frames, 1);
      for (const scene::Body& body : scene.bodies) {
        EXPECT_TRUE(body.pose.rotation.isUnitary(1e-12));
        EXPECT_TRUE(body.pose.translation.allFinite());
      }
      for (const Shape& shape : scene.shapes) {
        EXPECT_TRUE(shape.hull->dimension < 3 || !shape.hull->faces.empty()) << entry.path();
      }
      if (entry.path().filename() == "chain-net-32x32.json") {
        EXPECT_EQ(scene.bodies.size(), 2880u);
      }
      if (entry.path().filename() == "card-tent.json") {  // two cards that stand on a plane
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
          EXPECT_LT(extent(scene, i).first.y(), 1);
        }
      }
    } catch (const base::InputError& e) {
      refused.push_back(e.what());
    }
  }
  EXPECT_GE(loaded, 109);
  EXPECT_THAT(refused,
              testing::UnorderedElementsAre(testing::HasSubstr("Locking Bolt.stl' not found"),
                                            testing::HasSubstr("kinematic_poses")));
}

}  // namespace
}  // namespace touchstone
