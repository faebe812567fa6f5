// Generator `ground`: one large ground body with many small bodies on it.
#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/world_size.h"

namespace touchstone::scene {

// Body 0 is a box whose upper side is z = 0. The others' origins are spread evenly over it, up to
// `layer` above it, so that the lower ones penetrate the ground.
Generated make_ground(GeneratorInput& input) {
  const ShapeMixDefaults sizes{.size = {0.2, 1}};
  const double thickness = input.table.number("thickness", files::positive, 1.0);
  const double layer = input.table.number("layer", files::positive, 1.0);
  Generated made{make_bodies(input, sizes, true, input.count - 1), 0};
  const RegionOf region = [layer](std::size_t, double side) {
    return Region{{-side / 2, -side / 2, 0}, {side, side, layer}};
  };
  made.side = read_world_side(input.table, made.scene, region, {}, false,
                              input.random(GeneratorInput::world_stream));
  const Region world = region(0, made.side);
  base::Random places = input.random(GeneratorInput::place_stream);
  for (Body& body : made.scene.bodies) {
    for (int axis = 0; axis < 3; ++axis) {
      body.pose.translation[axis] = world.low[axis] + world.width[axis] * places.unit();
    }
  }
  set_in_motion(input, {}, 0, made.scene);
  set_walls(input, world.low, world.low + world.width, made.scene);

  Shape slab;
  slab.kind = ShapeKind::box;
  slab.half_extents = {made.side / 2, made.side / 2, thickness / 2};
  Body ground;
  ground.shape = made.scene.add_shape(slab);
  ground.pose.translation.z() = -thickness / 2;
  ground.moving = false;
  made.scene.bodies.insert(made.scene.bodies.begin(), ground);
  return made;
}

}  // namespace touchstone::scene
