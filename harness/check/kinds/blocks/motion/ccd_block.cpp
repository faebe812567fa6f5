// Moving vertices, faces and edges.
#include <fmt/format.h>

#include <cmath>

#include "algorithms/oracle/ccd/first_within.h"
#include "algorithms/oracle/oracle.h"
#include "harness/check/kinds/blocks/grading.h"
#include "harness/check/kinds/blocks/motion/ccd_forms.h"
#include "harness/check/kinds/blocks/motion/ccd_lengths.h"
#include "harness/check/kinds/blocks/other_axes.h"
#include "harness/families/ccd_families.h"
#include "harness/files/text_file.h"

namespace touchstone::check {
namespace {

// A crash costs all queries of a call.
struct CallAnswer {
  Status status = Status::unsupported;
  std::array<CcdOutcome, queries_of_a_call> outcomes;
};

struct Call {
  Lengths lengths;
  std::vector<std::size_t> places;
  std::vector<CcdQuery> queries;
};

class CcdBlock final : public CaseBlock {
 public:
  CcdBlock(std::uint32_t number, const BlockRange& range)
      : family_(all_families()[number]), range_(range) {
    for (std::uint64_t index = range.first; index < range.first + range.count; ++index) {
      auto draws = draws_of(CaseKind::ccd, number, range.seed, index);
      const double scale = ccd_size(index).scale;
      // A translation by a million sizes, which rounds the coordinates.
      const double offset = draws.below(6) == 0 ? 0x1p20 * scale : 0;
      queries_.push_back(families::changed(family_.draw(draws), scale, offset));
    }
    separated_.resize(queries_.size());
  }

  std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                              double time_limit) override {
    const auto& entry = *std::get<const CcdEntry*>(contestant.entry);
    std::vector<GradedCase> grades(queries_.size());
    if (form == CaseForm::split) return ask_halves(contestant, entry, time_limit);
    std::vector<Call> calls;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      const std::uint64_t index = range_.first + i;
      const std::optional<CcdQuery> query = query_in_form(
          queries_[i], first_count(), ccd_size(index).scale, FormNumbers(range_.seed, index), form);
      if (query) add(calls, contestant, i, *query, form);
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
    const Lengths lengths = lengths_of(contestant, place);
    const bool is_hit = impact(place, lengths).is_hit;
    for (const std::array<Vec3d, 4>* vertices : {&queries_[place].start, &queries_[place].end}) {
      for (const Vec3d& v : *vertices) {
        text += fmt::format("{},{},{},{}\n", v.x(), v.y(), v.z(), is_hit ? 1 : 0);
      }
    }
    files::write_text(file, text);
    return fmt::format(
        "touchstone ccd {} --kind {} --ccd exact,{} --tolerance {}{} --out answers.csv", file,
        to_string(family_.pair), contestant.info().name, lengths.tolerance,
        lengths.separation > 0 ? fmt::format(" --separation {}", lengths.separation) : "");
  }

 private:
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

  int first_count() const { return family_.pair == FeaturePair::vertex_face ? 1 : 2; }
  // What a query is asked as it was drawn.
  Lengths lengths_of(const Contestant& contestant, std::size_t i) const {
    const std::uint64_t index = range_.first + i;
    if (contestant.task == 0) return {ccd_size(index).tolerance, 0};
    if (!separated_[i])
      separated_[i] = separated_lengths(index, queries_[i], first_count(), oracle_);
    return *separated_[i];
  }
  oracle::ccd::Impact impact(std::size_t i, const Lengths& lengths) const {
    const oracle::ccd::MovingFeatures features{first_count(), queries_[i].start, queries_[i].end};
    return lengths.separation > 0 ? oracle::ccd::impact_within(features, lengths.separation)
                                  : oracle::ccd::impact_of(features);
  }
  const oracle::ccd::Impact& truth(const Contestant& contestant, std::size_t i) {
    std::vector<oracle::ccd::Impact>& truths = truths_[contestant.task];
    for (std::size_t k = truths.size(); k < queries_.size(); ++k)
      truths.push_back(impact(k, lengths_of(contestant, k)));
    return truths[i];
  }

