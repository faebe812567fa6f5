// Generator `chain`: rings that hang in each other.
#include <algorithm>

#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/world_size.h"

namespace touchstone::scene {
namespace {

double extent(const Aabb& box, std::size_t axis) {
  return static_cast<double>(box.max[axis]) - static_cast<double>(box.min[axis]);
}

}  // namespace

// Chains lie along x, side by side along y. Each link is turned by a quarter about x against the one
// before. A link's length is its width along x, and its thickness that along z: rings of a round tube
// that are pulled taut are length - 2 thickness apart, and `slack` of that nearer here, so that they
// do not touch.
Generated make_chain(GeneratorInput& input) {
  const double slack = input.table.number("slack", {.low = -0.5, .high = 0.5}, 0.05);
  const auto strands = input.table.integer("strands", 1, 1'000'000, 1);
  Generated made{make_bodies(input, {}, false, input.count), 0};
  Scene& scene = made.scene;
  const std::vector<Aabb> boxes = boxes_at_origin(scene);
  double pitch = 0, across = 0;
  for (const Aabb& box : boxes) {
    pitch = std::max(pitch, (extent(box, 0) - 2 * extent(box, 2)) * (1 - slack));
    across = std::max({across, extent(box, 1), extent(box, 2)});
  }
  if (!(pitch > 0)) {
    input.table.fail("shapes",
                     "no link is longer along x than twice its width along z; expected rings "
                     "around z, such as {type = \"torus\"}");
  }
  const std::int64_t links = (input.count + strands - 1) / strands;  // of a chain
  Mat3d quarter;
  quarter << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Vec3d high = Vec3d::Constant(across);
  for (std::int64_t i = 0; i < input.count; ++i) {
    const std::int64_t link = i % links;
    Pose& pose = scene.bodies[static_cast<std::size_t>(i)].pose;
    pose.translation = {static_cast<double>(link) * pitch,
                        static_cast<double>(i / links) * across * 1.1, 0};
    if (link % 2 == 1) pose.rotation = base::product(quarter, pose.rotation);
    high = high.cwiseMax(pose.translation + Vec3d::Constant(across));
  }
  made.side = high.maxCoeff();
  set_in_motion(input, {.speed = 0.1 * pitch, .spin = 0.1}, 0, scene);
  set_walls(input, Vec3d::Constant(-across), high, scene);
  return made;
}

}  // namespace touchstone::scene
