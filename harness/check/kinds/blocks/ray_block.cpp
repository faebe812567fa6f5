// Rays at triangle meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "algorithms/core/nearest_float.h"
#include "harness/check/kinds/blocks/grading.h"
#include "harness/check/kinds/blocks/mesh_cases.h"
#include "harness/check/kinds/blocks/other_axes.h"
#include "harness/families/aimed_rays.h"
#include "harness/scene/writing/scene_writer.h"

namespace touchstone::check {
namespace {

const std::vector<families::NamedMesh>& ray_meshes() {
  static const std::vector<families::NamedMesh> all = families::ray_meshes();
  return all;
}

Ray scaled_ray(Ray ray, double scale) {
  ray.origin *= scale;
  ray.direction *= scale;
  return ray;
}

// Families of the axis come after the aims.
auto drawing_rays(std::uint32_t number) {
  return [number](const TriangleMesh& mesh, std::size_t triangle, families::Draws& draws) {
    constexpr std::size_t aims = families::all_ray_aims.size();
    if (number < aims) {
      return families::aimed_ray(families::all_ray_aims[number], mesh, triangle, draws);
    }
    return families::ray_from(ray_axis()[number - aims].of, mesh, triangle, draws);
  };
}

auto solver_of(const RayCastEntry& entry, RayTask task, Precision scalar) {
  return [task, cast = std::shared_ptr<RayCast>(entry.make({scalar}))](
             const TriangleMesh& mesh, std::span<const Ray> rays, std::span<RayHit> hits) {
    cast->bind(mesh);
    cast->cast(task, rays, hits);
  };
}

class RayBlock final : public CaseBlock {
 public:
  RayBlock(std::uint32_t number, const BlockRange& range)
      : rays_(ray_meshes(), CaseKind::rays, number, range, drawing_rays(number), scaled_ray) {}

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    const auto& entry = *std::get<const RayCastEntry*>(contestant.entry);
    const auto task = static_cast<RayTask>(contestant.task);
    std::vector<GradedCase> grades(rays_.size());
    rays_.ask(
        form, time_limit, [&](std::size_t i) { return in_form(i, contestant.scalar, form); },
        [&] { return solver_of(entry, task, contestant.scalar); },
        [&](std::size_t i, const RayHit& hit) { grades[i] = grade(contestant, entry, i, hit); });
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string mesh = stem.string() + ".off", rays = stem.string() + ".csv";
    scene::write_off(mesh, rays_.mesh(place));
    write_ray(rays, rays_[place]);
    return fmt::format(
        "touchstone rays {} --rays {} --cast exact,{} --task {} --scalar {} --out hits.csv", mesh,
        rays, contestant.info().name, contestant.task_name(), to_string(contestant.scalar));
  }

 private:
  std::optional<std::pair<TriangleMesh, Ray>> in_form(std::size_t i, Precision scalar,
                                                      CaseForm form) const {
    const FormNumbers numbers = rays_.numbers(i);
    TriangleMesh mesh = rays_.mesh(i);
    if (form == CaseForm::scaled) {
      for (Vec3d& vertex : mesh.vertices) vertex *= numbers.scale;
      return std::pair(std::move(mesh), scaled_ray(rays_[i], numbers.scale));
    }
    if (form != CaseForm::moved) return std::nullopt;
    const Vec3d shift =
        scalar == Precision::float64 ? Vec3d(rays_.scale(i) * numbers.shift) : Vec3d(0, 0, 0);
    auto moved = moved_mesh(std::move(mesh), numbers, shift);
    Ray ray = rays_[i];
    const auto origin = exact_sum(numbers.turn(ray.origin), shift);
    if (!moved || !origin) return std::nullopt;
    ray.origin = *origin;
    ray.direction = numbers.turn(ray.direction);
    return std::pair(std::move(*moved), ray);
  }

  const RayHit& truth(std::size_t i, Precision scalar) {
    auto& known = truths_[scalar];
    if (known.empty()) {
      known = rays_.answers(
          solver_of(*registry::find<RayCastEntry>("exact"), RayTask::closest, scalar));
    }
    return known[i];
  }

  GradedCase grade(const Contestant& contestant, const RayCastEntry& entry, std::size_t i,
                   const RayHit& hit) {
    const RayHit& exact = truth(i, contestant.scalar);
    const auto with = [&](CaseGrade grade) { return GradedCase{grade, exact.hit}; };
    if (const auto by_status = grade_of_status(hit.status, false)) return with(*by_status);
    if (const auto by_verdict = grade_of_verdict(hit.hit, exact.hit)) return with(*by_verdict);
    if (!hit.hit || static_cast<RayTask>(contestant.task) == RayTask::any) {
      return with(CaseGrade::right);
    }
    const double share =
        contestant.scalar == Precision::float64 || entry.exact_verdicts ? 1e-9 : 1e-4;
    const double margin =
        share * (std::abs(exact.t) + rays_.scale(i) / rays_[i].direction.lpNorm<Eigen::Infinity>());
    const bool is_other = entry.exact_verdicts && hit.triangle != exact.triangle;
    if (is_other || !(std::abs(hit.t - exact.t) <= margin)) return with(CaseGrade::wrong);
    return with(CaseGrade::right);
  }

  MeshCases<Ray, RayHit> rays_;
  std::map<Precision, std::vector<RayHit>> truths_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_ray_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<RayBlock>(number, range);
}

}  // namespace touchstone::check
