// What is read of models: transforms, units, axes, and what is left out.
#include "harness/models/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/input_fault.h"
#include "tests/harness/models/model_files.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::models {
namespace {

using namespace model_files;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Model read(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  return read_model(folder.write(name, content));
}

std::string fault_in(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  const auto file = folder.write(name, content);
  return folder.without_path(input_fault([&] { read_model(file); }));
}

const ModelNode& node_of(const Model& model, const std::string& name) {
  for (const ModelNode& node : model.nodes) {
    if (node.name == name) return node;
  }
  throw std::out_of_range(name);
}

void expect_near(const Vec3d& found, const Vec3d& expected) {
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-5)
      << found.transpose() << " instead of " << expected.transpose();
}

Vec3d placed(const Model& model, const std::string& name, const Vec3d& point) {
  const Affine& place = node_of(model, name).to_file;
  return place.linear * point + place.translation;
}

double volume_of(const ModelMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  }
  return volume;
}

// A node that turns by a quarter about z, and in it one that is twice as large.
const std::string nested =
    R"({"name": "outer", "mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0, 0.70710678, 0.70710678], "children": [1]},
{"name": "inner", "mesh": 0, "translation": [0, 1, 0], "scale": [2, 2, 2]})";

TEST(Models, OfGltfHaveNodesWithinNodes) {
  for (const bool is_binary : {false, true}) {
    const Model model =
        is_binary ? read("a.glb", glb(gltf(nested, ""))) : read("a.gltf", gltf(nested));
    EXPECT_EQ(model.metres, 1);
    EXPECT_EQ(model.up(), "y");
    ASSERT_THAT(model.meshes, SizeIs(1));
    EXPECT_THAT(model.meshes[0].vertices, SizeIs(4));
    EXPECT_THAT(model.meshes[0].triangles, SizeIs(4));
    EXPECT_DOUBLE_EQ(volume_of(model.meshes[0]), 1);
    EXPECT_EQ(node_of(model, "inner").meshes, node_of(model, "outer").meshes);
    expect_near(placed(model, "outer", {1, 0, 0}), {1, 3, 3});
    expect_near(placed(model, "inner", {1, 0, 0}), {0, 4, 3});
    EXPECT_THAT(model.left_out.words(), IsEmpty());
  }
}

TEST(Models, OfColladaHaveAUnitAndAnAxis) {
  struct Frame {
    std::string asset, up;
    double metres;
    Vec3d z_up;  // where the point (1, 2, 3) of the file is with z up
  };
  const std::vector<Frame> frames = {
      {"", "y", 1, {1, -3, 2}},
      {"<unit name=\"centimetre\" meter=\"0.01\"/><up_axis>Y_UP</up_axis>", "y", 0.01, {1, -3, 2}},
      {"<unit meter=\"0.0254\"/><up_axis>Z_UP</up_axis>", "z", 0.0254, {1, 2, 3}},
      {"<unit meter=\"1000\"/><up_axis>X_UP</up_axis>", "x", 1000, {-2, -3, 1}}};
  for (const Frame& frame : frames) {
    SCOPED_TRACE(frame.asset);
    const Model model = read("a.dae", collada(frame.asset, collada_node));
    EXPECT_EQ(model.metres, frame.metres);
    EXPECT_EQ(model.up(), frame.up);
    EXPECT_EQ(model.z_up * Vec3d(1, 2, 3), frame.z_up);
    // The axis and the unit are in no node.
    EXPECT_EQ(node_of(model, "one").to_file.translation, Vec3d(1, 2, 3));
    const ModelMesh whole = whole_mesh("a.dae", model);
    EXPECT_THAT(whole.vertices, SizeIs(4));
    EXPECT_EQ(whole.vertices[0], frame.metres * Vec3d(1, 2, 3));
  }
}

