// Tests of models as scenes: poses, shapes that instances share, names, and models in place of meshes.
#include "harness/scene/model_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "algorithms/core/bounds.h"
#include "harness/geometry/mesh_solid.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/models/model_files.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::scene {
namespace {

using namespace model_files;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class ModelScenes : public testing::Test {
 protected:
  Scene load(const std::string& name, const std::string& content) const {
    return load_scene(folder_.write(name, content));
  }
  Scene of_gltf(const std::string& nodes, const std::string& roots = "0") const {
    return load("a.gltf", gltf(nodes, data_uri(buffer), roots));
  }
  // The least and the greatest corner of a body, from its mesh.
  static std::pair<Vec3d, Vec3d> box_of(const Scene& scene, std::size_t body) {
    const Body& placed = scene.bodies[body];
    Vec3d low = Vec3d::Constant(1e300), high = -low;
    for (const Vec3d& v : scene.mesh_of(placed.shape)->vertices) {
      const Vec3d at = placed.pose.rotation * v + placed.pose.translation;
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    return {low, high};
  }
  static void expect_box(const Scene& scene, std::size_t body, const Vec3d& low,
                         const Vec3d& high) {
    const auto [a, b] = box_of(scene, body);
    EXPECT_LT((a - low).norm() + (b - high).norm(), 1e-5)
        << a.transpose() << " to " << b.transpose();
  }
  static double volume_of(const geometry::Mesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
    }
    return volume;
  }

  TemporaryFolder folder_;
};

TEST_F(ModelScenes, NodesAreBodiesWithZUp) {
  const Scene scene =
      of_gltf(R"({"name": "table", "mesh": 0, "translation": [10, 1, 2], "children": [1]},
{"name": "cup", "mesh": 0, "translation": [0, 5, 0]})");
  EXPECT_EQ(scene.name, "a");
  EXPECT_THAT(scene.names, ElementsAre("table", "cup"));
  EXPECT_THAT(scene.shapes, SizeIs(1));
  EXPECT_EQ(scene.frames, 1);
  // (x, y, z) of the file is (x, -z, y).
  EXPECT_EQ(scene.bodies[0].pose.translation, Vec3d(10, -2, 1));
  EXPECT_EQ(scene.bodies[1].pose.translation, Vec3d(10, -2, 6));
  expect_box(scene, 0, {10, -5, 1}, {11, -2, 3});
  EXPECT_EQ(scene.mesh_of(0)->vertices[1], Vec3d(0, 2, 0));  // in the frame of its node
}

TEST_F(ModelScenes, ScaleGoesToTheVerticesAndIsShared) {
  const std::string turned = R"("rotation": [0.1, 0.7, -0.5, 0.5])";
  const Scene scene = of_gltf(
      R"({"children": [1, 2, 3, 4, 5, 6]}, {"mesh": 0}, {"mesh": 0, )" + turned +
      R"(}, {"mesh": 0, "scale": [2, 3, 4]}, {"mesh": 0, "scale": [2, 3, 4], )" + turned +
      R"(}, {"mesh": 0, "scale": [-2, 3, 4]}, {"mesh": 0, "scale": [2, 3, -4], )" + turned + "}");
  EXPECT_THAT(scene.shapes, SizeIs(3));
  std::vector<std::uint32_t> shapes;
  for (const Body& body : scene.bodies) shapes.push_back(body.shape);
  EXPECT_THAT(shapes, ElementsAre(0, 0, 1, 1, 2, 2));  // of both mirrors one
  EXPECT_EQ(volume_of(*scene.mesh_of(0)), 1);
  EXPECT_NEAR(volume_of(*scene.mesh_of(1)), 24, 1e-4);
  EXPECT_NEAR(volume_of(*scene.mesh_of(2)), 24, 1e-4);
  expect_box(scene, 2, {0, -12, 0}, {2, 0, 6});
  expect_box(scene, 4, {-2, -12, 0}, {0, 0, 6});
  for (const Body& body : scene.bodies) {
    EXPECT_LT((body.pose.rotation.transpose() * body.pose.rotation - Mat3d::Identity()).norm(),
              1e-14);
    EXPECT_GT(body.pose.rotation.determinant(), 0);
  }
}

// Random chains of turns and scales: each vertex is where the product of the file's matrices takes it.
TEST_F(ModelScenes, PosesAndVerticesAreTheProductOfTheMatrices) {
  std::mt19937_64 random(7);
  const auto number = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
  int sheared = 0, shared = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const bool scales = trial % 2 == 0;
    std::string nodes;
    Eigen::Affine3d place = Eigen::Affine3d::Identity();
    place.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    std::vector<Eigen::Affine3d> places;
    for (int depth = 0; depth < 4; ++depth) {
      const Eigen::Quaterniond q =
          Eigen::Quaterniond(number(), number(), number(), number()).normalized();
      const Vec3d t(number(), number(), number());
      const Vec3d s =
          scales ? Vec3d(1.5 + number(), 1.5 + number(), number() < 0 ? -1 : 2) : Vec3d::Ones();
      nodes += fmt::format(
          "{}{{\"mesh\": 0, \"translation\": [{}, {}, {}], \"rotation\": [{}, {}, {}, {}], "
          "\"scale\": "
          "[{}, {}, {}]{}}}",
          depth > 0 ? "," : "", t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(), s.x(), s.y(),
          s.z(), depth < 3 ? fmt::format(", \"children\": [{}]", depth + 1) : "");
      place = place * Eigen::Translation3d(t) * q * Eigen::Scaling(s);
      places.push_back(place);
    }
    const Scene scene = of_gltf(nodes);
    (scales ? sheared : shared) += scene.shapes.size() == (scales ? 4U : 1U) ? 1 : 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Body& body = scene.bodies[i];
      const auto& vertices = scene.mesh_of(body.shape)->vertices;
      ASSERT_THAT(vertices, SizeIs(4));
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3d expected =
            places[i] * Vec3d(points[3 * k], points[3 * k + 1], points[3 * k + 2]);
        // The order of vertices is that of the triangles' corners: 0, 2, 1, 3.
        const Vec3d at = body.pose.rotation * vertices[k == 1   ? 2
                                                       : k == 2 ? 1
                                                                : k] +
                         body.pose.translation;
        EXPECT_LT((at - expected).norm(), 1e-4) << trial << " " << i << " " << k;
      }
      EXPECT_GT(volume_of(*scene.mesh_of(body.shape)), 0);
    }
  }
  EXPECT_EQ(sheared, 6);
  EXPECT_EQ(shared, 6);
}

