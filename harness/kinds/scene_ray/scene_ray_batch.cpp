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
#include "harness/kinds/exact_forms.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/ray/ray_kind.h"
#include "harness/kinds/scene_ray/scene_ray_questions.h"
#include "harness/scene/scene.h"

namespace touchstone::kinds {
namespace {

// So many consecutive cases have one scene.
constexpr std::uint64_t cases_of_a_scene = 25;
// SceneBodies are within so many metres of the origin, apart from half-spaces.
constexpr double reach = 8;

using SceneBodies = std::vector<SceneBody>;
using Hits = std::array<SceneRayHit, cases_of_a_scene>;

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
    if (placed.body.mesh) {
      TriangleMesh mesh = *placed.body.mesh;
      for (Vec3d& vertex : mesh.vertices) vertex *= scale;
      placed.body.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    }
    for (ConvexPart& part : placed.body.parts) {
      part.shape = geometry::scaled_shape(part.shape, scale);
      part.pose.translation *= scale;
    }
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

class SceneRayBatch final : public Batch {
 public:
  SceneRayBatch(std::uint32_t number, const BatchRange& range)
      : range_(range), first_scene_(range.first / cases_of_a_scene) {
    constexpr std::size_t drawn = families::all_ray_scenes.size();
    for (std::size_t i = 0; i < range.count; ++i) {
      const auto kind =
          number < drawn ? families::all_ray_scenes[number] : families::RayScene::mixed;
      while (scenes_.size() <= scene_of(i)) {
        families::RandomDraws draws(base::mix(range.seed) + number,
                                    ~(first_scene_ + scenes_.size()));
        scenes_.push_back(families::bodies_of(kind, draws));
      }
      auto draws = draws_of(scene_ray_kind(), number, range.seed, range.first + i);
      const SceneBodies& bodies = scenes_[scene_of(i)];
      // Families of the axis come after the others.
      rays_.push_back(number < drawn ? families::ray_at(kind, bodies, draws)
                                     : families::ray_from(scene_distances()[number - drawn].value,
                                                          bodies, draws));
    }
  }

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    const auto& entry = contestant.of<SceneRayCastEntry>();
    const auto task = static_cast<RayTask>(contestant.task);
    const std::vector<Call> calls = calls_of(form);
    std::vector<Graded> grades(rays_.size());
    if (calls.empty()) return grades;
    const auto solved =
        process::isolated_answers<CallAnswer>(calls.size(), batch_limits(time_limit), [&] {
          return [&, cast = std::shared_ptr<SceneRayCast>(entry.make())](std::size_t k) {
            const Call& call = calls[k];
            CallAnswer answer;
            answer.status = Status::ok;
            cast->bind(call.bodies);
            cast->cast(task, call.rays, std::span(answer.hits).first(call.rays.size()));
            return answer;
          };
        });
    for (std::size_t k = 0; k < calls.size(); ++k) {
      for (std::size_t at = 0; at < calls[k].places.size(); ++at) {
        SceneRayHit hit = solved.answers[k].hits[at];
        if (solved.answers[k].status != Status::ok) hit.status = solved.answers[k].status;
        grades[calls[k].places[at]] = grade(task, calls[k].places[at], hit);
      }
    }
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string scene = stem.string() + ".toml", rays = stem.string() + ".csv";
    scene::write_scene(scene, scenes_[scene_of(place)]);
    write_ray(rays, rays_[place]);
    return fmt::format("touchstone query {} --in {} --with exact,{} --task {} --out hits.csv", rays,
                       scene, contestant.info->name, contestant.task_name());
  }

 private:
  // A crash costs all cases of a call.
  struct Call {
    SceneBodies bodies;
    std::vector<std::size_t> places;
    std::vector<Ray> rays;
  };
  struct CallAnswer {
    Status status = Status::unsupported;
    Hits hits;
  };

  std::size_t scene_of(std::size_t i) const {
    return static_cast<std::size_t>((range_.first + i) / cases_of_a_scene - first_scene_);
  }

  // Cases of one scene are asked together; in another form each has a scene of its own.
  std::vector<Call> calls_of(CaseForm form) const {
    std::vector<Call> calls;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      const std::size_t scene = scene_of(i);
      if (form == CaseForm::as_drawn) {
        if (last != scene) calls.push_back({scenes_[scene], {}, {}});
        last = scene;
        calls.back().places.push_back(i);
        calls.back().rays.push_back(rays_[i]);
      } else if (auto other = in_form(i, form)) {
        calls.push_back({std::move(other->first), {i}, {other->second}});
      }
    }
    return calls;
  }

