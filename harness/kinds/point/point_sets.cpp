// Points and meshes: in the box around them, and near their surface.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "algorithms/core/nearest_float.h"
#include "algorithms/registry.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/kinds/mesh_inputs.h"
#include "harness/kinds/point/point_grade.h"
#include "harness/kinds/point/point_kind.h"
#include "harness/kinds/set_keys.h"

namespace touchstone::kinds {
namespace {

enum class PointPlace : std::uint8_t { volume, near };
constexpr std::array<std::string_view, 2> point_place_names = {"volume", "near"};
constexpr std::array<std::string_view, 2> point_task_names = {"closest", "side"};

// In the mesh's box made larger by a half, or within a hundredth of its size of a triangle. All numbers are
// floats, so that libraries of floats are asked the same.
std::vector<Vec3d> make_points(const MeshInput& input, PointPlace place, std::size_t count,
                               std::uint64_t seed) {
  base::Random random(seed, 16 + static_cast<std::uint64_t>(place));
  const TriangleMesh& mesh = input.mesh;
  const double size = base::length(input.high - input.low);
  std::vector<Vec3d> points;
  while (points.size() < count) {
    Vec3d point = input.centre() + 1.5 * (input.draw(random) - input.centre());
    if (place == PointPlace::near) {
      const auto& [a, b, c] = mesh.triangles[random.below(mesh.triangles.size())];
      double v = random.uniform(0, 1), w = random.uniform(0, 1);
      if (v + w > 1) {
        v = 1 - v;
        w = 1 - w;
      }
      const Vec3d& from = mesh.vertices[a];
      const Vec3d direction = random.on_sphere();
      point = from + v * (mesh.vertices[b] - from) + w * (mesh.vertices[c] - from) +
              random.uniform(0, 0.01) * size * direction;
    }
    points.push_back(nearest_float(point));
  }
  return points;
}

struct PointInput {
  std::vector<Vec3d> points;
  std::vector<PointAnswer> exact;
  std::vector<double> reaches;  // metres, as in grade_point
  double size = 1;              // metres, of the mesh's box
};

TimedGrade grade_points(const PointInput& input, PointTask task, Precision scalar,
                        std::span<const PointAnswer> answers) {
  TimedGrade sum;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const PointAnswer &answer = answers[i], &right = input.exact[i];
    sum.add(grade_point(task, answer, right, scalar, input.reaches[i]),
            static_cast<std::int64_t>(i));
    if (task == PointTask::closest && is_meant(answer.status)) {
      sum.note_error(std::abs(answer.distance - right.distance) / input.size);
    }
  }
  return sum;
}

// The sets of one mesh.
class PointSets {
 public:
  PointSets(std::shared_ptr<const MeshInput> mesh, std::vector<const PointQueryEntry*> entries,
            std::size_t count, std::uint64_t seed)
      : mesh_(std::move(mesh)), entries_(std::move(entries)), count_(count), seed_(seed) {}

  TimedSet make(PointPlace place, PointTask task) {
    const auto input = std::make_shared<PointInput>();
    input->points = make_points(*mesh_, place, count_, seed_);
    input->exact.resize(count_);
    input->size = base::length(mesh_->high - mesh_->low);
    exact().query(task, input->points, input->exact);
    const double reach = point_reach(Vec3d::Zero(), mesh_->mesh);
    for (const Vec3d& point : input->points) {
      input->reaches.push_back(std::max(reach, point.norm()));
    }
    TimedSet cell;
    cell.queries = cell.graded = static_cast<std::int64_t>(count_);
    for (const PointQueryEntry* entry : entries_) {
      if (std::ranges::count(entry->tasks, task) == 0) continue;
      const auto query = std::make_shared<std::unique_ptr<PointQuery>>();
      const auto answers = std::make_shared<std::vector<PointAnswer>>(count_);
      TimedContestant contestant;
      contestant.name = entry->info.name;
      contestant.origin = entry->info.origin;
      contestant.prepare = [=, mesh = mesh_] {
        *query = entry->make();
        (*query)->bind(mesh->mesh);
      };
      contestant.answer = [=] { (*query)->query(task, input->points, *answers); };
      contestant.grade = [=, scalar = entry->scalar] {
        return grade_points(*input, task, scalar, *answers);
      };
      contestant.hash = [=] {
        return hash_of_answers(std::span<const PointAnswer>(*answers), [](const PointAnswer& one) {
          return hash_of_parts(one.status, one.side, one.triangle, one.distance,
                               hash_of_point(one.closest));
        });
      };
      cell.contestants.push_back(std::move(contestant));
    }
    return cell;
  }

 private:
  PointQuery& exact() {
    if (!exact_) {
      exact_ = registry::find<PointQueryEntry>("exact")->make();
      exact_->bind(mesh_->mesh);
    }
    return *exact_;
  }

  std::shared_ptr<const MeshInput> mesh_;
  std::vector<const PointQueryEntry*> entries_;
  std::size_t count_;
  std::uint64_t seed_;
  std::unique_ptr<PointQuery> exact_;
};

}  // namespace

std::vector<PlannedSet> point_sets(files::TomlTable& table, const std::filesystem::path& home) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 16, 100'000'000, 4096));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  const std::vector<std::size_t> places = choices(table, "points", point_place_names);
  const std::vector<std::size_t> tasks = choices(table, "tasks", point_task_names);
  const auto entries = selected(table, registry::entries<PointQueryEntry>(), "point query");
  const bool asks_side = std::ranges::count(tasks, std::size_t{1}) > 0;
  std::vector<PlannedSet> cells;
  for (const auto& mesh :
       mesh_inputs(table, home, {"torus-2000", "trefoil-10000", "ellipsoid-25000"})) {
    if (asks_side && geometry::open_edge(mesh->mesh.vertices, mesh->mesh.triangles)) {
      table.fail("meshes", mesh->title + " are open; expected a closed surface for the task side");
    }
    const auto maker = std::make_shared<PointSets>(mesh, entries, count, seed);
    for (const std::size_t place : places) {
      for (const std::size_t task : tasks) {
        cells.push_back(
            {mesh->title,
             fmt::format("{} points, {}", point_place_names[place], point_task_names[task]), [=] {
               return maker->make(static_cast<PointPlace>(place), static_cast<PointTask>(task));
             }});
      }
    }
  }
  return cells;
}

}  // namespace touchstone::kinds
