// Moving bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "harness/check/kinds/blocks/drawn_cases.h"
#include "harness/check/kinds/blocks/grading.h"
#include "harness/check/kinds/blocks/motion/cast_forms.h"
#include "harness/check/kinds/blocks/motion/cast_truths.h"
#include "harness/files/text_file.h"
#include "harness/process/queries/solve_cast.h"

namespace touchstone::check {
namespace {

using files::CastCase;

// Cases of one call; a crash costs them all.
constexpr std::size_t casts_of_a_call = 24;

struct CastCallAnswer {
  Status status = Status::unsupported;
  std::array<CastOutcome, casts_of_a_call> outcomes;
};

struct CastCall {
  double tolerance = 0;  // metres
  std::vector<std::size_t> places;
  std::vector<CastParts> parts;  // of each place
};

void solve_call(const CastEntry& entry, const CastSettings& settings, const CastCall& call,
                CastCallAnswer& answer) {
  std::vector<const CastCase*> cases;
  for (const CastParts& parts : call.parts) cases.push_back(&parts[0]);
  process::solve_casts(entry, settings, cases, std::span(answer.outcomes).first(cases.size()));
  if (call.parts[0].size() == 1) return;
  // Contact is in the first half or in the second.
  CastOutcome& outcome = answer.outcomes[0];
  double offset = 0;
  if (outcome.answer == CastAnswer::miss) {
    outcome = process::solve_cast(entry, settings, call.parts[0][1]);
    offset = 0.5;
  }
  for (double* time : {&outcome.toi, &outcome.lower, &outcome.upper}) {
    *time = offset + 0.5 * *time;
  }
}

void put_far_away(CastCase& c) {
  const double size = std::exp2(std::floor(std::log2(span_of_motion(c))));
  for (Pose* pose : {&c.pose_a, &c.pose_b}) {
    pose->translation += 0x1p20 * size * Vec3d(1, -1, 0.5);
  }
}

class CastBlock final : public CaseBlock {
 public:
  CastBlock(std::uint32_t number, const BlockRange& range)
      : family_(cast_families()[number]), range_(range) {
    for (std::uint64_t index = range.first; index < range.first + range.count; ++index) {
      auto draws = draws_of(CaseKind::cast, number, range.seed, index);
      CastCase& c = cases_.emplace_back(family_.draw(draws, index));
      // A translation by a million sizes, which rounds the coordinates; the values of an axis would be lost.
      if (family_.axis.empty() && draws.below(6) == 0) put_far_away(c);
      c.id = fmt::format("{}/{}", family_.name, index);
    }
    truths_.emplace(cases_);
  }

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    std::vector<GradedCase> grades(cases_.size());
    const bool approach = static_cast<StartContact>(contestant.task) == StartContact::approach;
    if (approach && (form == CaseForm::reversed || form == CaseForm::split)) return grades;
    const std::vector<CastCall> calls = calls_of(contestant, form);
    if (calls.empty()) return grades;
    const auto& entry = *std::get<const CastEntry*>(contestant.entry);
    const auto solved =
        process::isolated_answers<CastCallAnswer>(calls.size(), block_limits(time_limit), [&] {
          return [&](std::size_t k) {
            CastSettings settings = settings_of(contestant);
            settings.tolerance = calls[k].tolerance;
            CastCallAnswer answer;
            answer.status = Status::ok;
            solve_call(entry, settings, calls[k], answer);
            return answer;
          };
        });
    for (std::size_t k = 0; k < calls.size(); ++k) {
      const Status status = solved.answers[k].status;
      for (std::size_t i = 0; i < calls[k].places.size(); ++i) {
        CastOutcome outcome = solved.answers[k].outcomes[i];
        if (status != Status::ok) outcome.status = status;
        grades[calls[k].places[i]] = grade(contestant, calls[k].places[i], outcome, form);
      }
    }
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string file = stem.string() + ".jsonl";
    files::write_text(file, files::to_json(cases_[place]) + "\n");
    return fmt::format(
        "touchstone cast {} --cast exact,{} --scalar {} --tolerance {} --start {} --out "
        "answers.csv",
        file, contestant.info().name, to_string(contestant.scalar), tolerance_of(contestant, place),
        contestant.task_name());
  }

 private:
  // Cases as they are drawn are asked together if their kinds and tolerances are equal, in other forms
  // one by one.
  std::vector<CastCall> calls_of(const Contestant& contestant, CaseForm form) const {
    const auto& entry = *std::get<const CastEntry*>(contestant.entry);
    const bool approach = static_cast<StartContact>(contestant.task) == StartContact::approach;
    std::vector<CastCall> calls;
    std::map<std::tuple<ShapeKind, ShapeKind, bool, double>, std::size_t> open;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const CastCase& c = cases_[i];
      const bool turns = process::turns(c);
      if (!is_asked(form, range_.first + i) || (approach && turns) ||
          !offers(entry, c.shape_a.kind, c.shape_b.kind, turns)) {
        continue;
      }
      CastParts parts = parts_in_form(c, FormNumbers(range_.seed, range_.first + i), form);
      if (parts.empty()) continue;
      const double tolerance = scale_of(i, form) * tolerance_of(contestant, i);
      const auto [a, b] = std::minmax(c.shape_a.kind, c.shape_b.kind);
      const auto at = open.find({a, b, turns, tolerance});
      std::size_t call = calls.size();
      if (form == CaseForm::as_drawn && at != open.end() &&
          calls[at->second].places.size() < casts_of_a_call) {
        call = at->second;
      } else {
        calls.push_back({tolerance, {}, {}});
        open[{a, b, turns, tolerance}] = call;
      }
      calls[call].places.push_back(i);
      calls[call].parts.push_back(std::move(parts));
    }
    return calls;
  }

