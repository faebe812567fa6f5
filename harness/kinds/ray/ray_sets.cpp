// Rays at meshes: from everywhere, from an eye, and aimed at vertices and edges.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "algorithms/core/nearest_float.h"
#include "algorithms/registry.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"
#include "harness/kinds/mesh_inputs.h"
#include "harness/kinds/ray/ray_grade.h"
#include "harness/kinds/ray/ray_kind.h"
#include "harness/kinds/set_keys.h"

namespace touchstone::kinds {
namespace {

enum class Aim : std::uint8_t { incoherent, coherent, vertices, edges };
constexpr std::array<std::string_view, 4> aim_names = {"incoherent", "coherent", "vertices",
                                                       "edges"};
constexpr std::array<std::string_view, 2> ray_task_names = {"closest", "any"};

// Numbers of rays are floats, so that both scalars answer the same question.
std::vector<Ray> make_rays(const MeshInput& input, Aim aim, std::size_t count, std::uint64_t seed) {
  base::Random random(seed, static_cast<std::uint64_t>(aim));
  const TriangleMesh& mesh = input.mesh;
  const Vec3d centre = input.centre();
  const double reach = 0.5 * base::length(input.high - input.low);
  const Vec3d eye = centre + 2 * reach * Vec3d(0.6, -0.64, 0.48);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3d origin = centre + 1.5 * reach * random.on_sphere(), target = input.draw(random);
    switch (aim) {
      case Aim::incoherent: break;
      case Aim::coherent: {
        // Line by line over a picture that is as wide as the mesh.
        const Vec3d forward = base::unit(centre - eye),
                    right = base::beside(forward, {0.8, 0.6, 0});
        const auto place = [&](std::size_t k) {
          return 2 * (static_cast<double>(k) + 0.5) / static_cast<double>(side) - 1;
        };
        origin = eye;
        target =
            centre +
            0.8 * reach * (place(i % side) * right + place(i / side) * base::outer(right, forward));
        break;
      }
      case Aim::vertices: {
        const auto& triangle = mesh.triangles[random.below(mesh.triangles.size())];
        target = mesh.vertices[triangle[random.below(3)]];
        break;
      }
      case Aim::edges: {
        const auto& triangle = mesh.triangles[random.below(mesh.triangles.size())];
        const std::uint64_t k = random.below(3);
        const double part = static_cast<double>(1 + random.below(7)) / 8;
        target =
            (1 - part) * mesh.vertices[triangle[k]] + part * mesh.vertices[triangle[(k + 1) % 3]];
        break;
      }
    }
    // What is aimed at exactly stays exact where it can: the direction is a difference of floats.
    origin = nearest_float(origin);
    const Vec3d direction = nearest_float(nearest_float(target) - origin);
    if (direction.isZero(0)) {
      --i;
      continue;
    }
    rays.push_back({.origin = origin, .direction = direction});
  }
  return rays;
}

// Rays of one aim, and the exact answers, which are those of both tasks.
struct RayInput {
  std::vector<Ray> rays;
  std::vector<RayHit> exact;
  double size = 1;  // metres, half of the mesh's box
};

TimedGrade grade_ray_set(const RayInput& input, RayTask task, const RayCastEntry& entry,
                         Precision scalar, std::span<const RayHit> hits) {
  TimedGrade sum;
  for (std::size_t i = 0; i < input.exact.size(); ++i) {
    const RayHit &hit = hits[i], &right = input.exact[i];
    const double size = input.size / input.rays[i].direction.lpNorm<Eigen::Infinity>();
    sum.add(grade_ray(task, hit, right, entry, scalar, size), static_cast<std::int64_t>(i));
    if (is_meant(hit.status) && hit.hit && right.hit && task == RayTask::closest) {
      sum.note_error(std::abs(hit.t - right.t) / std::max(right.t, 1e-30));
    }
  }
  return sum;
}

// The sets of one mesh. The exact answers serve several of them.
class RaySets {
 public:
  RaySets(std::shared_ptr<const MeshInput> mesh, std::vector<const RayCastEntry*> entries,
          std::size_t count, std::uint64_t seed)
      : mesh_(std::move(mesh)), entries_(std::move(entries)), count_(count), seed_(seed) {}

