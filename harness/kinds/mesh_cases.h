// Cases of a batch that are each one item, a ray or a point, at a target, a mesh or a scene: how they are drawn, asked
// together where they have one target, and answered exactly.
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

namespace touchstone::kinds {

// So many consecutive cases have one target.
inline constexpr std::uint64_t cases_of_a_target = 25;

// Answer has a member `status`.
template <class Target, class Item, class Answer>
class TargetCases {
 public:
  // make_target(group) gives the target of a group of cases, and draw(index, target) the item of a case.
  template <class MakeTarget, class Draw>
  TargetCases(const BatchRange& range, const MakeTarget& make_target, const Draw& draw)
      : range_(range), first_group_(range.first / cases_of_a_target) {
    for (std::size_t i = 0; i < range.count; ++i) {
      while (targets_.size() <= target_of(i)) {
        targets_.push_back(make_target(first_group_ + targets_.size()));
      }
      items_.push_back(draw(range.first + i, target(i)));
    }
  }

  std::size_t size() const { return items_.size(); }
  const Item& operator[](std::size_t i) const { return items_[i]; }
  const Target& target(std::size_t i) const { return targets_[target_of(i)]; }
  FormNumbers numbers(std::size_t i) const { return {range_.seed, range_.first + i}; }

  // Asks all cases that the form is asked for, those of one target in one call; in another form than as drawn
  // each case has a target of its own, in_form(i), or is left out. make_solver() is called in the process that
  // answers, and gives solve(target, items, answers). Returns the grades, with grade(i, answer) of each answer.
  template <class InForm, class MakeSolver, class Grade>
  std::vector<Graded> ask(CaseForm form, double time_limit, const InForm& in_form,
                          const MakeSolver& make_solver, const Grade& grade) const {
    std::vector<Target> others;  // of other forms
    std::vector<Call> calls;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      if (form == CaseForm::as_drawn) {
        if (calls.empty() || calls.back().target != target_of(i)) {
          calls.push_back({target_of(i), {}, {}});
        }
        calls.back().places.push_back(i);
        calls.back().items.push_back(items_[i]);
      } else if (auto other = in_form(i)) {
        calls.push_back({others.size(), {i}, {other->second}});
        others.push_back(std::move(other->first));
      }
    }
    std::vector<Graded> grades(items_.size());
    ask_calls<Answer, cases_of_a_target>(
        calls, time_limit,
        [&] {
          return [&, solve = make_solver()](const Call& call, std::span<Answer> answers) {
            solve((form == CaseForm::as_drawn ? targets_ : others)[call.target],
                  std::span<const Item>(call.items), answers);
          };
        },
        [&](std::size_t i, const Answer& answer) { grades[i] = grade(i, answer); });
    return grades;
  }

  // Calls take(target, items) for the cases of each target as they are drawn.
  template <class Take>
  void for_each_target(const Take& take) const {
    for (std::size_t first = 0, end = 0; first < items_.size(); first = end) {
      while (end < items_.size() && target_of(end) == target_of(first)) ++end;
      take(target(first), std::span<const Item>(items_).subspan(first, end - first));
    }
  }
  // The answers to all cases as they are drawn, in this process.
  template <class Solve>
  std::vector<Answer> answers(const Solve& solve) const {
    std::vector<Answer> all;
    for_each_target([&](const Target& target, std::span<const Item> items) {
      all.resize(all.size() + items.size());
      solve(target, items, std::span<Answer>(all).last(items.size()));
    });
    return all;
  }

 private:
  struct Call {
    std::size_t target;
    std::vector<std::size_t> places;
    std::vector<Item> items;
  };

  std::size_t target_of(std::size_t i) const {
    return static_cast<std::size_t>((range_.first + i) / cases_of_a_target - first_group_);
  }

  BatchRange range_;
  std::uint64_t first_group_;
  std::vector<Target> targets_;
  std::vector<Item> items_;
};

// The mesh of a group of cases, at a scale.
struct MeshTarget {
  TriangleMesh mesh;
  double scale = 1;  // a power of two

  // A mesh of the list. Every sixteenth may be a large one.
  static MeshTarget drawn(const std::vector<families::NamedMesh>& list, std::uint64_t seed,
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
    const double scale = scales[random.below(4)];
    return MeshTarget{from[random.below(from.size())]->mesh}.scaled(scale);
  }

  MeshTarget scaled(double factor) const {
    MeshTarget other = *this;
    for (Vec3d& vertex : other.mesh.vertices) vertex *= factor;
    other.scale *= factor;
    return other;
  }
  // Turned and moved; nothing if that rounds a vertex.
  std::optional<MeshTarget> moved(const FormNumbers& numbers, const Vec3d& shift) const {
    MeshTarget other = *this;
    for (Vec3d& vertex : other.mesh.vertices) {
      const auto sum = exact_sum(numbers.turn(vertex), shift);
      if (!sum) return std::nullopt;
      vertex = *sum;
    }
    return other;
  }
};

template <class Item, class Answer>
using MeshCases = TargetCases<MeshTarget, Item, Answer>;

// draw(mesh, triangle, draws) gives an item at a mesh without its scale, near one of its triangles, and
// scaled(item, scale) the item at the scaled mesh.
template <class Item, class Answer, class Draw, class Scaled>
MeshCases<Item, Answer> mesh_cases(const std::vector<families::NamedMesh>& meshes, const Kind& kind,
                                   std::uint32_t number, const BatchRange& range, const Draw& draw,
                                   const Scaled& scaled) {
  return {range,
          [&](std::uint64_t group) {
            return MeshTarget::drawn(meshes, base::mix(range.seed) + number, group);
          },
          [&](std::uint64_t index, const MeshTarget& target) {
            auto draws = draws_of(kind, number, range.seed, index);
            const int triangles = static_cast<int>(target.mesh.triangles.size());
            TriangleMesh unscaled = target.mesh;
            for (Vec3d& vertex : unscaled.vertices) vertex /= target.scale;
            const auto triangle =
                static_cast<std::size_t>(triangles > 0 ? draws.below(triangles) : 0);
            return scaled(draw(unscaled, triangle, draws), target.scale);
          }};
}

}  // namespace touchstone::kinds
