// A ray picker: which body is under the mouse? Draws what the eye sees.
#include <cstdio>
#include <touchstone/touchstone.hpp>
#include <vector>

int main() {
  touchstone::World world;
  std::vector<touchstone::Handle> bodies = {
      world.insert(touchstone::Shape::sphere(1), touchstone::Pose::at({-2, 0, 0})),
      world.insert(touchstone::Shape::box({0.8, 0.8, 0.8}), touchstone::Pose::at({1, 0, 0})),
      world.insert(touchstone::Shape::cone(1, 1), touchstone::Pose::at({3.5, 0, 0}))};
  const touchstone::Vec3 eye = {0.75, -10, 0};
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 60; ++column) {
      const touchstone::Vec3 pixel = {-3.5 + 8.5 * column / 59, 0, 1.5 - 3.0 * row / 11};
      const touchstone::RayHit hit = world.ray(
          {.origin = eye, .direction = {pixel.x - eye.x, pixel.y - eye.y, pixel.z - eye.z}});
      std::putchar(!hit.hit                ? '.'
                   : hit.body == bodies[0] ? 'o'
                   : hit.body == bodies[1] ? '#'
                                           : '^');
    }
    std::putchar('\n');
  }
}