  static CastSettings settings_of(const Contestant& contestant) {
    CastSettings settings;
    settings.scalar = contestant.scalar;
    settings.start = static_cast<StartContact>(contestant.task);
    return settings;
  }
  double scale_of(std::size_t i, CaseForm form) const {
    return form == CaseForm::scaled ? FormNumbers(range_.seed, range_.first + i).scale : 1;
  }
  double tolerance_of(const Contestant& contestant, std::size_t i) const {
    // A power of two, so that many cases have the same.
    return std::exp2(std::floor(std::log2(span_of_motion(cases_[i])))) *
           (contestant.scalar == Precision::float64 ? 1e-9 : 1e-4);
  }

  GradedCase grade(const Contestant& contestant, std::size_t i, const CastOutcome& outcome,
                   CaseForm form) {
    const double tolerance = tolerance_of(contestant, i);
    const bool approach = settings_of(contestant).start == StartContact::approach;
    const CastOutcome exact = approach ? truths_->of_approach(i, tolerance) : truths_->of(i);
    const GradedCase graded = grade(contestant, i, outcome, form, exact);
    const bool is_silent = graded.grade == CaseGrade::missed ||
                           graded.grade == CaseGrade::false_hit || graded.grade == CaseGrade::wrong;
    if (!is_silent || !rounds(cases_[i], form)) return graded;
    CastCallAnswer answer;
    const FormNumbers numbers(range_.seed, range_.first + i);
    solve_call(*registry::find<CastEntry>("exact"), {},
               {0, {i}, {parts_in_form(cases_[i], numbers, form)}}, answer);
    return grade(contestant, i, outcome, form, answer.outcomes[0]);
  }

  GradedCase grade(const Contestant& contestant, std::size_t i, const CastOutcome& outcome,
                   CaseForm form, const CastOutcome& exact) {
    const double tolerance = tolerance_of(contestant, i);
    const bool approach = settings_of(contestant).start == StartContact::approach;
    const bool is_contact = exact.answer == CastAnswer::hit;
    const auto with = [&](CaseGrade grade) { return GradedCase{grade, is_contact}; };
    const bool is_unknown = outcome.answer == CastAnswer::unknown;
    if (const auto by_status = grade_of_status(outcome.status, is_unknown)) return with(*by_status);
    if (exact.answer == CastAnswer::unknown) return with(CaseGrade::unresolved);
    const bool contact = outcome.answer == CastAnswer::hit;
    if (is_contact && !contact) return with(CaseGrade::missed);
    const bool is_backward = form == CaseForm::reversed;
    const double time = is_backward ? 1 - outcome.toi : outcome.toi;
    if (contact && !is_contact) {
      const bool proven = !std::isnan(outcome.upper);
      if (proven && contestant.info().origin != Origin::peer) return with(CaseGrade::false_hit);
      // The tolerance allows for no hit at the start of bodies that do not approach.
      if (approach && !(time > 0)) return with(CaseGrade::false_hit);
      return with(truths_->is_apart(i, time, tolerance) ? CaseGrade::false_hit : CaseGrade::near);
    }
    if (contact && !is_backward && is_off(contestant, i, outcome, exact, tolerance)) {
      return with(CaseGrade::wrong);
    }
    return with(CaseGrade::right);
  }

  // True if the time of impact is too late, or so early that the bodies are apart, or a bound is
  // wrong.
  bool is_off(const Contestant& contestant, std::size_t i, const CastOutcome& outcome,
              const CastOutcome& exact, double tolerance) {
    if (outcome.lower > exact.upper || outcome.upper < exact.lower) return true;
    const CastCase& c = cases_[i];
    // What is late is later than the tolerance takes, in a peer; ours are in time but for rounding.
    const double path =
        (c.motion_b.displacement - c.motion_a.displacement).norm() +
        truths_->reach(i) * (c.motion_a.rotation_vector.norm() + c.motion_b.rotation_vector.norm());
    const bool promised = contestant.info().origin != Origin::peer;
    const double late = promised || path == 0 ? 1e-14 : tolerance / path;
    if (!(outcome.toi <= exact.upper + late)) return true;
    return outcome.toi < exact.lower && truths_->is_apart(i, outcome.toi, tolerance);
  }

  const DrawnFamily<CastCase>& family_;
  BlockRange range_;
  std::vector<CastCase> cases_;
  std::optional<CastTruths> truths_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_cast_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<CastBlock>(number, range);
}

}  // namespace touchstone::check
