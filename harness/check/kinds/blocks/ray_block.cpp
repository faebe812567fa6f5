// Rays at triangle meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "algorithms/core/nearest_float.h"
#include "harness/check/kinds/blocks/grading.h"
#include "harness/check/kinds/blocks/mesh_targets.h"
#include "harness/check/kinds/blocks/other_axes.h"
#include "harness/families/aimed_rays.h"
#include "harness/files/text_file.h"

namespace touchstone::check {
namespace {

// Rays of one call, and their mesh; a crash costs them all.
struct RayCall {
  std::size_t mesh;
  std::vector<std::size_t> places;
  std::vector<Ray> rays;
};

struct RayCallAnswer {
  Status status = Status::unsupported;
  std::array<RayHit, cases_of_a_mesh> answers;
};

class RayBlock final : public CaseBlock {
 public:
  RayBlock(std::uint32_t number, const BlockRange& range) : range_(range) {
    static const std::vector<families::NamedMesh> meshes = families::ray_meshes();
    // Families of the axis come after the aims.
    const std::size_t aims = families::all_ray_aims.size();
    const double distance = number < aims ? 0 : ray_axis()[number - aims].of;
    first_group_ = range.first / cases_of_a_mesh;
    for (std::size_t i = 0; i < range.count; ++i) {
      const std::uint64_t index = range.first + i;
      while (targets_.size() <= index / cases_of_a_mesh - first_group_) {
        targets_.emplace_back(meshes, base::mix(range.seed) + number,
                              first_group_ + targets_.size());
      }
      const MeshTarget& target = targets_[mesh_of(i)];
      auto draws = draws_of(CaseKind::rays, number, range.seed, index);
      const int triangles = static_cast<int>(target.mesh.triangles.size());
      TriangleMesh unscaled = target.mesh;
      for (Vec3d& vertex : unscaled.vertices) vertex /= target.scale;
      const auto triangle = static_cast<std::size_t>(triangles > 0 ? draws.below(triangles) : 0);
      Ray ray = number < aims
                    ? families::aimed_ray(families::all_ray_aims[number], unscaled, triangle, draws)
                    : families::ray_from(distance, unscaled, triangle, draws);
      ray.origin *= target.scale;
      ray.direction *= target.scale;
      rays_.push_back(ray);
    }
  }

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    const auto& entry = *std::get<const RayCastEntry*>(contestant.entry);
    const auto task = static_cast<RayTask>(contestant.task);
    std::vector<GradedCase> grades(rays_.size());
    std::vector<TriangleMesh> meshes;
    std::vector<RayCall> calls;
    // In another form each case has a mesh of its own.
    if (form == CaseForm::as_drawn) {
      for (const MeshTarget& target : targets_) meshes.push_back(target.mesh);
    }
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      if (form == CaseForm::as_drawn) {
        if (calls.empty() || calls.back().mesh != mesh_of(i)) calls.push_back({mesh_of(i), {}, {}});
        calls.back().places.push_back(i);
        calls.back().rays.push_back(rays_[i]);
      } else {
        auto other = in_form(i, contestant.scalar, form);
        if (!other) continue;
        meshes.push_back(std::move(other->first));
        calls.push_back({meshes.size() - 1, {i}, {other->second}});
      }
    }
    if (calls.empty()) return grades;
    const auto solved =
        process::isolated_answers<RayCallAnswer>(calls.size(), block_limits(time_limit), [&] {
          const std::shared_ptr<RayCast> cast = entry.make({contestant.scalar});
          return [&, cast](std::size_t k) {
            RayCallAnswer answer;
            answer.status = Status::ok;
            cast->bind(meshes[calls[k].mesh]);
            cast->cast(task, calls[k].rays, std::span(answer.answers).first(calls[k].rays.size()));
            return answer;
          };
        });
    for (std::size_t k = 0; k < calls.size(); ++k) {
      for (std::size_t at = 0; at < calls[k].places.size(); ++at) {
        const std::size_t i = calls[k].places[at];
        RayHit answer = solved.answers[k].answers[at];
        if (solved.answers[k].status != Status::ok) answer.status = solved.answers[k].status;
        grades[i] = grade(contestant, entry, i, answer);
      }
    }
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string mesh = stem.string() + ".off", rays = stem.string() + ".csv";
    write_mesh(mesh, targets_[mesh_of(place)].mesh);
    const Ray& ray = rays_[place];
    const auto& [o, d] = std::pair(ray.origin, ray.direction);
    files::write_text(rays,
                      fmt::format("origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,"
                                  "t_max\n{},{},{},{},{},{},{}\n",
                                  o.x(), o.y(), o.z(), d.x(), d.y(), d.z(), ray.t_max));
    return fmt::format(
        "touchstone rays {} --rays {} --cast exact,{} --task {} --scalar {} --out hits.csv", mesh,
        rays, contestant.info().name, contestant.task_name(), to_string(contestant.scalar));
  }

 private:
  std::size_t mesh_of(std::size_t place) const {
    return static_cast<std::size_t>((range_.first + place) / cases_of_a_mesh - first_group_);
  }

  std::optional<std::pair<TriangleMesh, Ray>> in_form(std::size_t i, Precision scalar,
                                                      CaseForm form) const {
    const FormNumbers numbers(range_.seed, range_.first + i);
    const MeshTarget& target = targets_[mesh_of(i)];
    TriangleMesh mesh = target.mesh;
    Ray ray = rays_[i];
    if (form == CaseForm::scaled) {
      for (Vec3d& vertex : mesh.vertices) vertex *= numbers.scale;
      ray.origin *= numbers.scale;
      ray.direction *= numbers.scale;
      return std::pair(std::move(mesh), ray);
    }
    if (form != CaseForm::moved) return std::nullopt;
    const Vec3d shift =
        scalar == Precision::float64 ? Vec3d(target.scale * numbers.shift) : Vec3d(0, 0, 0);
    auto moved = moved_mesh(std::move(mesh), numbers, shift);
    const auto origin = exact_sum(numbers.turn(ray.origin), shift);
    if (!moved || !origin) return std::nullopt;
    ray.origin = *origin;
    ray.direction = numbers.turn(ray.direction);
    return std::pair(std::move(*moved), ray);
  }

  const RayHit& truth(std::size_t i, Precision scalar) {
    auto& known = truths_[scalar];
    if (known.empty()) {
      known.resize(rays_.size());
      const auto exact = find_ray_cast("exact")->make({scalar});
      for (std::size_t place = 0; place < rays_.size(); ++place) {
        if (place == 0 || mesh_of(place) != mesh_of(place - 1)) {
          exact->bind(targets_[mesh_of(place)].mesh);
        }
        exact->cast(RayTask::closest, {&rays_[place], 1}, {&known[place], 1});
      }
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
        share * (std::abs(exact.t) +
                 targets_[mesh_of(i)].scale / rays_[i].direction.lpNorm<Eigen::Infinity>());
    const bool is_other = entry.exact_verdicts && hit.triangle != exact.triangle;
    if (is_other || !(std::abs(hit.t - exact.t) <= margin)) return with(CaseGrade::wrong);
    return with(CaseGrade::right);
  }

  BlockRange range_;
  std::uint64_t first_group_ = 0;
  std::vector<MeshTarget> targets_;
  std::vector<Ray> rays_;
  std::map<Precision, std::vector<RayHit>> truths_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_ray_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<RayBlock>(number, range);
}

}  // namespace touchstone::check