TEST(Models, OfFbxAreInCentimetresUnlessTheySay) {
  EXPECT_EQ(read("a.fbx", fbx({}, {})).metres, 0.01);
  EXPECT_EQ(read("a.fbx", fbx({}, {{"UnitScaleFactor", "1"}})).metres, 0.01);
  EXPECT_EQ(read("a.fbx", fbx({}, {{"UnitScaleFactor", "100"}})).metres, 1);
  EXPECT_EQ(read("a.fbx", fbx({}, {{"UnitScaleFactor", "2.54"}})).metres, 0.0254);
}

TEST(Models, OfFbxSayWhichAxesPointWhere) {
  const auto axes = [](int up, int up_sign, int front, int front_sign, int right, int right_sign) {
    return read("a.fbx", fbx({}, {{"UpAxis", std::to_string(up)},
                                  {"UpAxisSign", std::to_string(up_sign)},
                                  {"FrontAxis", std::to_string(front)},
                                  {"FrontAxisSign", std::to_string(front_sign)},
                                  {"CoordAxis", std::to_string(right)},
                                  {"CoordAxisSign", std::to_string(right_sign)}}));
  };
  const Vec3d point(1, 2, 3);
  EXPECT_EQ(read("a.fbx", fbx({}, {})).z_up * point, Vec3d(1, -3, 2));
  EXPECT_EQ(axes(1, 1, 2, 1, 0, 1).z_up * point, Vec3d(1, -3, 2));
  EXPECT_EQ(axes(2, 1, 1, -1, 0, 1).z_up * point, point);
  EXPECT_EQ(axes(1, -1, 2, -1, 0, 1).up(), "-y");
  // Left-handed axes are a mirror.
  EXPECT_EQ(axes(1, 1, 2, -1, 0, 1).z_up.determinant(), -1);
  EXPECT_THAT(input_fault([&] { axes(1, 1, 1, 1, 0, 1); }),
              HasSubstr("the axes in GlobalSettings are not three axes, each once"));
}

// The order of FBX: T * Roff * Rp * Rpre * R * Rpost^-1 * Rp^-1 * Soff * Sp * S * Sp^-1, and a transform of the geometry
// alone, which children do not have.
TEST(Models, OfFbxHavePivotsAndTransformsOfTheirGeometry) {
  const auto at = [](const std::vector<Property>& properties, const Vec3d& point,
                     const std::string& name = "part") {
    return placed(read("a.fbx", fbx(properties, {})), name, point);
  };
  expect_near(
      at({{"Lcl Translation", "1,2,3"}, {"Lcl Rotation", "0,0,90"}, {"Lcl Scaling", "2,2,2"}},
         {1, 0, 0}),
      {1, 4, 3});
  const std::vector<Property> pivots = {{"Lcl Rotation", "0,0,90"},
                                        {"RotationPivot", "1,0,0"},
                                        {"ScalingPivot", "0,1,0"},
                                        {"Lcl Scaling", "1,3,1"}};
  expect_near(at(pivots, {0, 0, 0}), {3, -1, 0});
  expect_near(at(pivots, {1, 0, 0}), {3, 0, 0});
  const std::vector<Property> turns = {{"RotationActive", "1"},
                                       {"PreRotation", "90,0,0"},
                                       {"PostRotation", "0,90,0"},
                                       {"Lcl Rotation", "0,0,90"}};
  expect_near(at(turns, {1, 0, 0}), {0, -1, 0});
  expect_near(at(turns, {0, 1, 0}), {-1, 0, 0});
  const std::vector<Property> geometry = {{"Lcl Translation", "1,2,3"},
                                          {"GeometricTranslation", "0,0,5"},
                                          {"GeometricScaling", "1,1,2"}};
  expect_near(at(geometry, {0, 0, 1}), {1, 2, 10});
  expect_near(at(geometry, {0, 0, 1}, "kid"), {11, 2, 4});
}

