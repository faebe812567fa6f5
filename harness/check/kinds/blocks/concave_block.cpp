// Pairs of bodies that need not be convex.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/core/nearest_float.h"
#include "harness/base/hash.h"
#include "harness/check/kinds/blocks/drawn_cases.h"
#include "harness/check/kinds/blocks/exact_forms.h"
#include "harness/check/kinds/blocks/grading.h"
#include "harness/files/text_file.h"

namespace touchstone::check {
namespace {

using files::ConcaveCase;

// What an algorithm answers, in a form that another process can send.
struct PairAnswer {
  Status status = Status::unsupported;
  Answer answer = Answer::unknown;
  double distance = Outcome::none, lower = Outcome::none, upper = Outcome::none;
  std::uint64_t pairs = 0, hash = 0;
};

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

PairAnswer answer_of(ConcavePhase& phase, ConcaveTask task, const PairedBodies& all,
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
ConcaveCase rounded(ConcaveCase c) {
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

ConcaveCase scaled(ConcaveCase c, double scale) {
  for (ConcaveBody* body : {&c.a, &c.b}) {
    change_points(*body, [&](const Vec3d& v) { return Vec3d(scale * v); });
  }
  c.pose_a.translation *= scale;
  c.pose_b.translation *= scale;
  return c;
}

std::optional<ConcaveCase> moved(ConcaveCase c, const FormNumbers& numbers) {
  for (Pose* pose : {&c.pose_a, &c.pose_b}) {
    pose->rotation = numbers.turn(pose->rotation);
    const auto sum = exact_sum(numbers.turn(pose->translation), numbers.shift);
    if (!sum) return std::nullopt;
    pose->translation = *sum;
  }
  return c;
}

double reach_of(const ConcaveCase& c) {
  double reach = 1;
  for (const auto& [body, pose] : {std::pair(&c.a, &c.pose_a), std::pair(&c.b, &c.pose_b)}) {
    double size = 4;
    if (body->mesh) {
      for (const Vec3d& v : body->mesh->vertices) size = std::max(size, v.cwiseAbs().maxCoeff());
    }
    reach = std::max(reach, 2 * size + pose->translation.cwiseAbs().maxCoeff());
  }
  return reach;
}

class ConcaveBlock final : public CaseBlock {
 public:
  ConcaveBlock(std::uint32_t number, const BlockRange& range)
      : family_(concave_families()[number]), range_(range) {
    for (std::uint64_t index = range.first; index < range.first + range.count; ++index) {
      auto draws = draws_of(CaseKind::concave, number, range.seed, index);
      ConcaveCase& c = cases_.emplace_back(family_.draw(draws, index));
      c.id = fmt::format("{}/{}", family_.name, index);
    }
  }

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    const auto& entry = *std::get<const ConcaveEntry*>(contestant.entry);
    const auto task = static_cast<ConcaveTask>(contestant.task);
    PairedBodies all;
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const std::uint64_t index = range_.first + i;
      // The exact distance of meshes takes long.
      const bool is_long = task == ConcaveTask::distance && family_.group != "triangles";
      if (!is_asked(form, index) || (is_long && index % 5 != 0)) continue;
      const std::optional<ConcaveCase> c = in_form(cases_[i], contestant.scalar, form, index);
      if (!c || (entry.supports != nullptr && !entry.supports(c->a, c->b))) continue;
      all.add(*c);
      asked.push_back(i);
    }
    std::vector<GradedCase> grades(cases_.size());
    if (asked.empty()) return grades;
    const auto solved =
        process::isolated_answers<PairAnswer>(asked.size(), block_limits(time_limit), [&] {
          const std::shared_ptr<ConcavePhase> phase = entry.make(settings(contestant.scalar));
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
    return fmt::format("touchstone query {} --narrow {} --task {} --scalar {} --out answers.csv",
                       file, contestant.info().name, contestant.task_name(),
                       to_string(contestant.scalar));
  }

 private:
  static ConcaveSettings settings(Precision scalar) {
    return {.scalar = scalar,
            .mid_phase = registry::find<MidPhaseEntry>("wide-bvh")->make,
            .narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); }};
  }

  // The bits that an algorithm in this precision is given.
  static ConcaveCase given(const ConcaveCase& c, Precision scalar) {
    return scalar == Precision::float64 ? c : rounded(c);
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
        return scaled(given(c, scalar), numbers.scale);
      case CaseForm::moved:
        if (scalar == Precision::float32) return std::nullopt;
        return moved(c, numbers);
      default: return std::nullopt;
    }
  }

  const PairAnswer& truth(std::size_t i, Precision scalar, bool distance, bool swapped) {
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
      const auto exact = registry::find<ConcaveEntry>("exact")->make(settings(Precision::float64));
      exact->bind(pair.bodies);
      known[i] =
          answer_of(*exact, distance ? ConcaveTask::distance : ConcaveTask::contacts, pair, 0);
    }
    return *known[i];
  }

  GradedCase grade(const Contestant& contestant, std::size_t i, const PairAnswer& answer,
                   bool swapped, double scale) {
    const PairAnswer& exact = truth(i, contestant.scalar, false, swapped);
    const bool is_contact = exact.answer == Answer::touching || exact.answer == Answer::overlapping;
    const auto with = [&](CaseGrade grade) { return GradedCase{grade, is_contact}; };
    if (const auto by_status = grade_of_status(answer.status, answer.answer == Answer::unknown)) {
      return with(*by_status);
    }
    if (exact.answer == Answer::unknown) return with(CaseGrade::unresolved);
    const bool contact = answer.answer != Answer::separated;
    if (const auto by_verdict = grade_of_verdict(contact, is_contact)) return with(*by_verdict);
    const auto task = static_cast<ConcaveTask>(contestant.task);
    if (task == ConcaveTask::contacts && exact.status == Status::ok &&
        (answer.pairs != exact.pairs || answer.hash != exact.hash)) {
      return with(CaseGrade::wrong);
    }
    if (task == ConcaveTask::distance && !contact && is_far_off(contestant, i, answer, scale)) {
      return with(CaseGrade::wrong);
    }
    return with(CaseGrade::right);
  }

  bool is_far_off(const Contestant& contestant, std::size_t i, const PairAnswer& answer,
                  double scale) {
    const PairAnswer& exact = truth(i, contestant.scalar, true, false);
    const double share = contestant.scalar == Precision::float64 ? 1e-11 : 1e-5;
    const double margin = share * reach_of(cases_[i]);
    const double distance = answer.distance / scale;
    const bool bounds_hold = std::isnan(answer.lower) || (answer.lower / scale <= exact.upper &&
                                                          answer.upper / scale >= exact.lower);
    return !(distance >= exact.lower - margin && distance <= exact.upper + margin) || !bounds_hold;
  }

  const DrawnFamily<ConcaveCase>& family_;
  BlockRange range_;
  std::vector<ConcaveCase> cases_;
  std::array<std::vector<std::optional<PairAnswer>>, 8> truths_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_concave_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<ConcaveBlock>(number, range);
}

}  // namespace touchstone::check
