// Reads step, shuffled, teleports and churn of generated scenes, and refuses overrides.
#include "harness/scene/generators/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/core/bounds.h"
#include "harness/base/error.h"

namespace touchstone::scene {
namespace {

double median_size(const Scene& scene) {
  std::vector<double> of_shape;
  for (const Shape& shape : scene.shapes) {
    double size = 0;
    const Aabb box = tight_box(shape, Pose{});
    for (std::size_t i = 0; i < 3; ++i) {
      size = std::max(size, static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]));
    }
    of_shape.push_back(size);
  }
  std::vector<double> sizes;
  for (const Body& body : scene.bodies) {
    if (std::isfinite(of_shape[body.shape])) sizes.push_back(of_shape[body.shape]);
  }
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

// Rounds a share to whole bodies.
std::size_t part_of(double share, std::size_t count) {
  return static_cast<std::size_t>(std::floor(share * static_cast<double>(count) + 0.5));
}

}  // namespace

void read_step(files::TomlTable& table, Scene& scene) {
  if (!table.has("step")) return;
  const double step = table.number("step", files::not_negative);
  if (table.contains("speed")) table.fail("step", "given beside speed; expected one of the two");
  Motion& motion = scene.motion;
  if (!(motion.speed > 0)) {
    table.fail("step", "given with a generator whose bodies stand still; expected none");
  }
  const double speed = step * median_size(scene) / motion.time_step;
  const double factor = speed / motion.speed;
  for (Body& body : scene.bodies) body.velocity *= factor;
  motion.speed = speed;
}

void read_order(GeneratorInput& input, Scene& scene) {
  if (!input.table.boolean("shuffled", false)) return;
  if (!scene.pairs.empty()) {
    input.table.fail("shuffled", "given with bodies that are listed in pairs; expected none");
  }
  base::Random random = input.random(GeneratorInput::order_stream);
  for (std::size_t left = scene.bodies.size(); left > 1; --left) {
    std::swap(scene.bodies[left - 1], scene.bodies[random.below(left)]);
  }
}

void read_exchange(GeneratorInput& input, Scene& scene) {
  std::vector<std::size_t> movers;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].moving) movers.push_back(i);
  }
  const auto read = [&](const char* key) {
    const double share = input.table.number(key, {.low = 0, .high = 1}, 0.0);
    if (share > 0 && (movers.empty() || !scene.pairs.empty())) {
      input.table.fail(key, "given where no body moves; expected some that do");
    }
    return part_of(share, movers.size());
  };
  const std::size_t teleports = read("teleports");
  if (teleports > 0 && movers.size() > 1) {
    scene.motion.teleports = std::max<std::size_t>(teleports, 2);  // it takes two to exchange
  }
  const std::size_t churn = read("churn");
  base::Random random = input.random(GeneratorInput::arrival_stream);
  for (std::size_t i = 0; i < churn; ++i) {
    scene.bodies.push_back(Body(scene.bodies[movers[random.below(movers.size())]]));
  }
  scene.motion.churn = churn;
}

void refuse_seed(const std::string& file, std::int64_t seed) {
  if (seed == -1) return;
  throw base::InputError(file, 0, "a seed was asked for; expected none, as nothing is random");
}

void refuse_gap(const std::string& file, std::optional<double> gap) {
  if (!gap) return;
  throw base::InputError(file, 0,
                         fmt::format("a gap of {} was asked for, but only scenes of the generator "
                                     "`pairs` have gaps",
                                     *gap));
}

void refuse_moving(const std::string& file, std::optional<double> share) {
  if (!share) return;
  throw base::InputError(
      file, 0,
      fmt::format("a share of {} was asked to move; expected a generated scene whose file may have "
                  "the key `moving`",
                  *share));
}

void refuse_for_listed(const std::string& file, const SceneOverrides& overrides) {
  if (overrides.count != -1) {
    throw base::InputError(
        file, 0,
        fmt::format("a count of {} was asked for; expected none, as the bodies are listed and only "
                    "a generator makes as many as one likes",
                    overrides.count));
  }
  refuse_gap(file, overrides.gap);
  refuse_moving(file, overrides.moving);
}

}  // namespace touchstone::scene
