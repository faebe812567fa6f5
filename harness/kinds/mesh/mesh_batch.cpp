// The kind of pairs of bodies that need not be convex: batches, contestants.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "algorithms/core/nearest_float.h"
#include "harness/base/hash.h"
#include "harness/files/text_file.h"
#include "harness/kinds/exact_forms.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/mesh/mesh_grade.h"
#include "harness/kinds/mesh/mesh_kind.h"

namespace touchstone::kinds {
namespace {

using files::ConcaveCase;

// Bodies 2i and 2i + 1 are case i's, bound together.
struct PairedBodies {
  std::vector<ConcaveBody> bodies;
  std::vector<Pose> poses;

  void add(const ConcaveCase& c) {
    bodies.push_back(c.a);
    bodies.push_back(c.b);
    poses.push_back(c.pose_a);
    poses.push_back(c.pose_b);
  }
};

MeshAnswer answer_of(ConcavePhase& phase, ConcaveTask task, const PairedBodies& all,
                     std::size_t i) {
  Outcome outcome;
  std::vector<IndexPair> pairs;
  const auto body = static_cast<std::uint32_t>(2 * i);
  phase.solve(task, {body, all.poses[body]}, {body + 1, all.poses[body + 1]}, outcome, pairs);
  return {outcome.status, outcome.answer, outcome.distance,      outcome.lower,
          outcome.upper,  pairs.size(),   base::pair_hash(pairs)};
}

void change_points(ConcaveBody& body, const auto& change) {
  if (!body.mesh) return;
  TriangleMesh mesh = *body.mesh;
  for (Vec3d& vertex : mesh.vertices) vertex = change(vertex);
  body.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
}

// The bodies as an algorithm in float gets them.
ConcaveCase rounded_case(ConcaveCase c) {
  for (ConcaveBody* body : {&c.a, &c.b}) {
    change_points(*body, [](const Vec3d& v) { return nearest_float(v); });
  }
  for (Pose* pose : {&c.pose_a, &c.pose_b}) {
    for (int k = 0; k < 3; ++k) pose->rotation.col(k) = nearest_float(Vec3d(pose->rotation.col(k)));
    pose->translation = nearest_float(pose->translation);
  }
  return c;
}

bool is_of_meshes(const ConcaveCase& c) { return c.a.mesh && c.b.mesh; }

ConcaveCase scaled_case(ConcaveCase c, double scale) {
  for (ConcaveBody* body : {&c.a, &c.b}) {
    change_points(*body, [&](const Vec3d& v) { return Vec3d(scale * v); });
  }
  c.pose_a.translation *= scale;
  c.pose_b.translation *= scale;
  return c;
}

std::optional<ConcaveCase> moved_case(ConcaveCase c, const FormNumbers& numbers) {
  for (Pose* pose : {&c.pose_a, &c.pose_b}) {
    pose->rotation = numbers.turn(pose->rotation);
    const auto sum = exact_sum(numbers.turn(pose->translation), numbers.shift);
    if (!sum) return std::nullopt;
    pose->translation = *sum;
  }
  return c;
}

class MeshBatch final : public Batch {
 public:
  MeshBatch(std::uint32_t number, const BatchRange& range)
      : family_(mesh_families()[number]), range_(range) {
    for (std::uint64_t index = range.first; index < range.first + range.count; ++index) {
      auto draws = draws_of(mesh_kind(), number, range.seed, index);
      ConcaveCase& c = cases_.emplace_back(family_.draw(draws, index));
      c.id = fmt::format("{}/{}", family_.name, index);
    }
  }

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    const auto& entry = contestant.of<ConcaveEntry>();
    const auto task = static_cast<ConcaveTask>(contestant.task);
    PairedBodies all;
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const std::uint64_t index = range_.first + i;
      // The exact distance of meshes takes long.
      const bool is_long = task == ConcaveTask::distance && family_.group != "triangles";
      if (!is_asked(form, index) || (is_long && !is_sampled(index))) continue;
      const std::optional<ConcaveCase> c = in_form(cases_[i], contestant.scalar, form, index);
      if (!c || (entry.supports != nullptr && !entry.supports(c->a, c->b))) continue;
      all.add(*c);
      asked.push_back(i);
    }
    std::vector<Graded> grades(cases_.size());
    if (asked.empty()) return grades;
    const auto solved =
        process::isolated_answers<MeshAnswer>(asked.size(), batch_limits(time_limit), [&] {
          const std::shared_ptr<ConcavePhase> phase = make_phase(entry, contestant.scalar, false);
          phase->bind(all.bodies);
          return [&, phase](std::size_t i) { return answer_of(*phase, task, all, i); };
        });
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const std::size_t i = asked[k];
      const FormNumbers numbers(range_.seed, range_.first + i);
      grades[i] = grade(contestant, i, solved.answers[k], form == CaseForm::swapped,
                        form == CaseForm::scaled ? numbers.scale : 1);
    }
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string file = stem.string() + ".jsonl";
    files::write_text(file, files::to_json(cases_[place]) + "\n");
    return fmt::format("touchstone query {} --with {} --task {} --scalar {} --out answers.csv",
                       file, contestant.info->name, contestant.task_name(),
                       to_string(contestant.scalar));
  }

 private:
  // The bits that an algorithm in this precision is given.
  static ConcaveCase given(const ConcaveCase& c, Precision scalar) {
    return scalar == Precision::float64 ? c : rounded_case(c);
  }

  std::optional<ConcaveCase> in_form(const ConcaveCase& c, Precision scalar, CaseForm form,
                                     std::uint64_t index) const {
    const FormNumbers numbers(range_.seed, index);
    switch (form) {
      case CaseForm::as_drawn: return given(c, scalar);
      case CaseForm::swapped: {
        ConcaveCase other = given(c, scalar);
        std::swap(other.a, other.b);
        std::swap(other.pose_a, other.pose_b);
        return other;
      }
      case CaseForm::scaled:
        // Convex shapes keep their sizes.
        if (!is_of_meshes(c)) return std::nullopt;
        return scaled_case(given(c, scalar), numbers.scale);
      case CaseForm::moved:
        if (scalar == Precision::float32) return std::nullopt;
        return moved_case(c, numbers);
      default: return std::nullopt;
    }
  }

  const MeshAnswer& truth(std::size_t i, Precision scalar, bool distance, bool swapped) {
    const std::size_t which =
        (scalar == Precision::float64 ? 0 : 1) + (distance ? 2 : 0) + (swapped ? 4 : 0);
    auto& known = truths_[which];
    known.resize(cases_.size());
    if (!known[i]) {
      PairedBodies pair;
      ConcaveCase c = given(cases_[i], scalar);
      if (swapped) {
        std::swap(c.a, c.b);
        std::swap(c.pose_a, c.pose_b);
      }
      pair.add(c);
      const auto exact =
          make_phase(*registry::find<ConcaveEntry>("exact"), Precision::float64, false);
      exact->bind(pair.bodies);
      known[i] =
          answer_of(*exact, distance ? ConcaveTask::distance : ConcaveTask::contacts, pair, 0);
    }
    return *known[i];
  }

  Graded grade(const Contestant& contestant, std::size_t i, MeshAnswer answer, bool swapped,
               double scale) {
    for (double* length : {&answer.distance, &answer.lower, &answer.upper}) *length /= scale;
    const auto task = static_cast<ConcaveTask>(contestant.task);
    const MeshAnswer& exact = truth(i, contestant.scalar, false, swapped);
    const bool is_measured = task == ConcaveTask::distance && is_meant(answer.status) &&
                             answer.answer == Answer::separated;
    const MeshAnswer* exact_distance =
        is_measured ? &truth(i, contestant.scalar, true, false) : nullptr;
    const ConcaveCase& c = cases_[i];
    return grade_mesh(task, answer, exact, exact_distance, contestant.scalar,
                      mesh_reach(c.a, c.pose_a, c.b, c.pose_b));
  }

  const DrawnFamily<ConcaveCase>& family_;
  BatchRange range_;
  std::vector<ConcaveCase> cases_;
  std::array<std::vector<std::optional<MeshAnswer>>, 8> truths_;
};

constexpr std::array<std::string_view, 3> mesh_tasks = {"intersect", "distance", "contacts"};

}  // namespace

const Kind& mesh_kind() {
  static const KindOf<ConcaveEntry> kind(
      {.registry = kind_words<ConcaveEntry>,
       .title = "Bodies that need not be convex",
       .contract = "concave phase",
       .legend = "A contact is a shared point. *Inexact*: another list of pairs of parts, a "
                 "distance that is off by more than 1e-11 of the reach (float: 1e-5), or a bound "
                 "that does not hold.",
       .tasks = mesh_tasks,
       .draw_number = 1},
      {.options = mesh_options,
       .read = read_mesh_questions,
       .verify = verify_mesh_proofs,
       .offers =
           [](const ConcaveEntry& entry, Precision scalar, std::uint8_t task) {
             return offers(entry, static_cast<ConcaveTask>(task), scalar);
           },
       .promises = [](const ConcaveEntry& entry) { return !entry.approximate; },
       .families = [] { return families_of(mesh_families()); },
       .draw = drawn_batch<MeshBatch>,
       .sets = mesh_sets});
  return kind;
}

}  // namespace touchstone::kinds