  void add(std::vector<Call>& calls, const Contestant& contestant, std::size_t i,
           const CcdQuery& query, CaseForm form) const {
    Lengths lengths = lengths_of(contestant, i);
    // Each has a scale of its own.
    const bool is_scaled = form == CaseForm::scaled;
    if (is_scaled) {
      const double scale = FormNumbers(range_.seed, range_.first + i).scale;
      lengths = {scale * lengths.tolerance, scale * lengths.separation};
    }
    const bool is_next = calls.empty() || is_scaled || calls.back().lengths != lengths ||
                         calls.back().places.size() == queries_of_a_call;
    if (is_next) calls.push_back({lengths, {}, {}});
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
            const Lengths& lengths = calls[k].lengths;
            entry.make({.tolerance = lengths.tolerance, .separation = lengths.separation})
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

  // A contact is in the first half or in the second.
  std::vector<GradedCase> ask_halves(const Contestant& contestant, const CcdEntry& entry,
                                     double time_limit) {
    std::vector<GradedCase> grades(queries_.size());
    std::array<std::vector<Call>, 2> calls;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      if (!is_asked(CaseForm::split, range_.first + i)) continue;
      const auto middle = vertices_halfway(queries_[i]);
      if (!middle) continue;
      add(calls[0], contestant, i, {queries_[i].start, *middle}, CaseForm::split);
      add(calls[1], contestant, i, {*middle, queries_[i].end}, CaseForm::split);
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

  // True if the features are further apart at the time than separation and tolerance.
  bool is_apart(std::size_t i, double time, const Lengths& lengths) {
    if (!(time >= 0 && time <= 1)) return true;
    return are_further_apart(queries_[i], first_count(), time,
                             lengths.separation + 1.01 * lengths.tolerance, oracle_);
  }

  // True if distances at some times are not what the oracle's answer says, up to the 2^-40 between its
  // bounds. They do not come from its polynomials.
  bool contradicts(std::size_t i, const CcdOutcome& outcome, const Lengths& lengths) {
    const bool is_hit = outcome.answer == CcdAnswer::hit;
    const auto side = [&](double time) {
      return side_of_distance(queries_[i], first_count(), time, lengths.separation, oracle_);
    };
    const double free_until = is_hit ? outcome.free_before : 1;
    for (const double part : {0.25, 0.5, 0.75}) {
      if (free_until > 0 && side(part * free_until) < 0) return true;
    }
    return is_hit && side(outcome.contact_by) > 0;
  }

  // True if a hit's times are not those of the contact.
  bool is_off(const Contestant& contestant, std::size_t i, const CcdOutcome& outcome) {
    constexpr double late = 1e-6, apart = 0x1p-39;  // of the time
    const oracle::ccd::Impact& exact = truth(contestant, i);
    const Lengths lengths = lengths_of(contestant, i);
    switch (contestant.info().origin) {
      case Origin::peer: return outcome.toi > exact.contact_by + late;
      case Origin::oracle:
        return !(outcome.free_before <= exact.contact_by + apart) ||
               !(outcome.contact_by >= exact.free_before - apart) ||
               contradicts(i, outcome, lengths);
      case Origin::ours: break;
    }
    return is_apart(i, contact_of(outcome), lengths);
  }
  static double contact_of(const CcdOutcome& outcome) {
    return std::isnan(outcome.contact_by) ? outcome.toi : outcome.contact_by;
  }

  GradedCase grade(const Contestant& contestant, std::size_t i, const CcdOutcome& outcome,
                   bool is_backward) {
    const oracle::ccd::Impact& exact = truth(contestant, i);
    const auto with = [&](CaseGrade grade) { return GradedCase{grade, exact.is_hit}; };
    const bool is_unknown = outcome.answer == CcdAnswer::unknown;
    const bool is_proven = contestant.info().origin != Origin::peer;
    // What is said to be free is proven even where the answer is unknown.
    const bool is_late =
        is_proven && !is_backward && exact.is_hit && outcome.free_before > exact.contact_by;
    if (is_late && outcome.answer != CcdAnswer::miss) return with(CaseGrade::wrong);
    if (const auto by_status = grade_of_status(outcome.status, is_unknown)) return with(*by_status);
    if (outcome.answer == CcdAnswer::miss) {
      const bool is_false = contestant.info().origin == Origin::oracle &&
                            contradicts(i, outcome, lengths_of(contestant, i));
      return with(exact.is_hit || is_false ? CaseGrade::missed : CaseGrade::right);
    }
    if (!exact.is_hit) {
      const double by = contact_of(outcome);
      const bool is_false = is_apart(i, is_backward ? 1 - by : by, lengths_of(contestant, i));
      return with(is_false ? CaseGrade::false_hit : CaseGrade::near);
    }
    const bool is_wrong = !is_backward && is_off(contestant, i, outcome);
    return with(is_wrong ? CaseGrade::wrong : CaseGrade::right);
  }

  const families::CcdFamily& family_;
  BlockRange range_;
  std::vector<CcdQuery> queries_;
  mutable std::vector<std::optional<Lengths>> separated_;   // found when they are first asked for
  std::array<std::vector<oracle::ccd::Impact>, 2> truths_;  // by the contestant's task
  mutable oracle::Oracle oracle_;
};

}  // namespace

std::unique_ptr<CaseBlock> make_ccd_block(std::uint32_t number, const BlockRange& range) {
  return std::make_unique<CcdBlock>(number, range);
}

}  // namespace touchstone::check
