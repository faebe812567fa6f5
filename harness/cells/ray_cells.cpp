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
#include "harness/base/plain_math.h"
#include "harness/base/random.h"
#include "harness/cells/choices.h"
#include "harness/cells/kinds.h"
#include "harness/cells/mesh_inputs.h"

namespace touchstone::cells {
namespace {

enum class Aim : std::uint8_t { incoherent, coherent, vertices, edges };
constexpr std::array<std::string_view, 4> aim_names = {"incoherent", "coherent", "vertices",
                                                       "edges"};
constexpr std::array<std::string_view, 2> ray_task_names = {"closest", "any"};
// A distance that is off by more than this part of itself is wrong, whatever the scalar.
constexpr double greatest_ray_error = 1e-4;

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
};

Grade grade(const RayInput& input, RayTask task, std::span<const RayHit> hits,
            bool exact_verdicts) {
  Grade grade;
  for (std::size_t i = 0; i < input.exact.size(); ++i) {
    const RayHit &hit = hits[i], &right = input.exact[i];
    if (hit.status != Status::ok && hit.status != Status::not_reported) {
      ++grade.unknown;
      continue;
    }
    if (hit.hit != right.hit) {
      ++(right.hit ? grade.missed : grade.false_hits);
      continue;
    }
    if (!right.hit || task == RayTask::any) continue;
    const double error = std::abs(hit.t - right.t) / std::max(right.t, 1e-30);
    // The error is the greatest, or the first that is no number.
    if (!(error <= grade.error)) grade.error = error;
    const bool off =
        !(error <= greatest_ray_error) || (exact_verdicts && hit.triangle != right.triangle);
    if (off) ++grade.other;
  }
  return grade;
}

// The cells of one mesh. What is bound to it, and the exact answers, serve several of them.
class RayCells {
 public:
  RayCells(std::shared_ptr<const MeshInput> mesh, std::vector<const RayCastEntry*> entries,
           std::size_t count, std::uint64_t seed)
      : mesh_(std::move(mesh)), entries_(std::move(entries)), count_(count), seed_(seed) {}

  Cell make(Aim aim, RayTask task) {
    const std::shared_ptr<const RayInput> input = input_of(aim);
    Cell cell;
    cell.queries = cell.graded = std::ssize(input->rays);
    for (const RayCastEntry* entry : entries_) {
      if (!offers(*entry, task)) continue;
      for (const Precision scalar : entry->scalars)
        cell.contestants.push_back(contestant(input, task, *entry, scalar));
    }
    return cell;
  }

 private:
  std::shared_ptr<RayCast> bound(const RayCastEntry& entry, Precision scalar) {
    std::shared_ptr<RayCast>& caster = bound_[{&entry, scalar}];
    if (!caster) {
      caster = entry.make({.scalar = scalar});
      caster->bind(mesh_->mesh);
    }
    return caster;
  }

  std::shared_ptr<const RayInput> input_of(Aim aim) {
    if (last_ && last_aim_ == aim) return last_;
    const auto input = std::make_shared<RayInput>();
    input->rays = make_rays(*mesh_, aim, count_, seed_);
    input->exact.resize(input->rays.size());
    bound(*registry::find<RayCastEntry>("exact"), Precision::float64)
        ->cast(RayTask::closest, input->rays, input->exact);
    last_ = input;
    last_aim_ = aim;
    return input;
  }

  Contestant contestant(const std::shared_ptr<const RayInput>& input, RayTask task,
                        const RayCastEntry& entry, Precision scalar) {
    const std::shared_ptr<RayCast> caster = bound(entry, scalar);
    const auto hits = std::make_shared<std::vector<RayHit>>(input->rays.size());
    Contestant made;
    made.name = entry.info.name;
    if (entry.scalars.size() > 1) made.name += fmt::format(" {}", to_string(scalar));
    made.origin = entry.info.origin;
    made.approximate = !entry.exact_verdicts;
    made.answer = [=] { caster->cast(task, input->rays, *hits); };
    made.grade = [=, exact = entry.exact_verdicts] { return grade(*input, task, *hits, exact); };
    return made;
  }

  std::shared_ptr<const MeshInput> mesh_;
  std::vector<const RayCastEntry*> entries_;
  std::size_t count_;
  std::uint64_t seed_;
  std::map<std::pair<const RayCastEntry*, Precision>, std::shared_ptr<RayCast>> bound_;
  std::shared_ptr<const RayInput> last_;
  Aim last_aim_ = Aim::incoherent;
};

}  // namespace

std::vector<PlannedCell> ray_cells(files::TomlTable& table, const std::filesystem::path& home) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 64, 100'000'000, 4096));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  const std::vector<std::size_t> aims = choices(table, "rays", aim_names);
  const std::vector<std::size_t> tasks = choices(table, "tasks", ray_task_names);
  const auto entries = selected(table, registry::entries<RayCastEntry>(), "ray cast");
  std::vector<PlannedCell> cells;
  for (const auto& mesh :
       mesh_inputs(table, home, {"torus-2000", "trefoil-10000", "terrain-100000"})) {
    const auto maker = std::make_shared<RayCells>(mesh, entries, count, seed);
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

}  // namespace touchstone::cells
