// Moving vertices, faces and edges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/oracle/ccd/first_contact.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/oracle/solid.h"
#include "harness/check/kinds/blocks/exact_forms.h"
#include "harness/check/kinds/blocks/grading.h"
#include "harness/check/kinds/blocks/other_axes.h"
#include "harness/families/ccd_families.h"
#include "harness/files/text_file.h"

namespace touchstone::check {
namespace {

// Queries of one call; a crash costs them all. They have one scale and one tolerance.
constexpr std::uint64_t queries_of_a_call = 50;

struct CallAnswer {
  Status status = Status::unsupported;
  std::array<CcdOutcome, queries_of_a_call> outcomes;
};

struct Call {
  double tolerance = 0;  // metres
  std::vector<std::size_t> places;
  std::vector<CcdQuery> queries;
};

using Vertices = std::array<Vec3d, 4>;

CcdQuery with_order(const CcdQuery& query, const std::array<std::size_t, 4>& order) {
  CcdQuery other;
  for (std::size_t k = 0; k < 4; ++k) {
    other.start[k] = query.start[order[k]];
    other.end[k] = query.end[order[k]];
  }
  return other;
}

// The vertices halfway, if they are exact.
std::optional<Vertices> middle_of(const CcdQuery& query) {
  Vertices middle;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto sum = exact_sum(query.start[k], query.end[k]);
    if (!sum) return std::nullopt;
    middle[k] = *sum / 2;
  }
  return middle;
}

class CcdBlock final : public CaseBlock {
 public:
  CcdBlock(std::uint32_t number, const BlockRange& range)
      : family_(all_families()[number]), range_(range) {
    for (std::uint64_t index = range.first; index < range.first + range.count; ++index) {
      auto draws = draws_of(CaseKind::ccd, number, range.seed, index);
      const Size size = size_of(index);
      // A translation by a million sizes, which rounds the coordinates.
      const double offset = draws.below(6) == 0 ? 0x1p20 * size.scale : 0;
      queries_.push_back(families::changed(family_.draw(draws), size.scale, offset));
    }
  }

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    const auto& entry = *std::get<const CcdEntry*>(contestant.entry);
    std::vector<GradedCase> grades(queries_.size());
    if (form == CaseForm::split) return ask_halves(contestant, entry, time_limit);
    std::vector<Call> calls;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      const std::optional<CcdQuery> query = in_form(i, form);
      if (query) add(calls, i, *query, form);
    }
    const std::vector<CcdOutcome> outcomes = solve(entry, calls, time_limit);
    std::size_t k = 0;
    for (const Call& call : calls) {
      for (const std::size_t i : call.places) {
        const CcdOutcome& outcome = outcomes[k++];
        grades[i] = grade(contestant, i, outcome, form == CaseForm::reversed);
      }
    }
    return grades;
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const std::string file = stem.string() + ".csv";
    std::string text;
    const bool is_hit = impact(place).is_hit;
    for (const Vertices* vertices : {&queries_[place].start, &queries_[place].end}) {
      for (const Vec3d& v : *vertices) {
        text += fmt::format("{},{},{},{}\n", v.x(), v.y(), v.z(), is_hit ? 1 : 0);
      }
    }
    files::write_text(file, text);
    return fmt::format(
        "touchstone ccd {} --kind {} --ccd exact,{} --tolerance {} --out answers.csv", file,
        to_string(family_.pair), contestant.info().name, size_of(range_.first + place).tolerance);
  }

 private:
  struct Size {
    double scale, tolerance;
  };
  // Those of an axis come after the others.
  static const std::vector<families::CcdFamily>& all_families() {
    static const std::vector<families::CcdFamily> all = [] {
      std::vector<families::CcdFamily> list = families::ccd_families();
      for (const AxisPlace<families::CcdFamily>& axis : ccd_axes()) {
        list.push_back(axis.of);
      }
      return list;
    }();
    return all;
  }
  static Size size_of(std::uint64_t index) {
    constexpr std::array<Size, 6> sizes = {
        {{1, 1e-6}, {0x1p-20, 0x1p-40}, {0x1p20, 1}, {0x1p-7, 1e-10}, {0x1p10, 0}, {1e-2, 1e-8}}};
    return sizes[index / queries_of_a_call % sizes.size()];
  }

  int first_count() const { return family_.pair == FeaturePair::vertex_face ? 1 : 2; }
  oracle::ccd::Impact impact(std::size_t i) const {
    return oracle::ccd::impact_of({first_count(), queries_[i].start, queries_[i].end});
  }
  const oracle::ccd::Impact& truth(std::size_t i) {
    if (truths_.empty()) {
      for (std::size_t k = 0; k < queries_.size(); ++k) truths_.push_back(impact(k));
    }
    return truths_[i];
  }

  void add(std::vector<Call>& calls, std::size_t i, const CcdQuery& query, CaseForm form) const {
    const std::uint64_t index = range_.first + i;
    double tolerance = size_of(index).tolerance;
    // Each has a scale of its own.
    const bool is_scaled = form == CaseForm::scaled;
    if (is_scaled) tolerance *= FormNumbers(range_.seed, index).scale;
    const bool is_next = calls.empty() || is_scaled || calls.back().tolerance != tolerance ||
                         calls.back().places.size() == queries_of_a_call;
    if (is_next) calls.push_back({tolerance, {}, {}});
    calls.back().places.push_back(i);
    calls.back().queries.push_back(query);
  }

  // The outcomes of all calls, one after the other.
  std::vector<CcdOutcome> solve(const CcdEntry& entry, const std::vector<Call>& calls,
                                double time_limit) const {
    std::vector<CcdOutcome> outcomes;
    if (calls.empty()) return outcomes;
    const auto solved =
        process::isolated_answers<CallAnswer>(calls.size(), block_limits(time_limit), [&] {
          return [&](std::size_t k) {
            CallAnswer answer;
            answer.status = Status::ok;
            const std::size_t count = calls[k].queries.size();
            entry.make({.tolerance = calls[k].tolerance})
                ->solve(family_.pair, calls[k].queries, std::span(answer.outcomes).first(count));
            return answer;
          };
        });
    for (std::size_t k = 0; k < calls.size(); ++k) {
      for (std::size_t i = 0; i < calls[k].queries.size(); ++i) {
        CcdOutcome outcome = solved.answers[k].outcomes[i];
        if (solved.answers[k].status != Status::ok) outcome.status = solved.answers[k].status;
        outcomes.push_back(outcome);
      }
    }
    return outcomes;
  }

  std::optional<CcdQuery> in_form(std::size_t i, CaseForm form) const {
    const FormNumbers numbers(range_.seed, range_.first + i);
    const CcdQuery& query = queries_[i];
    switch (form) {
      case CaseForm::as_drawn: return query;
      case CaseForm::swapped:
        return with_order(query, first_count() == 1 ? std::array<std::size_t, 4>{0, 2, 3, 1}
                                                    : std::array<std::size_t, 4>{2, 3, 1, 0});
      case CaseForm::scaled: return families::changed(query, numbers.scale);
      case CaseForm::moved: {
        CcdQuery moved;
        for (std::size_t k = 0; k < 4; ++k) {
          const Vec3d shift = size_of(range_.first + i).scale * numbers.shift;
          const auto start = exact_sum(numbers.turn(query.start[k]), shift);
          const auto end = exact_sum(numbers.turn(query.end[k]), shift);
          if (!start || !end) return std::nullopt;
          moved.start[k] = *start;
          moved.end[k] = *end;
        }
        return moved;
      }
      case CaseForm::reversed: return CcdQuery{query.end, query.start};
      case CaseForm::split: break;
    }
    return std::nullopt;
  }

  // A contact is in the first half or in the second.
  std::vector<GradedCase> ask_halves(const Contestant& contestant, const CcdEntry& entry,
                                     double time_limit) {
    std::vector<GradedCase> grades(queries_.size());
    std::array<std::vector<Call>, 2> calls;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      if (!is_asked(CaseForm::split, range_.first + i)) continue;
      const auto middle = middle_of(queries_[i]);
      if (!middle) continue;
      add(calls[0], i, {queries_[i].start, *middle}, CaseForm::split);
      add(calls[1], i, {*middle, queries_[i].end}, CaseForm::split);
    }
    const auto first = solve(entry, calls[0], time_limit);
    const auto second = solve(entry, calls[1], time_limit);
    std::size_t k = 0;
    for (const Call& call : calls[0]) {
      for (const std::size_t i : call.places) {
        const bool is_first = first[k].answer != CcdAnswer::miss;
        CcdOutcome outcome = is_first ? first[k] : second[k];
        const double offset = is_first ? 0 : 0.5;
        for (double* time : {&outcome.toi, &outcome.free_before, &outcome.contact_by}) {
          *time = offset + 0.5 * *time;
        }
        grades[i] = grade(contestant, i, outcome, false);
        ++k;
      }
    }
    return grades;
  }

  // True if the features are further apart at the time than the tolerance, and rounding.
  bool is_apart(std::size_t i, double time, double tolerance) {
    if (!(time >= 0 && time <= 1)) return true;
    std::array<std::vector<Vec3d>, 2> features;
    double reach = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3d& start = queries_[i].start[k];
      const Vec3d& end = queries_[i].end[k];
      features[k < static_cast<std::size_t>(first_count()) ? 0 : 1].push_back((1 - time) * start +
                                                                              time * end);
      reach = std::max({reach, start.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff()});
    }
    const auto solid = [](std::vector<Vec3d> vertices) {
      Hull hull;
      hull.vertices = std::move(vertices);
      Shape shape;
      shape.kind = ShapeKind::hull;
      shape.hull = std::make_shared<const Hull>(std::move(hull));
      return oracle::Solid(shape);
    };
    const oracle::Solid a = solid(features[0]), b = solid(features[1]);
    const oracle::Measure measure = oracle_.measure({a, Pose{}}, {b, Pose{}});
    return measure.lower > 1.01 * tolerance + 64 * 0x1p-52 * reach;
  }

  GradedCase grade(const Contestant& contestant, std::size_t i, const CcdOutcome& outcome,
                   bool is_backward) {
    const oracle::ccd::Impact& exact = truth(i);
    const auto with = [&](CaseGrade grade) { return GradedCase{grade, exact.is_hit}; };
    const bool is_unknown = outcome.answer == CcdAnswer::unknown;
    const bool is_proven = contestant.info().origin != Origin::peer;
    // What is said to be free is proven even where the answer is unknown.
    const bool is_late =
        is_proven && !is_backward && exact.is_hit && outcome.free_before > exact.contact_by;
    if (is_late && outcome.answer != CcdAnswer::miss) return with(CaseGrade::wrong);
    if (const auto by_status = grade_of_status(outcome.status, is_unknown)) return with(*by_status);
    if (outcome.answer == CcdAnswer::miss) {
      return with(exact.is_hit ? CaseGrade::missed : CaseGrade::right);
    }
    const double by = std::isnan(outcome.contact_by) ? outcome.toi : outcome.contact_by;
    const double tolerance = size_of(range_.first + i).tolerance;
    const bool is_apart_then = is_apart(i, is_backward ? 1 - by : by, tolerance);
    if (!exact.is_hit) return with(is_apart_then ? CaseGrade::false_hit : CaseGrade::near);
    constexpr double late = 1e-6;  // of the time, in a peer that has no bounds
    const bool is_off = is_proven ? is_apart_then : outcome.toi > exact.contact_by + late;
    return with(is_off && !is_backward ? CaseGrade::wrong : CaseGrade::right);
  }

  const families::CcdFamily& family_;
  BlockRange range_;
  std::vector<CcdQuery> queries_;
  std::vector<oracle::ccd::Impact> truths_;
  oracle::Oracle oracle_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_ccd_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<CcdBlock>(number, range);
}

}  // namespace touchstone::check
