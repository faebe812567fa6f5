// Rays at meshes: from everywhere, from an eye, and aimed at vertices and edges.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "algorithms/core/nearest_float.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/plain_math.h"
#include "harness/base/random.h"
#include "harness/cells/choices.h"
#include "harness/cells/kinds.h"
#include "harness/geometry/shapes/named_mesh.h"

namespace touchstone::cells {
namespace {

enum class Aim : std::uint8_t { incoherent, coherent, vertices, edges };
constexpr std::array<std::string_view, 4> aim_names = {"incoherent", "coherent", "vertices",
                                                       "edges"};
constexpr std::array<std::string_view, 2> ray_task_names = {"closest", "any"};
// The exact answer takes all triangles of a mesh for each ray, so it is asked for fewer rays.
constexpr double most_exact_tests = 3e7;
// A distance that is off by more than this part of itself is wrong, whatever the scalar.
constexpr double greatest_ray_error = 1e-4;

struct Box {
  Vec3d low, high;
};
Box box_of(const TriangleMesh& mesh) {
  Box box{mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3d& v : mesh.vertices) {
    box.low = box.low.cwiseMin(v);
    box.high = box.high.cwiseMax(v);
  }
  return box;
}

// Numbers of rays are floats, so that both scalars answer the same question.
std::vector<Ray> make_rays(const TriangleMesh& mesh, Aim aim, std::size_t count,
                           std::uint64_t seed) {
  base::Random random(seed, static_cast<std::uint64_t>(aim));
  const Box box = box_of(mesh);
  const Vec3d centre = 0.5 * (box.low + box.high);
  const double reach = 0.5 * base::length(box.high - box.low);
  const auto inside = [&] {
    Vec3d point;
    for (int k = 0; k < 3; ++k) point[k] = random.uniform(box.low[k], box.high[k]);
    return point;
  };
  const Vec3d eye = centre + 2 * reach * Vec3d(0.6, -0.64, 0.48);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3d origin = centre + 1.5 * reach * random.on_sphere(), target = inside();
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

struct RayInput {
  TriangleMesh mesh;
  std::vector<Ray> rays;
  RayTask task;
  std::vector<RayHit> exact;  // of the first rays
};

Grade grade(const RayInput& input, std::span<const RayHit> hits, bool exact_verdicts) {
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
    if (!right.hit || input.task == RayTask::any) continue;
    const double error = std::abs(hit.t - right.t) / std::max(right.t, 1e-30);
    // The error is the greatest, or the first that is no number.
    if (!(error <= grade.error)) grade.error = error;
    const bool off =
        !(error <= greatest_ray_error) || (exact_verdicts && hit.triangle != right.triangle);
    if (off) ++grade.other;
  }
  return grade;
}

Contestant contestant(const std::shared_ptr<const RayInput>& input, const RayCastEntry& entry,
                      Precision scalar) {
  const std::shared_ptr<RayCast> caster = entry.make({.scalar = scalar});
  caster->bind(input->mesh);
  const auto hits = std::make_shared<std::vector<RayHit>>(input->rays.size());
  Contestant made;
  made.name = entry.info.name;
  if (entry.scalars.size() > 1) made.name += fmt::format(" {}", to_string(scalar));
  made.origin = entry.info.origin;
  made.approximate = !entry.exact_verdicts;
  made.answer = [=] { caster->cast(input->task, input->rays, *hits); };
  made.grade = [=, exact = entry.exact_verdicts] { return grade(*input, *hits, exact); };
  return made;
}

Cell make_ray_cell(const TriangleMesh& mesh, Aim aim, RayTask task, std::size_t count,
                   std::uint64_t seed, const std::vector<const RayCastEntry*>& entries) {
  const auto input = std::make_shared<RayInput>();
  input->mesh = mesh;
  input->rays = make_rays(mesh, aim, count, seed);
  input->task = task;
  const double each = std::max<double>(1, static_cast<double>(mesh.triangles.size()));
  input->exact.resize(std::clamp<std::size_t>(static_cast<std::size_t>(most_exact_tests / each), 64,
                                              input->rays.size()));
  const std::unique_ptr<RayCast> oracle = find_ray_cast("exact")->make({});
  oracle->bind(mesh);
  oracle->cast(task, std::span(input->rays).first(input->exact.size()), input->exact);
  Cell cell;
  cell.queries = static_cast<std::int64_t>(count);
  cell.graded = std::ssize(input->exact);
  for (const RayCastEntry* entry : entries) {
    if (!offers(*entry, task)) continue;
    for (const Precision scalar : entry->scalars)
      cell.contestants.push_back(contestant(input, *entry, scalar));
  }
  return cell;
}

}  // namespace

std::vector<PlannedCell> ray_cells(files::TomlTable& table, const std::filesystem::path& home) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 64, 100'000'000, 4096));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  const std::vector<std::size_t> aims = choices(table, "rays", aim_names);
  const std::vector<std::size_t> tasks = choices(table, "tasks", ray_task_names);
  const auto entries = selected(table, ray_casts(), "ray cast");
  std::vector<PlannedCell> cells;
  for (const std::string& name :
       table.texts("meshes", {"torus-2000", "trefoil-10000", "terrain-100000"})) {
    const auto mesh = std::make_shared<TriangleMesh>();
    try {
      geometry::Mesh read = geometry::named_mesh(name, home);
      mesh->vertices = std::move(read.vertices);
      mesh->triangles = std::move(read.triangles);
    } catch (const base::InputError& error) {
      table.fail("meshes", error.what());
    }
    if (mesh->triangles.empty()) table.fail("meshes", name + " has no triangles; expected some");
    for (const std::size_t aim : aims) {
      for (const std::size_t task : tasks) {
        cells.push_back({fmt::format("{}, {} triangles", name, mesh->triangles.size()),
                         fmt::format("{} rays, {}", aim_names[aim], ray_task_names[task]), [=] {
                           return make_ray_cell(*mesh, static_cast<Aim>(aim),
                                                static_cast<RayTask>(task), count, seed, entries);
                         }});
      }
    }
  }
  return cells;
}

}  // namespace touchstone::cells
