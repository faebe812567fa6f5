// Height fields in scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/scene/scene.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class HeightFields : public ::testing::Test {
 protected:
  // The scene of a height field with these keys.
  scene::Scene load(const std::string& keys) const {
    return scene::load_scene(folder.write(
        "scene.toml", "[[body]]\nmoving = false\n[body.shape]\ntype = \"height_field\"\n" + keys));
  }
  std::string fault(const std::string& keys) const {
    return input_fault([&] { load(keys); });
  }

  TemporaryFolder folder;
};

constexpr const char* rows = "heights = [[0, 1, 2],\n[3, 4, 5]]\n";

TEST_F(HeightFields, HaveTheirFirstRowAtTheGreatestY) {
  const scene::Scene scene = load(std::string(rows) + "cell_size = [2, 4]\nheight_scale = 0.5\n");
  ASSERT_NE(scene.concave_of(0), nullptr);
  const TriangleMesh& mesh = *scene.concave_of(0)->mesh;
  EXPECT_FALSE(mesh.solid);
  EXPECT_THAT(mesh.vertices, ElementsAre(Vec3d(-2, -2, 1.5), Vec3d(0, -2, 2), Vec3d(2, -2, 2.5),
                                         Vec3d(-2, 2, 0), Vec3d(0, 2, 0.5), Vec3d(2, 2, 1)));
  // Each cell is split from its least corner to its greatest, and looks up.
  using Triangle = std::array<std::uint32_t, 3>;
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 4}, Triangle{0, 4, 3}, Triangle{1, 2, 5},
                                          Triangle{1, 5, 4}));
  // All lengths times the scale of a mesh.
  EXPECT_EQ(load(std::string(rows) + "cell_size = 1\nscale = 2\n").concave_of(0)->mesh->vertices[5],
            Vec3d(2, 1, 4));
}

TEST_F(HeightFields, ComeFromFiles) {
  folder.write("a.csv", "0,1,2\n3,4,5\n");
  folder.write("a.asc", "ncols 3\nnrows 2\ncellsize 0.5\n0 1 2\n3 4 5\n");
  const auto vertices = [&](const std::string& keys) {
    return load(keys).concave_of(0)->mesh->vertices;
  };
  const auto given = vertices(std::string(rows) + "cell_size = 0.5\n");
  EXPECT_EQ(vertices("file = \"a.csv\"\ncell_size = 0.5\n"), given);
  EXPECT_EQ(vertices("file = \"a.asc\"\n"), given);
  EXPECT_NE(vertices("file = \"a.asc\"\ncell_size = 1\n"), given);
}

TEST_F(HeightFields, AreWrittenAsTheirTriangles) {
  const scene::Scene scene = load(std::string(rows) + "cell_size = 0.1\nheight_scale = 0.3\n");
  SceneBody body;
  body.body = *scene.concave_of(0);
  body.pose.translation = {1, 2, 3};
  scene::write_scene(folder.path() / "again.toml", {&body, 1});
  const scene::Scene again = scene::load_scene(folder.path() / "again.toml");
  EXPECT_EQ(again.concave_of(0)->mesh->vertices, body.body.mesh->vertices);
  EXPECT_EQ(again.concave_of(0)->mesh->triangles, body.body.mesh->triangles);
  EXPECT_EQ(again.bodies[0].pose.translation, body.pose.translation);
}

TEST_F(HeightFields, FaultsAreNamedWithTheirPlace) {
  EXPECT_THAT(fault("heights = [[0, 1],\n[0, 1, 2]]\ncell_size = 1\n"),
              AllOf(HasSubstr("scene.toml:6"), HasSubstr("row 2 is an array of 3")));
  EXPECT_THAT(fault("heights = [[0, 1],\n[0, nan]]\ncell_size = 1\n"),
              AllOf(HasSubstr("scene.toml:6"), HasSubstr("expected a finite number")));
  EXPECT_THAT(fault("heights = [[0, 1]]\ncell_size = 1\n"),
              AllOf(HasSubstr("scene.toml:5"), HasSubstr("1 x 2 heights; expected at least 2")));
  EXPECT_THAT(fault("heights = [0, 1]\ncell_size = 1\n"), HasSubstr("row 1 is 0"));
  EXPECT_THAT(fault("heights = 7\ncell_size = 1\n"), HasSubstr("row 1 is 7"));
  EXPECT_THAT(fault(rows), HasSubstr("cell_size"));
  EXPECT_THAT(fault(std::string(rows) + "cell_size = 0\n"), HasSubstr("cell_size"));
  EXPECT_THAT(fault(std::string(rows) + "cell_size = [1, 2, 3]\n"),
              HasSubstr("expected an array of 2 numbers"));
  EXPECT_THAT(fault("cell_size = 1\n"), HasSubstr("heights"));
  EXPECT_THAT(fault(std::string(rows) + "file = \"a.csv\"\ncell_size = 1\n"),
              HasSubstr("given beside heights"));
  EXPECT_THAT(fault("file = \"none.png\"\ncell_size = 1\n"),
              AllOf(HasSubstr("scene.toml:5"), HasSubstr("no file"), HasSubstr("none.png")));
  folder.write("ragged.csv", "1,2\n3\n");
  EXPECT_THAT(fault("file = \"ragged.csv\"\ncell_size = 1\n"), HasSubstr("ragged.csv:2"));
  EXPECT_THAT(fault(std::string(rows) + "cell_size = 1\nas = \"solid\"\n"),
              HasSubstr("the surface is open"));
}

}  // namespace
}  // namespace touchstone
