// The kind of rays at scenes of bodies of all kinds. What is right is found body by body: the exact answers to each of
// them alone say which bodies a ray meets, and where.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "harness/families/ray_scenes.h"
#include "harness/geometry/tessellation.h"
#include "harness/kinds/mesh_cases.h"
#include "harness/kinds/ray/ray_kind.h"
#include "harness/kinds/scene_ray/scene_ray_questions.h"
#include "harness/scene/scene.h"

namespace touchstone::kinds {
namespace {

// SceneBodies are within so many metres of the origin, apart from half-spaces.
constexpr double reach = 8;

using SceneBodies = std::vector<SceneBody>;

// From how far rays are cast (metres), on the axis.
const std::vector<AxisValue>& scene_distances() {
  static const std::vector<AxisValue> all = decades(0, 15);
  return all;
}

// What each body alone answers to a ray.
struct RayTruth {
  std::vector<SceneRayHit> of_body;
  bool meets = false;    // some body for certain
  bool is_known = true;  // the answers of all bodies are
  double t = HUGE_VAL;   // the least that is known

  void add(const SceneRayHit& hit) {
    of_body.push_back(hit);
    if (hit.status != Status::ok) {
      is_known = false;
    } else if (hit.hit) {
      meets = true;
      t = std::min(t, hit.t);
    }
  }
};

SceneBodies scaled_bodies(SceneBodies bodies, double scale) {
  for (SceneBody& placed : bodies) {
    placed.pose.translation *= scale;
    placed.body = geometry::scaled_body(std::move(placed.body), scale);
  }
  return bodies;
}

std::optional<SceneBodies> moved_bodies(SceneBodies bodies, const FormNumbers& numbers) {
  for (SceneBody& placed : bodies) {
    placed.pose.rotation = numbers.turn(placed.pose.rotation);
    const auto sum = exact_sum(numbers.turn(placed.pose.translation), numbers.shift);
    if (!sum) return std::nullopt;
    placed.pose.translation = *sum;
  }
  return bodies;
}

// The bodies with their convex parts, but flat ones, times a factor about a point of theirs. Rounding decides
// rays that pass a convex part within some units of the last place of its size and distance.
SceneBodies resized_bodies(SceneBodies bodies, double factor) {
  for (SceneBody& placed : bodies) {
    for (ConvexPart& part : placed.body.parts) {
      Vec3d centre = Vec3d::Zero();
      if (part.shape.kind == ShapeKind::hull) {
        if (part.shape.hull->dimension < 3) continue;
        for (const Vec3d& vertex : part.shape.hull->vertices) centre += vertex;
        centre /= static_cast<double>(part.shape.hull->vertices.size());
      }
      if (part.shape.kind == ShapeKind::halfspace) {
        part.shape.offset += (factor - 1) * part.shape.normal.norm();
        continue;
      }
      part.shape = geometry::scaled_shape(part.shape, factor);
      part.pose.translation += part.pose.rotation * ((1 - factor) * centre);
    }
  }
  return bodies;
}

// Asks the oracle about each body alone.
std::vector<RayTruth> body_by_body(const SceneBodies& bodies, std::span<const Ray> rays) {
  std::vector<RayTruth> truths(rays.size());
  const auto exact = registry::find<SceneRayCastEntry>("exact")->make();
  std::vector<SceneRayHit> hits(rays.size());
  for (const SceneBody& body : bodies) {
    exact->bind({&body, 1});
    exact->cast(RayTask::closest, rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) truths[i].add(hits[i]);
  }
  return truths;
}

constexpr std::size_t drawn_scenes = families::all_ray_scenes.size();

// Families of the axis come after the others.
families::RayScene scene_of_family(std::uint32_t number) {
  return number < drawn_scenes ? families::all_ray_scenes[number] : families::RayScene::mixed;
}

class SceneRayBatch final : public Batch {
 public:
  SceneRayBatch(std::uint32_t number, const BatchRange& range)
      : rays_(
            range,
            [&](std::uint64_t group) {
              families::RandomDraws draws(base::mix(range.seed) + number, ~group);
              return families::bodies_of(scene_of_family(number), draws);
            },
            [&](std::uint64_t index, const SceneBodies& bodies) {
              auto draws = draws_of(scene_ray_kind(), number, range.seed, index);
              return number < drawn_scenes
                         ? families::ray_at(scene_of_family(number), bodies, draws)
                         : families::ray_from(scene_distances()[number - drawn_scenes].value,
                                              bodies, draws);
            }) {}

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    const auto& entry = contestant.of<SceneRayCastEntry>();
    const auto task = static_cast<RayTask>(contestant.task);
    return rays_.ask(
        form, time_limit, [&](std::size_t i) { return in_form(i, form); },
        [&] {
          return [task, cast = std::shared_ptr<SceneRayCast>(entry.make())](
                     const SceneBodies& bodies, std::span<const Ray> rays,
                     std::span<SceneRayHit> hits) {
            cast->bind(bodies);
            cast->cast(task, rays, hits);
          };
        },
        [&](std::size_t i, const SceneRayHit& hit) { return grade(task, i, hit); });
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string scene = stem.string() + ".toml", rays = stem.string() + ".csv";
    scene::write_scene(scene, rays_.target(place));
    write_ray(rays, rays_[place]);
    return fmt::format("touchstone query {} --in {} --with exact,{} --task {} --out hits.csv", rays,
                       scene, contestant.info->name, contestant.task_name());
  }

