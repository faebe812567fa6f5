// Tests of the exact answers of scenes.
#include "harness/trade/pipeline/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/algorithms/narrow_phase/bodies.h"
#include "tests/harness/trade/trade_scenes.h"

namespace touchstone {
namespace {

using testing::DoubleNear;
using testing::Optional;

TEST(TradeTruth, SamplesEveryFrameOnceAndSpreadsThem) {
  const std::vector<std::size_t> order = trade::sampling_order(65);
  EXPECT_EQ(order[0], 0u);
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), 65u);
  // After frame 0, the first frames lie one in each quarter.
  const std::set<std::size_t> first(order.begin() + 1, order.begin() + 5);
  std::size_t quarter = 0;
  for (const std::size_t frame : first) EXPECT_EQ((frame - 1) / 16, quarter++);
  EXPECT_EQ(trade::sampling_order(1), std::vector<std::size_t>{0});
}

// Returns the surface of a box, as triangles.
geometry::Mesh mesh_of_box(const Vec3d& half) {
  geometry::Mesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d at = half;
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 0) at[axis] = -at[axis];
    }
    mesh.vertices.push_back(at);
  }
  const std::array<std::array<std::uint32_t, 4>, 6> faces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

TEST(TradeTruth, AMeshIsASolidAndAnswersAsTheBoxThatItIs) {
  const scene::Scene scene = scene_of(
      "generator = \"uniform\"\ncount = 60\noverlaps = 8\nframes = 3\n"
      "shapes = [\"box\", \"sphere\"]\nsize = [0.2, 3]\n");
  trade::SceneFrames convex(scene, 3);
  trade::SceneFrames meshes(scene, 3);
  std::vector<std::unique_ptr<geometry::Mesh>> kept;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (scene.shapes[i].kind != ShapeKind::box) continue;
    kept.push_back(std::make_unique<geometry::Mesh>(mesh_of_box(scene.shapes[i].half_extents)));
    meshes.mesh_of[i] = kept.back().get();
  }
  const std::vector<std::size_t> wanted = {0, 1, 2};
  const auto expected = trade::find_truth(convex, wanted, 100, 1);
  const auto found = trade::find_truth(meshes, wanted, 100, 1);
  ASSERT_EQ(found.size(), 3u);
  std::size_t contacts = 0, apart = 0;
  for (std::size_t frame = 0; frame < 3; ++frame) {
    ASSERT_EQ(found[frame].pairs.size(), expected[frame].pairs.size());
    for (std::size_t i = 0; i < found[frame].pairs.size(); ++i) {
      const trade::TruePair &mesh = found[frame].pairs[i], &box = expected[frame].pairs[i];
      ASSERT_EQ(grade::is_contact(mesh.answer), grade::is_contact(box.answer))
          << mesh.pair.a << " " << mesh.pair.b;
      ++(grade::is_contact(mesh.answer) ? contacts : apart);
      if (!grade::is_contact(mesh.answer)) {
        EXPECT_NEAR(mesh.gap, box.gap, 1e-12);
      }
    }
  }
  EXPECT_GT(contacts, 50u);
  EXPECT_GT(apart, 50u);
}

// A vertex that nearly touches a face does not tell whether the other body is inside.
TEST(TradeTruth, MeshesThatAreApartByARoundingAreApart) {
  scene::Scene scene;
  scene.add_shape(test::box(1, 1, 1), std::make_shared<geometry::Mesh>(mesh_of_box({1, 1, 1})));
  scene.bodies.resize(2);
  scene.bodies[1].pose.translation = {std::nextafter(2.0, 3.0), 0.25, 0.125};
  const trade::SceneFrames frames(scene, 1);
  const std::vector<std::size_t> wanted = {0};
  const auto found = trade::find_truth(frames, wanted, 100, 1);
  ASSERT_EQ(found.front().pairs.size(), 1u);
  EXPECT_EQ(found.front().pairs.front().answer, Answer::separated);
}

TEST(TradeTruth, InsideIsByTheWindingNumber) {
  const geometry::Mesh mesh = mesh_of_box({1, 2, 3});
  EXPECT_THAT(trade::winding_number(mesh, {0.9, -1.9, 2.9}), Optional(DoubleNear(1, 1e-12)));
  EXPECT_THAT(trade::winding_number(mesh, {1.1, 0, 0}), Optional(DoubleNear(0, 1e-12)));
  EXPECT_THAT(trade::winding_number(mesh, {1, 2.5, 0}), Optional(DoubleNear(0, 1e-12)));
  // On a face, an edge, a diagonal of a face and beside a corner.
  for (const Vec3d& point :
       {Vec3d(1, 0.5, -0.5), Vec3d(1, 2, 0.5), Vec3d(1, 0, 0), Vec3d(1, 2, 3 + 1e-15)}) {
    EXPECT_EQ(trade::winding_number(mesh, point), std::nullopt) << point.transpose();
  }
}

TEST(TradeTruth, ARecordingHasNoBodies) {
  scene::Scene scene;
  scene.recording = {{Aabb{{0, 0, 0}, {1, 1, 1}}}};
  EXPECT_THROW(trade::SceneFrames(scene, 4), base::InputError);
}

}  // namespace
}  // namespace touchstone