  TimedSet make(Aim aim, RayTask task) {
    const std::shared_ptr<const RayInput> input = input_of(aim);
    TimedSet cell;
    cell.queries = cell.graded = std::ssize(input->rays);
    for (const RayCastEntry* entry : entries_) {
      if (!offers(*entry, task)) continue;
      for (const Precision scalar : entry->scalars)
        cell.contestants.push_back(contestant(input, task, *entry, scalar));
    }
    return cell;
  }

 private:
  std::shared_ptr<const RayInput> input_of(Aim aim) {
    if (last_ && last_aim_ == aim) return last_;
    const auto input = std::make_shared<RayInput>();
    input->rays = make_rays(*mesh_, aim, count_, seed_);
    input->size = 0.5 * base::length(mesh_->high - mesh_->low);
    input->exact.resize(input->rays.size());
    if (!exact_) {
      exact_ = registry::find<RayCastEntry>("exact")->make({.scalar = Precision::float64});
      exact_->bind(mesh_->mesh);
    }
    exact_->cast(RayTask::closest, input->rays, input->exact);
    last_ = input;
    last_aim_ = aim;
    return input;
  }

  TimedContestant contestant(const std::shared_ptr<const RayInput>& input, RayTask task,
                             const RayCastEntry& entry, Precision scalar) {
    const auto caster = std::make_shared<std::unique_ptr<RayCast>>();
    const auto hits = std::make_shared<std::vector<RayHit>>(input->rays.size());
    TimedContestant made = contestant_in(entry, scalar);
    made.approximate = !entry.exact_verdicts;
    made.prepare = [=, &entry, mesh = mesh_] {
      *caster = entry.make({.scalar = scalar});
      (*caster)->bind(mesh->mesh);
    };
    made.answer = [=] { (*caster)->cast(task, input->rays, *hits); };
    made.grade = [=, &entry] { return grade_ray_set(*input, task, entry, scalar, *hits); };
    made.hash = [=] {
      return hash_of_answers(std::span<const RayHit>(*hits), [](const RayHit& one) {
        return hash_of_parts(one.status, one.hit, one.triangle, one.t, one.u, one.v);
      });
    };
    return made;
  }

  std::shared_ptr<const MeshInput> mesh_;
  std::vector<const RayCastEntry*> entries_;
  std::size_t count_;
  std::uint64_t seed_;
  std::unique_ptr<RayCast> exact_;
  std::shared_ptr<const RayInput> last_;
  Aim last_aim_ = Aim::incoherent;
};

}  // namespace

std::vector<PlannedSet> ray_sets(files::TomlTable& table, const std::filesystem::path& home) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 64, 100'000'000, 4096));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  const std::vector<std::size_t> aims = choices(table, "rays", aim_names);
  const std::vector<std::size_t> tasks = choices(table, "tasks", ray_task_names);
  const auto entries = selected(table, registry::entries<RayCastEntry>(), "ray cast");
  std::vector<PlannedSet> cells;
  for (const auto& mesh :
       mesh_inputs(table, home, {"torus-2000", "trefoil-10000", "terrain-100000"})) {
    const auto maker = std::make_shared<RaySets>(mesh, entries, count, seed);
    for (const std::size_t aim : aims) {
      for (const std::size_t task : tasks) {
        cells.push_back(
            {mesh->title, fmt::format("{} rays, {}", aim_names[aim], ray_task_names[task]),
             [=] { return maker->make(static_cast<Aim>(aim), static_cast<RayTask>(task)); }});
      }
    }
  }
  return cells;
}

}  // namespace touchstone::kinds
