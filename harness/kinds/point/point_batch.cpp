// The kind of points and triangle meshes: families, batches, contestants.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "harness/families/aimed_queries.h"
#include "harness/files/text_file.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/mesh_cases.h"
#include "harness/kinds/point/point_grade.h"
#include "harness/kinds/point/point_kind.h"
#include "harness/scene/scene.h"

namespace touchstone::kinds {
namespace {

constexpr std::size_t point_places = families::all_point_places.size();

const std::vector<families::NamedMesh>& point_meshes(bool is_closed) {
  static const std::vector<families::NamedMesh> closed = families::closed_meshes();
  static const std::vector<families::NamedMesh> any = families::ray_meshes();
  return is_closed ? closed : any;
}

// How far points are from the surface (metres), on the axis.
const std::vector<AxisValue>& point_gaps() {
  static const std::vector<AxisValue> all = decades(0, -17);
  return all;
}

auto drawing_points(std::uint32_t number) {
  return [number](const TriangleMesh& mesh, std::size_t triangle, families::Draws& draws) {
    if (number < 2 * point_places) {
      return tried_point(families::all_point_places[number % point_places], mesh, triangle, draws);
    }
    const std::size_t place = number - 2 * point_places;
    return families::point_off(point_gaps()[place].value, mesh, triangle, draws);
  };
}

auto point_solver(const PointQueryEntry& entry, PointTask task) {
  return
      [task, query = std::shared_ptr<PointQuery>(entry.make())](
          const MeshTarget& target, std::span<const Vec3d> points, std::span<PointAnswer> answers) {
        query->bind(target.mesh);
        query->query(task, points, answers);
      };
}

class PointBatch final : public Batch {
 public:
  // First those of closed meshes, then those of any, then those of the axis, with closed ones.
  PointBatch(std::uint32_t number, const BatchRange& range)
      : is_closed_(number / point_places != 1),
        points_(mesh_cases<Vec3d, PointAnswer>(
            point_meshes(is_closed_), point_kind(), number, range, drawing_points(number),
            [](const Vec3d& point, double scale) { return Vec3d(scale * point); })) {}

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    const auto& entry = contestant.of<PointQueryEntry>();
    const auto task = static_cast<PointTask>(contestant.task);
    if (task == PointTask::side && !is_closed_) return std::vector<Graded>(points_.size());
    return points_.ask(
        form, time_limit, [&](std::size_t i) { return in_form(i, form); },
        [&] { return point_solver(entry, task); },
        [&](std::size_t i, const PointAnswer& answer) {
          const double scale = form == CaseForm::scaled ? points_.numbers(i).scale : 1;
          return grade(entry, task, i, answer, scale);
        });
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string mesh = stem.string() + ".off", points = stem.string() + ".csv";
    scene::write_off(mesh, points_.target(place).mesh);
    const Vec3d& p = points_[place];
    files::write_text(points, fmt::format("x,y,z\n{},{},{}\n", p.x(), p.y(), p.z()));
    return fmt::format("touchstone query {} --in {} --with exact,{} --task {} --out answers.csv",
                       points, mesh, contestant.info->name, contestant.task_name());
  }

 private:
  std::optional<std::pair<MeshTarget, Vec3d>> in_form(std::size_t i, CaseForm form) const {
    const FormNumbers numbers = points_.numbers(i);
    const MeshTarget& target = points_.target(i);
    if (form == CaseForm::scaled) {
      return std::pair(target.scaled(numbers.scale), Vec3d(numbers.scale * points_[i]));
    }
    if (form != CaseForm::moved) return std::nullopt;
    const Vec3d shift = target.scale * numbers.shift;
    auto moved = target.moved(numbers, shift);
    const auto point = exact_sum(numbers.turn(points_[i]), shift);
    if (!moved || !point) return std::nullopt;
    return std::pair(std::move(*moved), *point);
  }

  const PointAnswer& truth(std::size_t i, PointTask task) {
    auto& known = truths_[static_cast<std::size_t>(task)];
    if (known.empty())
      known = points_.answers(point_solver(*registry::find<PointQueryEntry>("exact"), task));
    return known[i];
  }

  Graded grade(const PointQueryEntry& entry, PointTask task, std::size_t i, PointAnswer answer,
               double scale) {
    answer.distance /= scale;
    const double reach = point_reach(points_[i], points_.target(i).mesh);
    return grade_point(task, answer, truth(i, task), entry.scalar, reach);
  }

  bool is_closed_;
  MeshCases<Vec3d, PointAnswer> points_;
  std::array<std::vector<PointAnswer>, 2> truths_;
};

constexpr std::array<std::string_view, 2> point_tasks = {"closest", "side"};

std::vector<Family> point_families() {
  std::vector<Family> list;
  // First with closed meshes, for which points have a side, then with any.
  for (const char* prefix : {"points-", "points-any-mesh-"}) {
    for (const families::PointPlace place : families::all_point_places) {
      list.push_back({.name = prefix + std::string(to_string(place)), .group = "points"});
    }
  }
  add_axis(list, "point-gap", point_gaps());
  return list;
}

}  // namespace

const Kind& point_kind() {
  static const KindOf<PointQueryEntry> kind(
      {.registry = kind_words<PointQueryEntry>,
       .title = "Points",
       .contract = "point query",
       .legend = "A contact is a point inside or on the surface. *Inexact*: inside for on the "
                 "surface, or a distance that is off by more than 1e-14 of the reach (float: "
                 "1e-6), which is the greatest distance of the point and the mesh from the origin.",
       .tasks = point_tasks,
       .draw_number = 3},
      {.options = point_options,
       .read = read_point_questions,
       .verify = verify_point_proofs,
       .offers =
           [](const PointQueryEntry& entry, Precision scalar, std::uint8_t task) {
             return scalar == entry.scalar &&
                    std::ranges::count(entry.tasks, static_cast<PointTask>(task)) > 0;
           },
       .families = point_families,
       .draw = drawn_batch<PointBatch>,
       .sets = point_sets});
  return kind;
}

}  // namespace touchstone::kinds