  std::optional<std::pair<SceneBodies, Ray>> in_form(std::size_t i, CaseForm form) const {
    const FormNumbers numbers(range_.seed, range_.first + i);
    Ray ray = rays_[i];
    if (form == CaseForm::scaled) {
      ray.origin *= numbers.scale;
      ray.direction *= numbers.scale;
      return std::pair(scaled_bodies(scenes_[scene_of(i)], numbers.scale), ray);
    }
    if (form != CaseForm::moved) return std::nullopt;
    auto bodies = moved_bodies(scenes_[scene_of(i)], numbers);
    const auto origin = exact_sum(numbers.turn(ray.origin), numbers.shift);
    if (!bodies || !origin) return std::nullopt;
    ray.origin = *origin;
    ray.direction = numbers.turn(ray.direction);
    return std::pair(std::move(*bodies), ray);
  }

  const RayTruth& truth(std::size_t i) {
    if (truths_.empty()) {
      for (std::size_t first = 0, end = 0; first < rays_.size(); first = end) {
        while (end < rays_.size() && scene_of(end) == scene_of(first)) ++end;
        add_truths(scenes_[scene_of(first)], std::span(rays_).subspan(first, end - first));
      }
    }
    return truths_[i];
  }

  void add_truths(const SceneBodies& bodies, std::span<const Ray> rays) {
    for (RayTruth& truth : body_by_body(bodies, rays)) truths_.push_back(std::move(truth));
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
      const SceneBodies& bodies = scenes_[scene_of(i)];
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

  BatchRange range_;
  std::uint64_t first_scene_;
  std::vector<SceneBodies> scenes_;
  std::vector<Ray> rays_;
  std::vector<RayTruth> truths_;
};

constexpr std::array<std::string_view, 2> scene_ray_tasks = {"closest", "any"};

class SceneRayKind final : public Kind {
 public:
  SceneRayKind()
      : Kind({.registry = kind_words<SceneRayCastEntry>,
              .title = "Rays at scenes",
              .contract = "ray cast of scenes",
              .legend =
                  "A contact is a hit. *Near*: what is right if convex parts are larger or smaller "
                  "by some units of the last place of their size and distance. *Inexact*: a body "
                  "that the ray does not meet, and for `closest` another one than the first, or a "
                  "length that is off by more than 1e-9 of itself and the scene's size.",
              .tasks = scene_ray_tasks,
              .draw_number = 6}) {}

  std::vector<const AlgorithmInfo*> algorithms() const override {
    return infos_of(registry::entries<SceneRayCastEntry>());
  }

  std::vector<Contestant> contestants(const std::vector<std::string>& names,
                                      std::span<const Precision> scalars) const override {
    return contestants_of(
        *this, registry::entries<SceneRayCastEntry>(), names, scalars,
        [](const SceneRayCastEntry& entry, Precision scalar, std::uint8_t task) {
          return scalar == Precision::float64 &&
                 std::ranges::count(entry.tasks, static_cast<RayTask>(task)) > 0;
        },
        [](const SceneRayCastEntry&) { return true; });
  }

  std::unique_ptr<Batch> draw(const Family& family, const BatchRange& range) const override {
    return std::make_unique<SceneRayBatch>(family.number, range);
  }

  std::vector<QueryOption> query_options() const override { return scene_ray_options(); }
  std::unique_ptr<Questions> read(const QuestionInput& input) const override {
    return read_scene_ray_questions(input);
  }
  bool verify(const std::string& proofs, const std::filesystem::path& file) const override {
    return verify_ray_proofs(proofs, file);
  }

  std::vector<PlannedSet> timed_sets(files::TomlTable& table,
                                     const std::filesystem::path&) const override {
    table.fail("kind", "rays at scenes have no timed sets yet");
  }

 private:
  std::vector<Family> list_families() const override {
    std::vector<Family> list;
    for (const families::RayScene scene : families::all_ray_scenes) {
      list.push_back(
          {.name = "scene-rays-" + std::string(to_string(scene)), .group = "scene-rays"});
    }
    add_axis(list, "scene-ray-distance", scene_distances());
    return list;
  }
};

}  // namespace

const Kind& scene_ray_kind() {
  static const SceneRayKind kind;
  return kind;
}

}  // namespace touchstone::kinds
