// The kind of rays at triangle meshes: families, batches, contestants.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "algorithms/core/nearest_float.h"
#include "harness/families/aimed_queries.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/mesh_cases.h"
#include "harness/kinds/ray/ray_grade.h"
#include "harness/kinds/ray/ray_kind.h"
#include "harness/scene/scene.h"

namespace touchstone::kinds {
namespace {

const std::vector<families::NamedMesh>& ray_meshes() {
  static const std::vector<families::NamedMesh> all = families::ray_meshes();
  return all;
}

// From how far rays are cast (metres), on the axis.
const std::vector<AxisValue>& ray_distances() {
  static const std::vector<AxisValue> all = decades(0, 15);
  return all;
}

// Families of the axis come after the aims.
auto drawing_rays(std::uint32_t number) {
  return [number](const TriangleMesh& mesh, std::size_t triangle, families::Draws& draws) {
    constexpr std::size_t aims = families::all_ray_aims.size();
    if (number < aims) {
      return families::aimed_ray(families::all_ray_aims[number], mesh, triangle, draws);
    }
    return families::ray_from(ray_distances()[number - aims].value, mesh, triangle, draws);
  };
}

auto ray_solver(const RayCastEntry& entry, RayTask task, Precision scalar) {
  return [task, cast = std::shared_ptr<RayCast>(entry.make({scalar}))](
             const MeshTarget& target, std::span<const Ray> rays, std::span<RayHit> hits) {
    cast->bind(target.mesh);
    cast->cast(task, rays, hits);
  };
}

class RayBatch final : public Batch {
 public:
  RayBatch(std::uint32_t number, const BatchRange& range)
      : rays_(mesh_cases<Ray, RayHit>(ray_meshes(), ray_kind(), number, range, drawing_rays(number),
                                      scaled_ray)) {}

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    const auto& entry = contestant.of<RayCastEntry>();
    const auto task = static_cast<RayTask>(contestant.task);
    return rays_.ask(
        form, time_limit, [&](std::size_t i) { return in_form(i, contestant.scalar, form); },
        [&] { return ray_solver(entry, task, contestant.scalar); },
        [&](std::size_t i, const RayHit& hit) { return grade(contestant, entry, i, hit); });
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string mesh = stem.string() + ".off", rays = stem.string() + ".csv";
    scene::write_off(mesh, rays_.target(place).mesh);
    write_ray(rays, rays_[place]);
    return fmt::format(
        "touchstone query {} --in {} --with exact,{} --task {} --scalar {} --out hits.csv", rays,
        mesh, contestant.info->name, contestant.task_name(), to_string(contestant.scalar));
  }

 private:
  std::optional<std::pair<MeshTarget, Ray>> in_form(std::size_t i, Precision scalar,
                                                    CaseForm form) const {
    const FormNumbers numbers = rays_.numbers(i);
    const MeshTarget& target = rays_.target(i);
    if (form == CaseForm::scaled) {
      return std::pair(target.scaled(numbers.scale), scaled_ray(rays_[i], numbers.scale));
    }
    if (form != CaseForm::moved) return std::nullopt;
    const Vec3d shift =
        scalar == Precision::float64 ? Vec3d(target.scale * numbers.shift) : Vec3d(0, 0, 0);
    auto moved = target.moved(numbers, shift);
    const auto ray = moved_ray(rays_[i], numbers, shift);
    if (!moved || !ray) return std::nullopt;
    return std::pair(std::move(*moved), *ray);
  }

  const RayHit& truth(std::size_t i, Precision scalar) {
    auto& known = truths_[scalar];
    if (known.empty()) {
      known = rays_.answers(
          ray_solver(*registry::find<RayCastEntry>("exact"), RayTask::closest, scalar));
    }
    return known[i];
  }

  Graded grade(const Contestant& contestant, const RayCastEntry& entry, std::size_t i,
               const RayHit& hit) {
    const double size = rays_.target(i).scale / rays_[i].direction.lpNorm<Eigen::Infinity>();
    return grade_ray(static_cast<RayTask>(contestant.task), hit, truth(i, contestant.scalar), entry,
                     contestant.scalar, size);
  }

  MeshCases<Ray, RayHit> rays_;
  std::map<Precision, std::vector<RayHit>> truths_;
};

constexpr std::array<std::string_view, 2> ray_tasks = {"closest", "any"};

std::vector<Family> ray_families() {
  std::vector<Family> list;
  for (const families::RayAim aim : families::all_ray_aims) {
    list.push_back({.name = "rays-" + std::string(to_string(aim)), .group = "rays"});
  }
  add_axis(list, "ray-distance", ray_distances());
  return list;
}

}  // namespace

Ray scaled_ray(Ray ray, double scale) {
  ray.origin *= scale;
  ray.direction *= scale;
  return ray;
}

std::optional<Ray> moved_ray(Ray ray, const FormNumbers& numbers, const Vec3d& shift) {
  const auto origin = exact_sum(numbers.turn(ray.origin), shift);
  if (!origin) return std::nullopt;
  ray.origin = *origin;
  ray.direction = numbers.turn(ray.direction);
  return ray;
}

const Kind& ray_kind() {
  static const KindOf<RayCastEntry> kind(
      {.registry = kind_words<RayCastEntry>,
       .title = "Rays",
       .contract = "ray cast",
       .legend = "A contact is a hit. *Inexact*: another triangle (of those that promise it), or a "
                 "length that is off by more than 1e-9 of itself and the mesh's size (float "
                 "without exact verdicts: 1e-4).",
       .tasks = ray_tasks,
       .draw_number = 2},
      {.options = ray_options,
       .read = read_ray_questions,
       .verify = verify_ray_proofs,
       .offers =
           [](const RayCastEntry& entry, Precision scalar, std::uint8_t task) {
             return offers(entry, static_cast<RayTask>(task)) && offers(entry, scalar);
           },
       .promises = [](const RayCastEntry& entry) { return entry.exact_verdicts; },
       .families = ray_families,
       .draw = drawn_batch<RayBatch>,
       .sets = ray_sets});
  return kind;
}

}  // namespace touchstone::kinds