 private:
  std::optional<std::pair<SceneBodies, Ray>> in_form(std::size_t i, CaseForm form) const {
    const FormNumbers numbers = rays_.numbers(i);
    if (form == CaseForm::scaled) {
      return std::pair(scaled_bodies(rays_.target(i), numbers.scale),
                       scaled_ray(rays_[i], numbers.scale));
    }
    if (form != CaseForm::moved) return std::nullopt;
    auto bodies = moved_bodies(rays_.target(i), numbers);
    const auto ray = moved_ray(rays_[i], numbers, numbers.shift);
    if (!bodies || !ray) return std::nullopt;
    return std::pair(std::move(*bodies), *ray);
  }

  const RayTruth& truth(std::size_t i) {
    if (truths_.empty()) {
      rays_.for_each_target([&](const SceneBodies& bodies, std::span<const Ray> rays) {
        for (RayTruth& truth : body_by_body(bodies, rays)) truths_.push_back(std::move(truth));
      });
    }
    return truths_[i];
  }

  Graded grade(RayTask task, std::size_t i, const SceneRayHit& hit) {
    const RayTruth& exact = truth(i);
    const auto with = [&](Grade grade) { return Graded{grade, exact.meets}; };
    if (const auto by_status = grade_of_status(hit.status, false)) return with(*by_status);
    if (hit.hit && hit.body >= exact.of_body.size()) return with(Grade::inexact);
    auto agrees = agreement(task, i, hit, exact, exact);
    if (agrees == true) return with(Grade::right);
    if (agrees == false) {
      const std::span<const Ray> ray(&rays_[i], 1);
      const double change = 0x1p-46 * (reach + rays_[i].origin.lpNorm<Eigen::Infinity>());
      const SceneBodies& bodies = rays_.target(i);
      const auto larger = body_by_body(resized_bodies(bodies, 1 + change), ray);
      const auto smaller = body_by_body(resized_bodies(bodies, 1 - std::min(change, 0.5)), ray);
      agrees = agreement(task, i, hit, larger[0], smaller[0]);
      if (agrees == true) return with(Grade::near);
    }
    if (!agrees) return with(Grade::unresolved);
    return with(grade_of_verdict(hit.hit, exact.meets).value_or(Grade::inexact));
  }

  // Whether the answer is right for bodies between larger and smaller ones; nothing if that is not known.
  std::optional<bool> agreement(RayTask task, std::size_t i, const SceneRayHit& hit,
                                const RayTruth& larger, const RayTruth& smaller) const {
    const auto unless_open = smaller.is_known ? std::optional(true) : std::nullopt;
    if (!hit.hit) return smaller.meets ? std::optional(false) : unless_open;
    const SceneRayHit &first = larger.of_body[hit.body], &last = smaller.of_body[hit.body];
    if (first.status != Status::ok || last.status != Status::ok) return std::nullopt;
    if (!first.hit) return false;
    if (task == RayTask::any) return true;
    const double size = reach / rays_[i].direction.lpNorm<Eigen::Infinity>();
    const double margin = 1e-9 * (std::abs(first.t) + size);
    // A ray that only grazes the larger body is somewhere in it.
    const double latest = last.hit ? last.t : first.t + 1e-3 * size;
    if (hit.t < first.t - margin || hit.t > std::min(latest, smaller.t) + margin) return false;
    return unless_open;
  }

  TargetCases<SceneBodies, Ray, SceneRayHit> rays_;
  std::vector<RayTruth> truths_;
};

constexpr std::array<std::string_view, 2> scene_ray_tasks = {"closest", "any"};

std::vector<Family> scene_ray_families() {
  std::vector<Family> list;
  for (const families::RayScene scene : families::all_ray_scenes) {
    list.push_back({.name = "scene-rays-" + std::string(to_string(scene)), .group = "scene-rays"});
  }
  add_axis(list, "scene-ray-distance", scene_distances());
  return list;
}

}  // namespace

const Kind& scene_ray_kind() {
  static const KindOf<SceneRayCastEntry> kind(
      {.registry = kind_words<SceneRayCastEntry>,
       .title = "Rays at scenes",
       .contract = "ray cast of scenes",
       .legend = "A contact is a hit. *Near*: what is right if convex parts are larger or smaller "
                 "by some units of the last place of their size and distance. *Inexact*: a body "
                 "that the ray does not meet, and for `closest` another one than the first, or a "
                 "length that is off by more than 1e-9 of itself and the scene's size.",
       .tasks = scene_ray_tasks,
       .draw_number = 6},
      {.options = scene_ray_options,
       .read = read_scene_ray_questions,
       .verify = verify_ray_proofs,
       .offers =
           [](const SceneRayCastEntry& entry, Precision scalar, std::uint8_t task) {
             return scalar == Precision::float64 &&
                    std::ranges::count(entry.tasks, static_cast<RayTask>(task)) > 0;
           },
       .families = scene_ray_families,
       .draw = drawn_batch<SceneRayBatch>});
  return kind;
}

}  // namespace touchstone::kinds
