// Bodies and steps of a scene.
#include "harness/measure/motion.h"

#include <algorithm>
#include <cmath>

#include "algorithms/moving_pairs.h"

namespace touchstone::measure {

bool MotionInput::turns() const {
  return std::ranges::any_of(steps, [](const scene::MotionStep& step) {
    return std::ranges::any_of(step.motions, &Motion::turns);
  });
}

bool MotionInput::has_halfspaces() const {
  return std::ranges::any_of(shapes,
                             [](const Shape& shape) { return shape.kind == ShapeKind::halfspace; });
}

MotionInput motion_input(const scene::Scene& scene, const std::filesystem::path& file,
                         bool is_linear) {
  MotionInput input;
  input.steps = scene::motion_steps(scene, file);
  input.shapes = scene.shapes;
  input.filter = scene.filter;
  for (const scene::Body& body : scene.bodies) input.shape_of.push_back(body.shape);
  if (!is_linear) return input;
  for (scene::MotionStep& step : input.steps) {
    for (Motion& motion : step.motions) motion.rotation_vector = Vec3d::Zero();
  }
  return input;
}

void cut_halfspaces(const MotionInput& input, std::span<MovingBox> boxes, std::span<Aabb> swept) {
  if (!input.has_halfspaces()) return;
  const auto is_halfspace = [&](std::size_t body) {
    return input.kind_of(static_cast<std::uint32_t>(body)) == ShapeKind::halfspace;
  };
  Aabb world = Aabb::empty();
  bool any = false;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (is_halfspace(i)) {
      any = true;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      world.min[k] = std::min(world.min[k], swept[i].min[k]);
      world.max[k] = std::max(world.max[k], swept[i].max[k]);
    }
  }
  if (!any) return;
  if (world.is_empty()) world = {{0, 0, 0}, {0, 0, 0}};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_halfspace(i)) continue;
    MovingBox& box = boxes[i];
    for (std::size_t k = 0; k < 3; ++k) {
      // An end that moves still leaves the region behind at no time.
      const double way = std::abs(static_cast<double>(box.displacement[k]));
      if (std::isinf(box.box.min[k])) box.box.min[k] = round_down(world.min[k] - 2 * way);
      if (std::isinf(box.box.max[k])) box.box.max[k] = round_up(world.max[k] + 2 * way);
      if (box.box.min[k] > box.box.max[k]) box.box.min[k] = box.box.max[k];
    }
    swept[i] = swept_box(box);
  }
}

}  // namespace touchstone::measure
