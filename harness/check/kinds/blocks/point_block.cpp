// Points and closed triangle meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "harness/check/kinds/blocks/grading.h"
#include "harness/check/kinds/blocks/mesh_cases.h"
#include "harness/check/kinds/blocks/other_axes.h"
#include "harness/families/tried_points.h"
#include "harness/files/text_file.h"
#include "harness/scene/writing/scene_writer.h"

namespace touchstone::check {
namespace {

constexpr std::size_t point_places = families::all_point_places.size();

const std::vector<families::NamedMesh>& point_meshes(bool is_closed) {
  static const std::vector<families::NamedMesh> closed = families::closed_meshes();
  static const std::vector<families::NamedMesh> any = families::ray_meshes();
  return is_closed ? closed : any;
}

auto drawing_points(std::uint32_t number) {
  return [number](const TriangleMesh& mesh, std::size_t triangle, families::Draws& draws) {
    if (number < 2 * point_places) {
      return tried_point(families::all_point_places[number % point_places], mesh, triangle, draws);
    }
    return families::point_off(point_axis()[number - 2 * point_places].of, mesh, triangle, draws);
  };
}

auto solver_of(const PointQueryEntry& entry, PointTask task) {
  return
      [task, query = std::shared_ptr<PointQuery>(entry.make())](
          const TriangleMesh& mesh, std::span<const Vec3d> points, std::span<PointAnswer> answers) {
        query->bind(mesh);
        query->query(task, points, answers);
      };
}

class PointBlock final : public CaseBlock {
 public:
  // First those of closed meshes, then those of any, then those of the axis, with closed ones.
  PointBlock(std::uint32_t number, const BlockRange& range)
      : place_(families::all_point_places[number % point_places]),
        is_closed_(number / point_places != 1),
        range_(range),
        points_(point_meshes(is_closed_), CaseKind::points, number, range, drawing_points(number),
                [](const Vec3d& point, double scale) { return Vec3d(scale * point); }) {}

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    const auto& entry = *std::get<const PointQueryEntry*>(contestant.entry);
    const auto task = static_cast<PointTask>(contestant.task);
    std::vector<GradedCase> grades(points_.size());
    if (task == PointTask::side && !is_closed_) return grades;
    points_.ask(
        form, time_limit, [&](std::size_t i) { return in_form(i, form); },
        [&] { return solver_of(entry, task); },
        [&](std::size_t i, const PointAnswer& answer) {
          const double scale = form == CaseForm::scaled ? points_.numbers(i).scale : 1;
          grades[i] = grade(entry, task, i, answer, scale);
        });
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    scene::write_off(stem.string() + ".off", points_.mesh(place));
    const Vec3d& p = points_[place];
    files::write_text(stem.string() + ".csv",
                      fmt::format("x,y,z\n{},{},{}\n", p.x(), p.y(), p.z()));
    return fmt::format("touchstone check --points {} --regimes points-{}{} --seed {} --cases {}",
                       contestant.info().name, is_closed_ ? "" : "any-mesh-", to_string(place_),
                       range_.seed, range_.first + place + 1);
  }

 private:
  std::optional<std::pair<TriangleMesh, Vec3d>> in_form(std::size_t i, CaseForm form) const {
    const FormNumbers numbers = points_.numbers(i);
    TriangleMesh mesh = points_.mesh(i);
    if (form == CaseForm::scaled) {
      for (Vec3d& vertex : mesh.vertices) vertex *= numbers.scale;
      return std::pair(std::move(mesh), Vec3d(numbers.scale * points_[i]));
    }
    if (form != CaseForm::moved) return std::nullopt;
    const Vec3d shift = points_.scale(i) * numbers.shift;
    auto moved = moved_mesh(std::move(mesh), numbers, shift);
    const auto point = exact_sum(numbers.turn(points_[i]), shift);
    if (!moved || !point) return std::nullopt;
    return std::pair(std::move(*moved), *point);
  }

  const PointAnswer& truth(std::size_t i, PointTask task) {
    auto& known = truths_[static_cast<std::size_t>(task)];
    if (known.empty())
      known = points_.answers(solver_of(*registry::find<PointQueryEntry>("exact"), task));
    return known[i];
  }

  GradedCase grade(const PointQueryEntry& entry, PointTask task, std::size_t i,
                   const PointAnswer& answer, double scale) {
    const PointAnswer& exact = truth(i, task);
    const bool is_side = task == PointTask::side;
    const bool is_contact = is_side ? exact.side != PointSide::outside : exact.distance == 0;
    const auto with = [&](CaseGrade grade) { return GradedCase{grade, is_contact}; };
    const bool is_unknown = is_side && answer.side == PointSide::unknown;
    if (const auto by_status = grade_of_status(answer.status, is_unknown)) return with(*by_status);
    if (is_side) {
      const bool contact = answer.side != PointSide::outside;
      if (const auto by_verdict = grade_of_verdict(contact, is_contact)) return with(*by_verdict);
      return with(answer.side == exact.side ? CaseGrade::right : CaseGrade::wrong);
    }
    if (std::isnan(exact.distance) && std::isnan(answer.distance)) return with(CaseGrade::right);
    double reach = points_[i].norm();
    for (const Vec3d& v : points_.mesh(i).vertices) reach = std::max(reach, v.norm());
    // Some roundings of the coordinates.
    const double tolerance = entry.scalar == Precision::float64 ? 1e-14 : 1e-6;
    const bool is_near = std::abs(answer.distance / scale - exact.distance) <= tolerance * reach;
    return with(is_near ? CaseGrade::right : CaseGrade::wrong);
  }

  families::PointPlace place_;
  bool is_closed_;
  BlockRange range_;
  MeshCases<Vec3d, PointAnswer> points_;
  std::array<std::vector<PointAnswer>, 2> truths_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_point_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<PointBlock>(number, range);
}

}  // namespace touchstone::check
