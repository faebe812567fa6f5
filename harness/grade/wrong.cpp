// Decides whether an answer is wrong, and describes how.
#include "harness/grade/wrong.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/grade/graded_answer.h"
#include "harness/grade/margins.h"

namespace touchstone::grade {
namespace {

// Returns whether the answer is on the wrong side of contact without being allowed to.
bool is_wrong_side(const NarrowPhaseEntry& entry, const GradedAnswer& answer, const Grade& grade) {
  return grade.verdict == Verdict::silent_error &&
         !(entry.traits.approximate && is_contact(answer.answer));
}

// Calls visit(words, error in metres, margin as a part of the scale) for each distance and depth of
// the answer. An unknown error is NaN.
template <class Visit>
void for_each_length(const NarrowPhaseEntry& entry, const GradedAnswer& answer, const Grade& grade,
                     const Margins& margins, const Visit& visit) {
  visit("the distance is wrong", std::abs(grade.distance_error), margins.length);
  visit("the depth is too small", -grade.depth_error, margins.length);
  if (!entry.traits.depth_is_bound)
    visit("the depth is too great", grade.depth_error, margins.length);
  if (grades_depth(answer.task, grade)) {
    visit("the translation does not separate", grade.separation_error, margins.length);
  }
}

bool is_wrong(const NarrowPhaseEntry& entry, const GradedAnswer& answer, const Grade& grade,
              bool extreme) {
  const Margins margins = documented_margins(answer.scalar, extreme);
  bool wrong = is_wrong_side(entry, answer, grade) || answer.witnesses.not_a_number ||
               grade.bounds_error > margins.verdict * answer.scale ||
               grade.resolution > margins.resolution * answer.scale;
  for_each_length(entry, answer, grade, margins, [&](const char*, double error, double margin) {
    wrong = wrong || error > margin * answer.scale;
  });
  return wrong;
}

// Collects remarks and joins them by semicolons.
class Remarks {
 public:
  void add(const std::string& text) { text_ += (text_.empty() ? "" : "; ") + text; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

std::string_view to_string(AnswerClass one) {
  constexpr std::array<std::string_view, 6> names = {"right",  "rounded", "honest",
                                                     "silent", "crashed", "hung"};
  return names[static_cast<std::size_t>(one)];
}

AnswerClass class_of(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme) {
  if (answer.given.verdict == Verdict::crashed) return AnswerClass::crashed;
  if (answer.given.verdict == Verdict::timed_out) return AnswerClass::hung;
  if (is_wrong(entry, answer, answer.given, extreme)) return AnswerClass::silent;
  if (answer.given.verdict == Verdict::honest_failure) return AnswerClass::honest;
  return is_wrong(entry, answer, answer.end_to_end, extreme) ? AnswerClass::rounded
                                                             : AnswerClass::right;
}

double wrong_margin(const NarrowPhaseEntry& entry, const GradedAnswer& answer) {
  if (!is_wrong_side(entry, answer, answer.given)) return Grade::none;
  return answer.given.margin / answer.scale;
}

double worst_error(const NarrowPhaseEntry& entry, const GradedAnswer& answer) {
  double worst = Grade::none;
  for_each_length(entry, answer, answer.given, {},
                  [&](const char*, double error, double) { keep_greater(worst, error); });
  keep_greater(worst, answer.given.bounds_error);
  return std::isnan(worst) ? worst : std::max(worst, 0.0) / answer.scale;
}

std::string beyond_margins(const NarrowPhaseEntry& entry, const GradedAnswer& answer,
                           bool extreme) {
  const Grade& grade = answer.end_to_end;
  const Margins margins = documented_margins(answer.scalar, extreme);
  Remarks remarks;
  const auto test = [&](const char* what, double error, double margin) {
    if (!(error > margin * answer.scale)) return;
    remarks.add(fmt::format("{} by {:.3g} m, {:.1e} of the size; at most {:.0e} is documented",
                            what, error, error / answer.scale, margin));
  };
  if (grade.verdict == Verdict::crashed) remarks.add("crashed");
  if (grade.verdict == Verdict::timed_out) remarks.add("no answer in time");
  if (is_wrong_side(entry, answer, grade)) {
    test(is_contact(answer.answer) ? "called overlapping, and apart"
                                   : "called separated, and overlapping",
         grade.margin, margins.verdict);
  }
  test("the certified bounds miss the exact value", grade.bounds_error, margins.verdict);
  test("called touching within bounds that are apart", grade.resolution, margins.resolution);
  for_each_length(entry, answer, grade, margins, test);
  // A depth may come without points, as MPR and SAT have none.
  if (answer.witnesses.missing && answer.answer == Answer::separated) {
    remarks.add("a distance without its normal or witness points");
  }
  test("a witness point is off its body", answer.witnesses.off_body, margins.witness);
  if (answer.witnesses.not_a_number) remarks.add("a reported number is NaN or infinite");
  return remarks.text();
}

std::string describe(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme) {
  if (answer.beyond) return beyond_margins(entry, answer, extreme);
  const Grade& grade = answer.given;
  const double scale = answer.scale;
  Remarks remarks;
  switch (grade.verdict) {
    case Verdict::crashed: remarks.add("crashed"); break;
    case Verdict::timed_out: remarks.add("no answer in time"); break;
    case Verdict::silent_error:
      remarks.add(fmt::format(
          "called {}, and {} by {:.3g} m, {:.1e} of the size", to_string(answer.answer),
          is_contact(answer.answer) ? "apart" : "overlapping", grade.margin, grade.margin / scale));
      break;
    default: break;
  }
  const auto number = [&](const char* what, double error) {
    if (std::abs(error) > documented_margins(answer.scalar, true).length * scale) {
      remarks.add(fmt::format("{} by {:.3g} m, {:.1e} of the size", what, std::abs(error),
                              std::abs(error) / scale));
    }
  };
  number(grade.distance_error > 0 ? "distance too great" : "distance too small",
         grade.distance_error);
  number(grade.depth_error > 0 ? "depth too great" : "depth too small", grade.depth_error);
  if (grades_depth(answer.task, grade) && grade.separation_error > 0) {
    number("the translation does not separate", grade.separation_error);
  }
  number("certified bounds miss the exact value", grade.bounds_error);
  if (answer.witnesses.not_a_number) remarks.add("a reported number is NaN or infinite");
  return remarks.text();
}

double badness(const GradedAnswer& answer) {
  if (answer.given.verdict == Verdict::crashed) return 1e9;
  if (answer.given.verdict == Verdict::timed_out) return 1e8;
  const double scale = answer.scale;
  double bad = 0;
  if (answer.given.verdict == Verdict::silent_error) {
    bad = 1e3 * (1 + answer.given.margin / scale);
  }
  const Margins margins = documented_margins(answer.scalar, true);
  for (const double error : {std::abs(answer.given.distance_error),
                             std::abs(answer.given.depth_error), answer.given.bounds_error}) {
    if (error > margins.length * scale) bad = std::max(bad, std::min(error / scale, 1e3));
  }
  return answer.witnesses.not_a_number ? std::max(bad, 1e2) : bad;
}

}  // namespace touchstone::grade
