// Cases of a block that are each one item, a ray or a point, at a triangle mesh: how they are drawn, asked together
// where they have one mesh, and answered exactly.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "harness/families/meshes.h"
#include "harness/kinds/exact_forms.h"
#include "harness/kinds/grading.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {

// So many consecutive cases have one mesh.
inline constexpr std::uint64_t cases_of_a_mesh = 25;

// The mesh of a group of cases: one of the list, at a scale. Every sixteenth may be a large one.
struct MeshTarget {
  TriangleMesh mesh;
  double scale = 1;  // a power of two

  MeshTarget(const std::vector<families::NamedMesh>& list, std::uint64_t seed,
             std::uint64_t group) {
    constexpr std::size_t large = 400;  // triangles
    base::Random random(seed, ~group);
    std::vector<const families::NamedMesh*> usual, any;
    for (const families::NamedMesh& named : list) {
      any.push_back(&named);
      if (named.mesh.triangles.size() < large) usual.push_back(&named);
    }
    const auto& from = random.below(16) == 0 ? any : usual;
    constexpr std::array scales = {1.0, 1.0, 0x1p-20, 0x1p20};
    scale = scales[random.below(4)];
    mesh = from[random.below(from.size())]->mesh;
    for (Vec3d& vertex : mesh.vertices) vertex *= scale;
  }
};

// The mesh in another form, or nothing if that rounds a vertex.
inline std::optional<TriangleMesh> moved_mesh(TriangleMesh mesh, const FormNumbers& numbers,
                                              const Vec3d& shift) {
  for (Vec3d& vertex : mesh.vertices) {
    const auto sum = exact_sum(numbers.turn(vertex), shift);
    if (!sum) return std::nullopt;
    vertex = *sum;
  }
  return mesh;
}

// Answer has a member `status`.
template <class Item, class Answer>
class MeshCases {
 public:
  // draw(mesh, triangle, draws) gives an item at a mesh without its scale, near one of its triangles, and
  // scaled(item, scale) the item at the scaled mesh.
  template <class Draw, class Scaled>
  MeshCases(const std::vector<families::NamedMesh>& meshes, const Kind& kind, std::uint32_t number,
            const BatchRange& range, const Draw& draw, const Scaled& scaled)
      : range_(range), first_group_(range.first / cases_of_a_mesh) {
    for (std::size_t i = 0; i < range.count; ++i) {
      while (targets_.size() <= target_of(i)) {
        targets_.emplace_back(meshes, base::mix(range.seed) + number,
                              first_group_ + targets_.size());
      }
      auto draws = draws_of(kind, number, range.seed, range.first + i);
      const int triangles = static_cast<int>(mesh(i).triangles.size());
      TriangleMesh unscaled = mesh(i);
      for (Vec3d& vertex : unscaled.vertices) vertex /= scale(i);
      const auto triangle = static_cast<std::size_t>(triangles > 0 ? draws.below(triangles) : 0);
      items_.push_back(scaled(draw(unscaled, triangle, draws), scale(i)));
    }
  }

  std::size_t size() const { return items_.size(); }
  const Item& operator[](std::size_t i) const { return items_[i]; }
  const TriangleMesh& mesh(std::size_t i) const { return targets_[target_of(i)].mesh; }
  double scale(std::size_t i) const { return targets_[target_of(i)].scale; }
  FormNumbers numbers(std::size_t i) const { return {range_.seed, range_.first + i}; }

  // Asks all cases that the form is asked for, those of one mesh in one call; in another form than as drawn
  // each case has a mesh of its own, in_form(i), or is left out. make_solver() is called in the process that
  // answers, and gives solve(mesh, items, answers); take(i, answer) gets each answer.
  template <class InForm, class MakeSolver, class Take>
  void ask(CaseForm form, double time_limit, const InForm& in_form, const MakeSolver& make_solver,
           const Take& take) const {
    std::vector<TriangleMesh> meshes;  // of other forms
    std::vector<Call> calls;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      if (form == CaseForm::as_drawn) {
        if (calls.empty() || calls.back().mesh != target_of(i)) {
          calls.push_back({target_of(i), {}, {}});
        }
        calls.back().places.push_back(i);
        calls.back().items.push_back(items_[i]);
      } else if (auto other = in_form(i)) {
        calls.push_back({meshes.size(), {i}, {other->second}});
        meshes.push_back(std::move(other->first));
      }
    }
    if (calls.empty()) return;
    const auto solved =
        process::isolated_answers<CallAnswer>(calls.size(), batch_limits(time_limit), [&] {
          return [&, solve = make_solver()](std::size_t k) {
            const Call& call = calls[k];
            CallAnswer answer;
            answer.status = Status::ok;
            solve(form == CaseForm::as_drawn ? targets_[call.mesh].mesh : meshes[call.mesh],
                  std::span<const Item>(call.items),
                  std::span<Answer>(answer.answers).first(call.items.size()));
            return answer;
          };
        });
    for (std::size_t k = 0; k < calls.size(); ++k) {
      for (std::size_t at = 0; at < calls[k].places.size(); ++at) {
        Answer answer = solved.answers[k].answers[at];
        if (solved.answers[k].status != Status::ok) answer.status = solved.answers[k].status;
        take(calls[k].places[at], answer);
      }
    }
  }

  // The answers to all cases as they are drawn, in this process.
  template <class Solve>
  std::vector<Answer> answers(const Solve& solve) const {
    std::vector<Answer> all(items_.size());
    for (std::size_t first = 0, end = 0; first < items_.size(); first = end) {
      while (end < items_.size() && target_of(end) == target_of(first)) ++end;
      solve(mesh(first), std::span<const Item>(items_).subspan(first, end - first),
            std::span<Answer>(all).subspan(first, end - first));
    }
    return all;
  }

 private:
  // A crash costs all cases of a call.
  struct Call {
    std::size_t mesh;
    std::vector<std::size_t> places;
    std::vector<Item> items;
  };
  struct CallAnswer {
    Status status = Status::unsupported;
    std::array<Answer, cases_of_a_mesh> answers;
  };

  std::size_t target_of(std::size_t i) const {
    return static_cast<std::size_t>((range_.first + i) / cases_of_a_mesh - first_group_);
  }

  BatchRange range_;
  std::uint64_t first_group_;
  std::vector<MeshTarget> targets_;
  std::vector<Item> items_;
};

}  // namespace touchstone::kinds
