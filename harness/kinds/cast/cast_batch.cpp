// The kind of moving bodies: batches, contestants.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "harness/files/text_file.h"
#include "harness/kinds/cast/cast_grade.h"
#include "harness/kinds/cast/cast_kind.h"
#include "harness/kinds/grading.h"
#include "harness/process/solve_cast.h"

namespace touchstone::kinds {
namespace {

using files::CastCase;

// Cases of one call; a crash costs them all.
constexpr std::size_t casts_of_a_call = 24;

struct CastCall {
  double tolerance = 0;  // metres
  std::vector<std::size_t> places;
  std::vector<CastParts> parts;  // of each place
};

void solve_call(const CastEntry& entry, const CastSettings& settings, const CastCall& call,
                std::span<CastOutcome> outcomes) {
  std::vector<const CastCase*> cases;
  for (const CastParts& parts : call.parts) cases.push_back(&parts[0]);
  process::solve_casts(entry, settings, cases, outcomes);
  if (call.parts[0].size() == 1) return;
  // Contact is in the first half or in the second.
  CastOutcome& outcome = outcomes[0];
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

class CastBatch final : public Batch {
 public:
  CastBatch(std::uint32_t number, const BatchRange& range)
      : family_(cast_families()[number]), range_(range) {
    for (std::uint64_t index = range.first; index < range.first + range.count; ++index) {
      auto draws = draws_of(cast_kind(), number, range.seed, index);
      CastCase& c = cases_.emplace_back(family_.draw(draws, index));
      // A translation by a million sizes, which rounds the coordinates; the values of an axis would be lost.
      if (family_.axis.empty() && draws.below(6) == 0) put_far_away(c);
      c.id = fmt::format("{}/{}", family_.name, index);
    }
    truths_.emplace(cases_);
  }

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    std::vector<Graded> grades(cases_.size());
    const bool approach = static_cast<StartContact>(contestant.task) == StartContact::approach;
    if (approach && (form == CaseForm::reversed || form == CaseForm::split)) return grades;
    const auto& entry = contestant.of<CastEntry>();
    ask_calls<CastOutcome, casts_of_a_call>(
        calls_of(contestant, form), time_limit,
        [&] {
          return [&](const CastCall& call, std::span<CastOutcome> outcomes) {
            CastSettings settings = settings_of(contestant);
            settings.tolerance = call.tolerance;
            solve_call(entry, settings, call, outcomes);
          };
        },
        [&](std::size_t i, const CastOutcome& outcome) {
          grades[i] = grade(contestant, i, outcome, form);
        });
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string file = stem.string() + ".jsonl";
    files::write_text(file, files::to_json(cases_[place]) + "\n");
    return fmt::format(
        "touchstone query {} --with exact,{} --scalar {} --tolerance {} --start {} --out "
        "answers.csv",
        file, contestant.info->name, to_string(contestant.scalar), tolerance_of(contestant, place),
        contestant.task_name());
  }

 private:
  // Cases as they are drawn are asked together if their kinds and tolerances are equal, in other forms
  // one by one.
  std::vector<CastCall> calls_of(const Contestant& contestant, CaseForm form) const {
    const auto& entry = contestant.of<CastEntry>();
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

  Graded grade(const Contestant& contestant, std::size_t i, const CastOutcome& outcome,
               CaseForm form) {
    const auto& entry = contestant.of<CastEntry>();
    // Lengths are those of the case as it was drawn, and a fixed tolerance is of the form.
    const double scale = scale_of(i, form);
    const double asked_tolerance = scale * tolerance_of(contestant, i);
    const CastAsked asked = {
        .place = i,
        .tolerance = cast_tolerance(entry, asked_tolerance, scale * truths_->path(i), 0) / scale,
        .start = settings_of(contestant).start,
        .reversed = form == CaseForm::reversed};
    const bool in_time = entry.in_time;
    const CastOutcome exact = asked.start == StartContact::approach
                                  ? truths_->of_approach(i, asked.tolerance)
                                  : truths_->of(i);
    const Graded graded = grade_cast(outcome, exact, asked, in_time, *truths_);
    const bool is_silent = graded.grade == Grade::missed || graded.grade == Grade::false_hit ||
                           graded.grade == Grade::inexact;
    if (!is_silent || !rounds(cases_[i], form)) return graded;
    CastOutcome answer;
    const FormNumbers numbers(range_.seed, range_.first + i);
    solve_call(*registry::find<CastEntry>("exact"), {},
               {0, {i}, {parts_in_form(cases_[i], numbers, form)}}, {&answer, 1});
    return grade_cast(outcome, answer, asked, in_time, *truths_);
  }

  const DrawnFamily<CastCase>& family_;
  BatchRange range_;
  std::vector<CastCase> cases_;
  std::optional<CastTruths> truths_;
};

constexpr std::array<std::string_view, 2> cast_tasks = {"counts", "approach"};

}  // namespace

const Kind& cast_kind() {
  static const KindOf<CastEntry> kind(
      {.registry = kind_words<CastEntry>,
       .old_name = "cast",
       .title = "Moving bodies",
       .contract = "cast",
       .legend = "The tolerance is 1e-9 of the size (float: 1e-4), or the algorithm's own; *near* "
                 "is a hit where the bodies come within it. *Inexact*: a time of impact that is "
                 "late by more than the bodies move within the tolerance (of those that promise to "
                 "be in time: 1e-14 of the step), or so early that the bodies are further apart "
                 "than the tolerance, or a bound that does not hold.",
       .tasks = cast_tasks,
       .draw_number = 4},
      {.options = cast_options,
       .read = read_cast_questions,
       .verify = verify_cast_proofs,
       .offers =
           [](const CastEntry& entry, Precision scalar, std::uint8_t task) {
             CastSettings settings;
             settings.scalar = scalar;
             settings.start = static_cast<StartContact>(task);
             return offers(entry, settings);
           },
       .families = [] { return families_of(cast_families()); },
       .draw = drawn_batch<CastBatch>,
       .sets = cast_sets});
  return kind;
}

}  // namespace touchstone::kinds