TEST_F(ModelScenes, FlatAndEmptyScalesAreBodies) {
  const Scene scene = of_gltf(R"({"children": [1, 2, 3]}, {"mesh": 0, "scale": [1, 0, 1]},
{"mesh": 0, "scale": [0, 0, 0]}, {"mesh": 0, "scale": [0, 1, 1], "rotation": [0.5, 0.5, 0.5, 0.5]})");
  ASSERT_THAT(scene.bodies, SizeIs(3));
  expect_box(scene, 0, {0, -3, 0}, {1, 0, 0});
  expect_box(scene, 1, {0, 0, 0}, {0, 0, 0});
  for (const Body& body : scene.bodies) EXPECT_NEAR(body.pose.rotation.determinant(), 1, 1e-12);
}

TEST_F(ModelScenes, UnitsAreMetresAndAxesAreTurned) {
  const Scene inch =
      load("a.dae", collada("<unit meter=\"0.0254\"/><up_axis>Z_UP</up_axis>", collada_node));
  EXPECT_EQ(inch.bodies[0].pose.translation, Vec3d(0.0254 * 1, 0.0254 * 2, 0.0254 * 3));
  EXPECT_EQ(inch.bodies[0].pose.rotation, Mat3d::Identity());
  EXPECT_EQ(inch.mesh_of(0)->vertices[2], Vec3d(0.0254, 0, 0));
  expect_box(load("a.dae", collada("<up_axis>X_UP</up_axis>", collada_node)), 0, {-4, -6, 1},
             {-2, -3, 2});
  // A unit of centimetres and a scale of 100 are no scale.
  const Scene metres =
      load("a.fbx", fbx({{"Lcl Scaling", "100,100,100"}, {"Lcl Translation", "100,0,0"}}, {}));
  EXPECT_THAT(metres.names, ElementsAre("part", "kid"));
  EXPECT_THAT(metres.shapes, SizeIs(1));
  EXPECT_EQ(metres.mesh_of(0)->vertices[2], Vec3d(1, 0, 0));
  expect_box(metres, 0, {1, -3, 0}, {2, 0, 2});
  expect_box(metres, 1, {11, -3, 0}, {12, 0, 2});
  // Left-handed axes: a mirror, whose triangles are turned.
  const Scene left = load("a.fbx", fbx({{"Lcl Scaling", "100,100,100"}}, {{"UpAxis", "1"},
                                                                          {"UpAxisSign", "1"},
                                                                          {"FrontAxis", "2"},
                                                                          {"FrontAxisSign", "-1"},
                                                                          {"CoordAxis", "0"},
                                                                          {"CoordAxisSign", "1"}}));
  expect_box(left, 0, {0, 0, 0}, {1, 3, 2});
  EXPECT_NEAR(volume_of(*left.mesh_of(0)), 1, 1e-6);
  expect_box(load("a.3ds", three_ds()), 0, {1, 2, 3}, {2, 4, 6});
}

TEST_F(ModelScenes, NamesAreMadeUniqueAndUtf8) {
  const Scene scene =
      of_gltf(R"({"children": [1, 2, 3, 4, 5]}, {"name": "a", "mesh": 0}, {"name": "a", "mesh": 0},
{"name": "a-2", "mesh": 0}, {"name": "Türe \"1\"", "mesh": 0}, {"name": "a", "mesh": 0})");
  EXPECT_THAT(scene.names, ElementsAre("a", "a-2", "a-2-2", "Türe \"1\"", "a-3"));
  const auto file = folder_.write("x.toml", "import = \"a.gltf\"\nignore = [[\"a\", \"a-3\"]]\n");
  EXPECT_THAT(load_scene(file).filter.ignored, SizeIs(1));
}

