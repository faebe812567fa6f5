#include "harness/check/margins.h"

#include <fmt/format.h>

#include <cmath>

namespace touchstone {
namespace {

// Collects what is beyond a limit. NaN is no number to be held to one.
class Remarks {
 public:
  explicit Remarks(double scale) : scale_(scale) {}

  void test(const char* what, double error, double limit) {
    if (!(error > limit * scale_)) return;
    add(fmt::format("{} by {:.3g} m, {:.1e} of the size; at most {:.0e} is documented", what, error,
                    error / scale_, limit));
  }
  void add(const std::string& text) { text_ += (text_.empty() ? "" : "; ") + text; }
  const std::string& text() const { return text_; }

 private:
  double scale_;
  std::string text_;
};

}  // namespace

Margins documented_margins(Precision scalar, bool extreme) {
  if (scalar == Precision::float32) return {.verdict = extreme ? 1e-4 : 1e-5, .length = 1e-4};
  return {.verdict = extreme ? 1e-9 : 1e-12, .length = 1e-9};
}

std::string beyond_margins(const NarrowPhaseEntry& entry, const GradedAnswer& answer,
                           bool extreme) {
  const Grade& grade = answer.end_to_end;
  const Margins margins = documented_margins(answer.scalar, extreme);
  Remarks remarks(answer.scale);
  if (grade.verdict == Verdict::crashed) remarks.add("crashed");
  if (grade.verdict == Verdict::timed_out) remarks.add("no answer in time");
  if (grade.verdict == Verdict::silent_error &&
      !(entry.traits.approximate && is_contact(answer.answer))) {
    remarks.test(is_contact(answer.answer) ? "called overlapping, and apart"
                                           : "called separated, and overlapping",
                 grade.margin, margins.verdict);
  }
  remarks.test("the certified bounds miss the exact value", grade.bounds_error, margins.verdict);
  remarks.test("the distance is wrong", std::abs(grade.distance_error), margins.length);
  remarks.test("the depth is too small", -grade.depth_error, margins.length);
  if (!entry.traits.depth_is_bound) {
    remarks.test("the depth is too great", grade.depth_error, margins.length);
  }
  if (answer.task == Task::penetration) {
    remarks.test("the translation does not separate", grade.separation_error, margins.length);
  }
  if (answer.witnesses.not_a_number) remarks.add("a reported number is NaN or infinite");
  return remarks.text();
}

}  // namespace touchstone
