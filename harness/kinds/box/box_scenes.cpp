// Draws the scenes of boxes, frame by frame.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "harness/base/random.h"
#include "harness/kinds/box/broad_check.h"

namespace touchstone::kinds {
namespace {

constexpr std::size_t box_count = 240;
constexpr int frame_count = 5;

using MakeBox = std::function<Aabb(base::Random&)>;

Aabb box_at(const Vec3d& low, const Vec3d& size) {
  Aabb box{};
  for (int axis = 0; axis < 3; ++axis) {
    box.min[static_cast<std::size_t>(axis)] = static_cast<float>(low[axis]);
    box.max[static_cast<std::size_t>(axis)] = static_cast<float>(low[axis] + size[axis]);
  }
  return box;
}

Vec3d point(base::Random& random) {
  const double x = random.unit(), y = random.unit(), z = random.unit();
  return {x, y, z};
}

// Returns a point of the grid 0, 1, ..., n - 1 on each axis.
Vec3d grid_point(base::Random& random, std::uint64_t n) {
  const auto x = random.below(n), y = random.below(n), z = random.below(n);
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

MakeBox uniform(double scale, const Vec3d& offset) {
  return [=](base::Random& random) {
    const Vec3d low = point(random);
    return box_at(scale * low + offset, 0.2 * scale * point(random));
  };
}

BoxScene play(std::string name, std::uint64_t seed, std::uint64_t stream, const MakeBox& make) {
  base::Random random(seed, stream);
  BoxScene scene{std::move(name), {}};
  std::vector<Aabb> boxes(box_count);
  std::ranges::generate(boxes, [&] { return make(random); });
  scene.frames.push_back(boxes);
  for (int frame = 1; frame < frame_count; ++frame) {
    for (Aabb& box : boxes) {
      switch (random.below(8)) {
        case 0:
        case 1: box = make(random); break;
        case 2: box = Aabb::empty(); break;
        default: break;
      }
    }
    for (std::size_t i = 0; i < box_count / 20; ++i) boxes.push_back(make(random));
    scene.frames.push_back(boxes);
  }
  return scene;
}

}  // namespace

std::vector<BoxScene> box_scenes(std::uint64_t seed) {
  const Vec3d zero = Vec3d::Zero();
  const Vec3d one = Vec3d::Ones();
  const std::vector<std::pair<std::string, MakeBox>> makers = {
      {"uniform", uniform(1, zero)},
      {"touching-grid", [=](base::Random& random) { return box_at(grid_point(random, 6), one); }},
      {"touching-at-zero",
       [=](base::Random& random) {
         Aabb box = box_at(grid_point(random, 2) - one, one);
         for (float& x : box.max) x = x == 0 && random.below(2) == 0 ? -0.0F : x;
         return box;
       }},
      {"points", [=](base::Random& random) { return box_at(grid_point(random, 5), zero); }},
      {"flat",
       [](base::Random& random) {
         Vec3d size = point(random);
         size[static_cast<int>(random.below(3))] = 0;
         return box_at(grid_point(random, 4), size);
       }},
      {"in-one-plane",
       [](base::Random& random) {
         Vec3d low = point(random), size = 0.1 * point(random);
         low.z() = size.z() = 0;
         return box_at(low, size);
       }},
      {"coincident", [=](base::Random&) { return box_at(zero, one); }},
      {"nested",
       [=](base::Random& random) {
         const double half = random.magnitude(1e-6, 1);
         return box_at(-half * one, 2 * half * one);
       }},
      {"huge", uniform(0x1p120, zero)},
      {"tiny", uniform(0x1p-120, zero)},
      {"subnormal", uniform(0x1p-140, zero)},
      {"far", uniform(1, Vec3d(0x1p20, -0x1p21, 0x1p22))},
      {"sizes",
       [](base::Random& random) {
         const double size = random.magnitude(1e-6, 1e4);
         const Vec3d half = size * point(random);
         return box_at(10 * point(random), half);
       }},
  };
  std::vector<BoxScene> scenes;
  scenes.reserve(makers.size());
  for (const auto& [name, make] : makers) {
    scenes.push_back(play(name, seed, scenes.size(), make));
  }
  return scenes;
}

}  // namespace touchstone::kinds