TEST(Models, Of3dsHaveZUp) {
  const Model model = read("a.3ds", three_ds());
  EXPECT_EQ(model.metres, 1);
  EXPECT_EQ(model.up(), "z");
  EXPECT_EQ(model.z_up, Mat3d::Identity());
  const ModelMesh whole = whole_mesh("a.3ds", model);
  ASSERT_THAT(whole.vertices, SizeIs(4));
  EXPECT_EQ(whole.vertices[0], Vec3d(1, 2, 3));
  EXPECT_NEAR(volume_of(whole), 1, 1e-6);
}

TEST(Models, AMirrorTurnsTrianglesAndCornersAreJoined) {
  const Model model = read("a.gltf", gltf(R"({"mesh": 0, "scale": [-1, 1, 1], "children": [1]},
{"mesh": 0, "scale": [-2, 1, 1]})"));
  const ModelMesh whole = whole_mesh("a.gltf", model);
  EXPECT_THAT(whole.triangles, SizeIs(8));
  EXPECT_THAT(whole.vertices, SizeIs(5));  // three are those of both
  EXPECT_DOUBLE_EQ(volume_of(whole), 3);
}

TEST(Models, VerticesWithoutTrianglesAreLeftOut) {
  Joiner joiner;
  joiner.add({{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {-0.0, 1, 0}, {0, 1, 0}}, {{1, 2, 3}, {1, 4, 2}}},
             {});
  const ModelMesh mesh = joiner.take();
  EXPECT_THAT(mesh.vertices, SizeIs(3));
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 1}));
  EXPECT_THAT(joiner.take().triangles, IsEmpty());
}

TEST(Models, AreJoinedWhateverTheirNumber) {
  ModelMesh grid;  // each cell has corners of its own
  constexpr std::uint32_t side = 100;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    for (const auto& [x, y] : {std::pair{0U, 0U}, {1U, 0U}, {0U, 1U}}) {
      grid.vertices.emplace_back(i % side + x, i / side + y, 0);
    }
    grid.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Joiner joiner;
  joiner.add(grid, {});
  EXPECT_THAT(joiner.take().vertices, SizeIs((side + 1) * (side + 1) - 1));
}

TEST(Models, SayWhatIsLeftOut) {
  const std::string more =
      R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
"animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
"samplers": [{"input": 2, "output": 3}]}])";
  std::string text =
      gltf(R"({"name": "a", "mesh": 0, "children": [1, 2]}, {"mesh": 1}, {"camera": 0})",
           data_uri(buffer), "0", more);
  const auto insert = [&](const std::string& before, const std::string& what) {
    text.insert(text.find(before), what);
  };
  insert("], \"accessors\"",
         R"(, {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 1},
{"attributes": {"POSITION": 0}, "mode": 0}]})");
  insert("], \"bufferViews\"",
         R"(, {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR"},
{"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"})");
  const Model model = read("a.gltf", text);
  EXPECT_EQ(model.left_out.words(), "6 lines, 4 points, 1 animation, 1 camera");
  EXPECT_THAT(whole_mesh("a.gltf", model).triangles, SizeIs(4));
  EXPECT_EQ(fault_in("a.gltf", gltf(R"({"mesh": 0})", data_uri(buffer), "0", "", "1")),
            "a.gltf: no node has triangles (it has 6 lines); expected some");
}

TEST(Models, SkinnedMeshesAreReadInTheirBindPose) {
  const std::array<float, 16> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const std::array<float, 16> identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::string text =
      gltf(R"({"mesh": 0, "skin": 0, "children": [1]}, {"name": "bone", "translation": [0, 5, 0]})",
           data_uri(buffer + std::string(16, '\0') + bytes_of(weights) + bytes_of(identity)), "0",
           R"(, "skins": [{"joints": [1], "inverseBindMatrices": 4}])");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(R"("byteLength": 72)", R"("byteLength": 216)");
  replace(R"("POSITION": 0)", R"("POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3)");
  replace(R"(], "bufferViews")",
          R"(, {"bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC4"},
{"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC4"},
{"bufferView": 4, "componentType": 5126, "count": 1, "type": "MAT4"}], "bufferViews")");
  replace(R"("byteLength": 24}])",
          R"("byteLength": 24}, {"buffer": 0, "byteOffset": 72, "byteLength": 16},
{"buffer": 0, "byteOffset": 88, "byteLength": 64}, {"buffer": 0, "byteOffset": 152, "byteLength": 64}])");
  testing::internal::CaptureStderr();
  const Model model = read("a.gltf", text);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("a.gltf: warning: 1 skinned mesh, read in the bind pose"));
  EXPECT_DOUBLE_EQ(volume_of(whole_mesh("a.gltf", model)), 1);
}

