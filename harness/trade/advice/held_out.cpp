// Makes held-out scenes and grades configurations on them.
#include "harness/trade/advice/held_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/files/toml_table.h"
#include "harness/scene/kinematics.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t most_held_out_frames = 4;

// The seed of the scene as the request has it; 1 for a scene that is not generated.
std::int64_t own_seed(const TradeRequest& request) {
  if (request.overrides.seed != -1) return request.overrides.seed;
  if (request.scene.extension() != ".toml") return 1;
  return files::parse_toml(request.scene)["seed"].value<std::int64_t>().value_or(1);
}

// Returns nothing if the scene has no seeds.
std::optional<scene::Scene> with_seed(const TradeRequest& request, std::int64_t seed) {
  scene::SceneOverrides overrides = request.overrides;
  overrides.seed = seed;
  try {
    return scene::load_scene(request.scene, overrides);
  } catch (const base::InputError&) {
    return {};  // only this seed fails: the caller has loaded the scene without it
  }
}

// Returns nothing if nothing moves.
std::optional<scene::Scene> begun_later(const TradeRequest& request, int number) {
  scene::Scene scene = scene::load_scene(request.scene, request.overrides);
  base::Random random(static_cast<std::uint64_t>(number));
  scene::Scene step = scene;
  step.motion.time_step *= random.unit();
  scene::Kinematics kinematics(step);
  kinematics.next();
  bool moves = false;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    scene::Body& body = scene.bodies[i];
    const Pose& pose = kinematics.poses()[i];
    moves =
        moves || pose.translation != body.pose.translation || pose.rotation != body.pose.rotation;
    body.pose = pose;
    body.velocity = kinematics.velocities()[i];
  }
  if (!moves) return {};
  return scene;
}

}  // namespace

HeldOutScenes::HeldOutScenes(const TradeRequest& request, const Representing& representing,
                             int first, int count, double seconds)
    : request_(request) {
  // The making of representations has no limit of time.
  request_.seconds = std::numeric_limits<double>::infinity();
  const std::int64_t seed = own_seed(request);
  for (int number = first; number < first + count; ++number) {
    std::optional<scene::Scene> drawn = with_seed(request, seed + number);
    kind_ = drawn ? "seed" : "start";
    const std::int64_t shown = drawn ? seed + number : number;
    if (!drawn) drawn = begun_later(request, number);
    if (!drawn) return;
    One& one = scenes_.emplace_back();
    one.name = fmt::format("{} {}", kind_, shown);
    one.scene = std::make_unique<TradeScene>(std::move(*drawn), request_, representing);
    std::vector<std::size_t> order = sampling_order(one.scene->frames.frames.size());
    order.resize(std::min(order.size(), most_held_out_frames));
    one.truth = find_truth(one.scene->frames, order, seconds, request.threads);
  }
}

std::string HeldOutScenes::name() const {
  if (scenes_.empty()) return "nothing else: nothing moves";
  if (scenes_.size() == 1) return scenes_[0].name;
  return fmt::format("{}s {} to {}", kind_, scenes_.front().name.substr(kind_.size() + 1),
                     scenes_.back().name.substr(kind_.size() + 1));
}

std::vector<HeldOutGrade> HeldOutScenes::grade(const Configuration& configuration,
                                               const ErrorBudget& budget) {
  std::vector<HeldOutGrade> grades;
  const TradeGrid grid = grid_of(configuration);
  for (One& one : scenes_) {
    HeldOutGrade& grade = grades.emplace_back();
    grade.scene = one.name;
    TradeScene& scene = *one.scene;
    const GridPoints made = expand({&grid, 1}, scene.frames, scene.library, request_.task);
    if (made.points.size() != 1) continue;  // the configuration makes no sense there
    const Evaluation found = evaluate(scene.frames, made.points, one.truth, request_.task).front();
    if (!found.ok()) continue;
    const RepresentationSpread representation =
        spread_of(scene.library.errors(made.points[0].configuration.representations));
    grade.error = error_of(found.errors, representation, request_.measure);
    grade.near = found.errors.near;
    grade.missed = found.errors.false_negatives;
    grade.within = meets(budget, request_.measure, found, representation);
  }
  return grades;
}

bool all_within(std::span<const HeldOutGrade> grades) {
  return std::ranges::all_of(grades, &HeldOutGrade::within);
}

}  // namespace touchstone::trade
