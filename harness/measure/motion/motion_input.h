// What contestants of motion are given: the bodies of a scene and its steps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "algorithms/core/moving_box.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/shape.h"
#include "harness/scene/motion_steps.h"
#include "harness/scene/scene.h"

namespace touchstone::measure {

// What a worker does at a time where it turns bodies or makes their boxes.
inline constexpr std::size_t bodies_a_block = 32;

struct MotionInput {
  std::vector<Shape> shapes;
  std::vector<std::uint32_t> shape_of;  // for each body
  std::vector<scene::MotionStep> steps;

  std::size_t bodies() const { return shape_of.size(); }
  ShapeKind kind_of(std::uint32_t body) const { return shapes[shape_of[body]].kind; }
  bool turns() const;  // true if some body does in some step
  bool has_halfspaces() const;
};

// `is_linear` leaves the rotations out. Throws InputError as motion_steps does.
MotionInput motion_input(const scene::Scene& scene, const std::filesystem::path& file,
                         bool is_linear);

// Cuts the infinite ends of half-spaces to the region that all other boxes sweep, so that no pair of
// moving boxes is lost or gained and broad phases get a world of its true size. swept[i] is
// swept_box(boxes[i]), before and after.
void cut_halfspaces(const MotionInput& input, std::span<MovingBox> boxes, std::span<Aabb> swept);

// The answer to a step. The pairs are sorted, a < b.
struct StepAnswer {
  std::vector<IndexPair> hits;
  std::vector<IndexPair> misses;   // of casts
  std::vector<IndexPair> unknown;  // pairs that an algorithm gave up, or does not take
  std::size_t pairs = 0;           // pairs that were asked about
};

}  // namespace touchstone::measure
