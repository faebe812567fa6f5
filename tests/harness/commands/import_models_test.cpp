// Tests of touchstone scene import with models, and of models in other commands.
#include "tests/harness/commands/importing.h"
#include "tests/harness/models/model_files.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace model_files;

class ImportModels : public Import {};

// The folder has meshes of our own formats in place of models.
TEST_F(ImportModels, ModelsBecomeScenesAndMeshes) {
  fs::create_directories(folder_.path() / "mine/arm/meshes");
  folder_.write(
      "mine/house.gltf",
      gltf(R"({"name": "a", "mesh": 0, "rotation": [0.1, 0.7, -0.5, 0.5], "scale": [2, 2, 2],
"children": [1]}, {"name": "a", "mesh": 0, "translation": [0.1, 0.2, 0.3], "camera": 0})",
           data_uri(buffer), "0",
           R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])"));
  const std::string house = path("mine/house.gltf");
  EXPECT_EQ(import_alone(house, "2 bodies"), hash_of(house));
  EXPECT_TRUE(fs::exists(path("out0/mine/house.gltf-0.off")));
  EXPECT_FALSE(fs::exists(path("out0/mine/house.gltf")));
  folder_.write("mine/arm/meshes/tip.dae", collada("<unit meter=\"0.01\"/>", collada_node));
  folder_.write("mine/arm/arm.urdf",
                "<robot name=\"arm\"><link name=\"base\"><collision><geometry><mesh "
                "filename='package://arm/meshes/tip.dae'/></geometry></collision></link></robot>");
  const std::string arm = path("mine/arm/arm.urdf");
  EXPECT_EQ(import_alone(arm, "mesh of a model; unit 0.01 m, y up"), hash_of(arm));
  // One scene imports what another has as a mesh.
  folder_.write("mine/inner.toml", "[[body]]\nmesh = \"house.gltf\"\n");
  folder_.write("mine/both.toml",
                "import = [\"inner.toml\", \"house.gltf\", \"arm/arm.urdf\"]\nmeshes = \"hull\"\n");
  const std::string both = path("mine/both.toml");
  EXPECT_EQ(import_alone(both, "model: "), hash_of(both));
  folder_.write("mine/bad.toml", "import = \"house.gltf\"\n[[body]]\nmesh = \"house.gltf\"\n");
  const Ran ran = run_program("scene import " + path("mine/bad.toml") + " --out " + path("bad"));
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, HasSubstr("names this model as a mesh and imports it"));
  EXPECT_FALSE(fs::exists(path("bad")));
}

TEST_F(ImportModels, AModelIsAskedAsASceneAndAsAMesh) {
  folder_.write("two.glb", glb(gltf(R"({"name": "a", "mesh": 0, "children": [1]},
{"name": "b", "mesh": 0, "translation": [0.5, 0, 0]})",
                                    "")));
  const std::string file = path("two.glb");
  EXPECT_THAT(run_program("scene describe " + file).text, HasSubstr("2 bodies"));
  EXPECT_EQ(run_program("scene draw " + file + " --out " + path("two.png")).status, 0);
  EXPECT_THAT(run_program("query " + file + " --bodies 0 1 --task intersect").text,
              HasSubstr("overlapping"));
  folder_.write("points.csv", "x,y,z\n5,0,0\n");
  EXPECT_THAT(run_program("query " + path("points.csv") + " --in " + file + " --with exact").text,
              HasSubstr("3.5"));
  folder_.write("bad.glb", "glTF");
  const Ran ran = run_program("scene describe " + path("bad.glb"));
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, HasSubstr("bad.glb: Assimp cannot read it"));
}

}  // namespace
}  // namespace touchstone
