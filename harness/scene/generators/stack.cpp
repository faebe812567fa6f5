// Generator `stack`: piles of boxes that rest face to face.
#include <cmath>

#include "harness/scene/generators/generators.h"

namespace touchstone::scene {

// Makes piles of `height` cubes of side `size` on a square grid with `gap` sides between them; gap
// 0 makes a solid block. Faces touch exactly if size is a power of two. `turned` rotates each pile
// about z.
Generated make_stack(GeneratorInput& input) {
  const double size = input.table.number("size", files::positive, 1.0);
  const std::int64_t height = input.table.integer("height", 1, 1'000'000, 10);
  const double gap = input.table.number("gap", files::not_negative, 0.5);
  const bool turned = input.table.boolean("turned", false);

  Generated made;
  Scene& scene = made.scene;
  Shape cube;
  cube.kind = ShapeKind::box;
  cube.half_extents = Vec3d::Constant(size / 2);
  scene.shapes = {cube};
  const std::int64_t piles = (input.count + height - 1) / height;
  std::int64_t row = 1;
  while (row * row < piles) ++row;
  base::Random poses = input.random(GeneratorInput::pose_stream);
  Mat3d rotation = Mat3d::Identity();
  const double step = size * (1 + gap);
  for (std::int64_t i = 0; i < input.count; ++i) {
    const std::int64_t pile = i / height, level = i % height;
    if (turned && level == 0) {
      const base::SinCos turn = base::sin_cos_turns(poses.unit());
      rotation << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
    }
    Body body;
    body.pose.rotation = rotation;
    body.pose.translation = {static_cast<double>(pile % row) * step,
                             static_cast<double>(pile / row) * step,
                             (static_cast<double>(level) + 0.5) * size};
    scene.bodies.push_back(body);
  }
  set_in_motion(input, {.moving = 0.1, .speed = 0.1 * size, .spin = 0}, 0, scene);
  // The walls leave room for one more cube on every side.
  const double across = static_cast<double>(row) * step;
  made.side = across;
  set_walls(input, {-step, -step, 0}, {across, across, (static_cast<double>(height) + 1) * size},
            scene);
  return made;
}

}  // namespace touchstone::scene