TEST_F(ModelScenes, AreImportedBesideOthers) {
  folder_.write("a.gltf", gltf(R"({"name": "part", "mesh": 0})"));
  folder_.write(
      "b.toml",
      "import = [\"a.gltf\", \"a.gltf\"]\nmeshes = \"hull\"\nmoving = false\n[[body]]\nname = "
      "\"ball\"\nshape = {type = \"sphere\", radius = 1}\n");
  const Scene scene = load_scene(folder_.path() / "b.toml");
  EXPECT_THAT(scene.names, ElementsAre("part", "part", "ball"));
  EXPECT_EQ(scene.concave_of(0), nullptr);
  EXPECT_FALSE(scene.bodies[0].moving);
  EXPECT_EQ(scene.files[0], folder_.path() / "a.gltf");
  folder_.write("c.toml", "import = \"a.gltf\"\nmeshes = \"solid\"\n");
  EXPECT_TRUE(load_scene(folder_.path() / "c.toml").concave_of(0)->mesh->solid);
}

TEST_F(ModelScenes, AMeshIsAllTrianglesInTheFramesOfTheFile) {
  folder_.write("tet.obj", obj);
  folder_.write("tet.glb", glb(gltf(R"({"mesh": 0})", "")));
  folder_.write("tet.dae", collada("<unit meter=\"0.5\"/><up_axis>Z_UP</up_axis>",
                                   "<node id=\"n\"><instance_geometry url=\"#t\"/></node>"));
  const auto scene_of = [&](const std::string& mesh) {
    return load("m.toml",
                "[[body]]\nmesh = \"" + mesh + "\"\nas = \"solid\"\ntranslation = [7, 8, 9]\n");
  };
  const Scene expected = scene_of("tet.obj");
  for (const std::string mesh : {"tet.glb", "tet.dae\"\nscale = 2 #"}) {
    const Scene scene = scene_of(mesh);
    const Aabb box = tight_box(scene.shapes[0], scene.bodies[0].pose);
    const Aabb other = tight_box(expected.shapes[0], expected.bodies[0].pose);
    EXPECT_EQ(box.min, other.min) << mesh;
    EXPECT_EQ(box.max, other.max) << mesh;
    EXPECT_EQ(volume_of(*scene.mesh_of(0)), 1) << mesh;
  }
}

// As RViz reads them: in metres, and not turned.
TEST_F(ModelScenes, RobotsTakeModelsForMeshes) {
  folder_.write("link.dae",
                collada("<unit meter=\"0.001\"/><up_axis>Y_UP</up_axis>", collada_node));
  const Scene scene = load(
      "r.urdf",
      "<robot name=\"r\"><link name=\"base\"><collision><geometry><mesh "
      "filename=\"link.dae\" scale=\"1000 1000 -1000\"/></geometry></collision></link></robot>");
  expect_box(scene, 0, {1, 2, -6}, {2, 4, -3});
  EXPECT_NEAR(volume_of(*scene.mesh_of(0)), 1, 1e-9);
}

TEST_F(ModelScenes, WhatIsWrittenIsTheSameScene) {
  const Scene scene = of_gltf(
      R"({"name": "Tür\u0007 \"x\"", "mesh": 0, "rotation": [0.1, 0.7, -0.5, 0.5], "scale": [0.3, 0.1, -7], "children": [1, 2]},
{"mesh": 0, "translation": [0.1, -0.0, 1e-9]}, {"mesh": 0})");
  const PlacedModel model = place_model(folder_.path() / "a.gltf");
  EXPECT_EQ(model.words, "model: 3 bodies, 1 shape; metres, y up, turned to z up");
  const auto written = write_model(model, folder_.path() / "copy.toml");
  EXPECT_THAT(written, SizeIs(2));
  const Scene copy = load_scene(folder_.path() / "copy.toml");
  EXPECT_EQ(scene_hash(copy), scene_hash(scene));
  EXPECT_EQ(copy.names, scene.names);
}

TEST_F(ModelScenes, FaultsNameTheModel) {
  folder_.write("a.gltf", "{");
  folder_.write("m.toml", "import = \"a.gltf\"\n");
  folder_.write("n.toml", "[[body]]\nmesh = \"a.gltf\"\n");
  for (const char* name : {"a.gltf", "m.toml", "n.toml"}) {
    EXPECT_THAT(input_fault([&] { load_scene(folder_.path() / name); }),
                HasSubstr("a.gltf: Assimp cannot read it"));
  }
  EXPECT_THAT(input_fault([&] {
                load("h.gltf",
                     gltf(R"({"mesh": 0, "translation": [3e38, 0, 0], "scale": [3e38, 1, 1],
"children": [1]}, {"mesh": 0, "scale": [3e38, 1, 1]})"));
              }),
              HasSubstr("h.gltf: "));
}

}  // namespace
}  // namespace touchstone::scene
