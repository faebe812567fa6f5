// Points and closed triangle meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "harness/check/kinds/blocks/grading.h"
#include "harness/check/kinds/blocks/mesh_targets.h"
#include "harness/check/kinds/blocks/other_axes.h"
#include "harness/families/tried_points.h"
#include "harness/files/text_file.h"

namespace touchstone::check {
namespace {

// Points of one call, and their mesh; a crash costs them all.
struct PointCall {
  std::size_t mesh;
  std::vector<std::size_t> places;
  std::vector<Vec3d> points;
};

struct PointCallAnswer {
  Status status = Status::unsupported;
  std::array<PointAnswer, cases_of_a_mesh> answers;
};

class PointBlock final : public CaseBlock {
  static constexpr std::size_t places = families::all_point_places.size();

 public:
  // First those of closed meshes, then those of any, then those of the axis, with closed ones.
  PointBlock(std::uint32_t number, const BlockRange& range)
      : place_(families::all_point_places[number % places]),
        is_closed_(number / places != 1),
        range_(range) {
    const double distance = number < 2 * places ? 0 : point_axis()[number - 2 * places].of;
    static const std::vector<families::NamedMesh> closed = families::closed_meshes();
    static const std::vector<families::NamedMesh> any = families::ray_meshes();
    const std::vector<families::NamedMesh>& meshes = is_closed_ ? closed : any;
    first_group_ = range.first / cases_of_a_mesh;
    for (std::size_t i = 0; i < range.count; ++i) {
      const std::uint64_t index = range.first + i;
      while (targets_.size() <= index / cases_of_a_mesh - first_group_) {
        targets_.emplace_back(meshes, base::mix(range.seed) + number,
                              first_group_ + targets_.size());
      }
      const MeshTarget& target = targets_[mesh_of(i)];
      auto draws = draws_of(CaseKind::points, number, range.seed, index);
      const int triangles = static_cast<int>(target.mesh.triangles.size());
      TriangleMesh unscaled = target.mesh;
      for (Vec3d& vertex : unscaled.vertices) vertex /= target.scale;
      const auto triangle = static_cast<std::size_t>(triangles > 0 ? draws.below(triangles) : 0);
      points_.push_back(target.scale *
                        (number < 2 * places
                             ? tried_point(place_, unscaled, triangle, draws)
                             : families::point_off(distance, unscaled, triangle, draws)));
    }
  }

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    const auto& entry = *std::get<const PointQueryEntry*>(contestant.entry);
    const auto task = static_cast<PointTask>(contestant.task);
    std::vector<GradedCase> grades(points_.size());
    if (task == PointTask::side && !is_closed_) return grades;
    std::vector<TriangleMesh> meshes;
    std::vector<PointCall> calls;
    if (form == CaseForm::as_drawn) {
      for (const MeshTarget& target : targets_) meshes.push_back(target.mesh);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      if (form == CaseForm::as_drawn) {
        if (calls.empty() || calls.back().mesh != mesh_of(i)) calls.push_back({mesh_of(i), {}, {}});
        calls.back().places.push_back(i);
        calls.back().points.push_back(points_[i]);
      } else {
        auto other = in_form(i, form);
        if (!other) continue;
        meshes.push_back(std::move(other->first));
        calls.push_back({meshes.size() - 1, {i}, {other->second}});
      }
    }
    if (calls.empty()) return grades;
    const auto solved =
        process::isolated_answers<PointCallAnswer>(calls.size(), block_limits(time_limit), [&] {
          const std::shared_ptr<PointQuery> query = entry.make();
          return [&, query](std::size_t k) {
            PointCallAnswer answer;
            answer.status = Status::ok;
            query->bind(meshes[calls[k].mesh]);
            query->query(task, calls[k].points,
                         std::span(answer.answers).first(calls[k].points.size()));
            return answer;
          };
        });
    for (std::size_t k = 0; k < calls.size(); ++k) {
      for (std::size_t at = 0; at < calls[k].places.size(); ++at) {
        const std::size_t i = calls[k].places[at];
        PointAnswer answer = solved.answers[k].answers[at];
        if (solved.answers[k].status != Status::ok) answer.status = solved.answers[k].status;
        const FormNumbers numbers(range_.seed, range_.first + i);
        const double scale = form == CaseForm::scaled ? numbers.scale : 1;
        grades[i] = grade(task, i, answer, scale);
      }
    }
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    write_mesh(stem.string() + ".off", targets_[mesh_of(place)].mesh);
    const Vec3d& p = points_[place];
    files::write_text(stem.string() + ".csv",
                      fmt::format("x,y,z\n{},{},{}\n", p.x(), p.y(), p.z()));
    return fmt::format("touchstone check --points {} --regimes points-{}{} --seed {} --cases {}",
                       contestant.info().name, is_closed_ ? "" : "any-mesh-", to_string(place_),
                       range_.seed, range_.first + place + 1);
  }

 private:
  std::size_t mesh_of(std::size_t place) const {
    return static_cast<std::size_t>((range_.first + place) / cases_of_a_mesh - first_group_);
  }

  std::optional<std::pair<TriangleMesh, Vec3d>> in_form(std::size_t i, CaseForm form) const {
    const FormNumbers numbers(range_.seed, range_.first + i);
    const MeshTarget& target = targets_[mesh_of(i)];
    TriangleMesh mesh = target.mesh;
    if (form == CaseForm::scaled) {
      for (Vec3d& vertex : mesh.vertices) vertex *= numbers.scale;
      return std::pair(std::move(mesh), Vec3d(numbers.scale * points_[i]));
    }
    if (form != CaseForm::moved) return std::nullopt;
    const Vec3d shift = target.scale * numbers.shift;
    auto moved = moved_mesh(std::move(mesh), numbers, shift);
    const auto point = exact_sum(numbers.turn(points_[i]), shift);
    if (!moved || !point) return std::nullopt;
    return std::pair(std::move(*moved), *point);
  }

  const PointAnswer& truth(std::size_t i, PointTask task) {
    auto& known = truths_[static_cast<std::size_t>(task)];
    if (known.empty()) {
      known.resize(points_.size());
      const auto exact = find_point_query("exact")->make();
      for (std::size_t place = 0; place < points_.size(); ++place) {
        if (place == 0 || mesh_of(place) != mesh_of(place - 1)) {
          exact->bind(targets_[mesh_of(place)].mesh);
        }
        exact->query(task, {&points_[place], 1}, {&known[place], 1});
      }
    }
    return known[i];
  }

  GradedCase grade(PointTask task, std::size_t i, const PointAnswer& answer, double scale) {
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
    for (const Vec3d& v : targets_[mesh_of(i)].mesh.vertices) reach = std::max(reach, v.norm());
    const bool is_near = std::abs(answer.distance / scale - exact.distance) <= 1e-14 * reach;
    return with(is_near ? CaseGrade::right : CaseGrade::wrong);
  }

  families::PointPlace place_;
  bool is_closed_;
  BlockRange range_;
  std::uint64_t first_group_ = 0;
  std::vector<MeshTarget> targets_;
  std::vector<Vec3d> points_;
  std::array<std::vector<PointAnswer>, 2> truths_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_point_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<PointBlock>(number, range);
}

}  // namespace touchstone::check