TEST(Models, WhatAFileNamesAndDoesNotHaveIsSaid) {
  testing::internal::CaptureStderr();
  read("a.dae",
       collada("", collada_node + "<node id=\"two\"><instance_geometry url=\"#gone\"/></node>"));
  EXPECT_THAT(
      testing::internal::GetCapturedStderr(),
      HasSubstr("a.dae: warning: Assimp says: Collada: Unable to find geometry for ID \"gone\""));
}

TEST(Models, AreKnownByTheirEndings) {
  for (const char* name : {"a.glb", "a.GLTF", "b.dae", "c.fbx", "d.3DS"}) {
    EXPECT_TRUE(is_model_file(name)) << name;
  }
  for (const char* name : {"a.obj", "glb", "a.blend", "a.gltf.bin"}) {
    EXPECT_FALSE(is_model_file(name)) << name;
  }
}

// The tetrahedron by draco_encoder, without quantization.
TEST(Models, MeshesThatDracoPackedAreRead) {
  const std::string packed =
      "RFJBQ08CAgEBAAAABAQAAwAAAS8BARAB/"
      "wAAAQAJAwAAAAAAAAAAAAAAAABAQAAAAAAAAABAAAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAA==";
  const Model model =
      read("a.gltf",
           R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"],
"extensionsUsed": ["KHR_draco_mesh_compression"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions": {"KHR_draco_mesh_compression":
{"bufferView": 0, "attributes": {"POSITION": 0}}}}]}], "accessors": [{"componentType": 5126, "count": 4, "type": "VEC3"},
{"componentType": 5123, "count": 12, "type": "SCALAR"}], "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 82}],
"buffers": [{"byteLength": 82, "uri": "data:application/octet-stream;base64,)" +
               packed + "\"}]}");
  EXPECT_NEAR(volume_of(whole_mesh("a.gltf", model)), 1, 1e-6);
}

TEST(Models, AnExtensionThatChangesTheMeshIsRefused) {
  EXPECT_EQ(
      fault_in("a.gltf", gltf(R"({"mesh": 0})", data_uri(buffer), "0",
                              R"(, "extensionsRequired": ["EXT_meshopt_compression"])")),
      "a.gltf: Assimp cannot read it: the file needs the extension EXT_meshopt_compression of "
      "glTF, which is not read");
  EXPECT_THAT(fault_in("a.glb", glb(gltf(R"({"mesh": 0})", "", "0",
                                         R"(, "extensionsUsed": ["EXT_mesh_gpu_instancing"])"))),
              HasSubstr("needs the extension EXT_mesh_gpu_instancing"));
  EXPECT_EQ(fault_in("a.gltf", gltf(R"({"mesh": 0})", data_uri(buffer), "0",
                                    R"(, "extensionsRequired": ["KHR_materials_unlit"],
"extensionsUsed": ["KHR_materials_unlit"])")),
            "");
  // Assimp would take these for floats.
  std::string text = gltf(R"({"mesh": 0})");
  text.replace(text.find("5126"), 4, "5122");
  EXPECT_THAT(fault_in("a.gltf", text), HasSubstr("needs the extension KHR_mesh_quantization"));
}

}  // namespace
}  // namespace touchstone::models
