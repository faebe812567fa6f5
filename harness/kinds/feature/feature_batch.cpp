// The kind of moving vertices, faces and edges: families, batches, contestants.
#include <fmt/format.h>

#include <utility>

#include "algorithms/oracle/ccd/first_within.h"
#include "algorithms/oracle/oracle.h"
#include "harness/families/ccd_families.h"
#include "harness/files/text_file.h"
#include "harness/kinds/feature/feature_grade.h"
#include "harness/kinds/feature/feature_kind.h"
#include "harness/kinds/grading.h"

namespace touchstone::kinds {
namespace {

struct FeatureCall {
  Lengths lengths;
  std::vector<std::size_t> places;
  std::vector<CcdQuery> queries;
};

// A value of an axis.
struct FeatureAxis {
  std::string axis, value;
  families::CcdFamily family;
};

std::vector<FeatureAxis> feature_axes() {
  std::vector<FeatureAxis> places;
  for (const FeaturePair pair : {FeaturePair::vertex_face, FeaturePair::edge_edge}) {
    const auto add = [&](const char* axis, int first, int last, const auto& make) {
      for (const AxisValue& at : decades(first, last)) {
        const std::string name = std::string(to_string(pair)) + "-" + axis;
        places.push_back({name, at.name, {name + "-" + at.name, pair, make(at.value)}});
      }
    };
    const auto motion = [pair](double reach) {
      return [=](families::Draws& draws) { return families::motion_query(pair, reach, draws); };
    };
    add("speed", 0, 12, motion);
    add("slowness", 0, -15, motion);
    add("distance", 0, 15, [pair](double distance) {
      return [=](families::Draws& draws) {
        return families::changed(families::contact_query(pair, draws), 1, distance);
      };
    });
  }
  return places;
}

// Those of an axis come after the others.
const std::vector<families::CcdFamily>& all_families() {
  static const std::vector<families::CcdFamily> all = [] {
    std::vector<families::CcdFamily> list = families::ccd_families();
    for (FeatureAxis& axis : feature_axes()) list.push_back(std::move(axis.family));
    return list;
  }();
  return all;
}

class FeatureBatch final : public Batch {
 public:
  FeatureBatch(std::uint32_t number, const BatchRange& range)
      : family_(all_families()[number]), range_(range) {
    for (std::uint64_t index = range.first; index < range.first + range.count; ++index) {
      auto draws = draws_of(feature_kind(), number, range.seed, index);
      const double scale = ccd_size(index).scale;
      // A translation by a million sizes, which rounds the coordinates.
      const double offset = draws.below(6) == 0 ? 0x1p20 * scale : 0;
      queries_.push_back(families::changed(family_.draw(draws), scale, offset));
    }
    separated_.resize(queries_.size());
  }

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    const auto& entry = contestant.of<CcdEntry>();
    std::vector<Graded> grades(queries_.size());
    if (form == CaseForm::split) return ask_halves(contestant, entry, time_limit);
    std::vector<FeatureCall> calls;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      if (!is_asked(form, range_.first + i)) continue;
      const std::uint64_t index = range_.first + i;
      const std::optional<CcdQuery> query = query_in_form(
          queries_[i], first_count(), ccd_size(index).scale, FormNumbers(range_.seed, index), form);
      if (query) add(calls, contestant, i, *query, form);
    }
    const std::vector<CcdOutcome> outcomes = solve(entry, calls, time_limit);
    std::size_t k = 0;
    for (const FeatureCall& call : calls) {
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
        "touchstone query {} --kind feature --features {} --with exact,{} --tolerance {}{} --out "
        "answers.csv",
        file, to_string(family_.pair), contestant.info->name, lengths.tolerance,
        lengths.separation > 0 ? fmt::format(" --separation {}", lengths.separation) : "");
  }

 private:
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
    return impact_of({first_count(), queries_[i].start, queries_[i].end}, lengths.separation);
  }
  const oracle::ccd::Impact& truth(const Contestant& contestant, std::size_t i) {
    std::vector<oracle::ccd::Impact>& truths = truths_[contestant.task];
    for (std::size_t k = truths.size(); k < queries_.size(); ++k)
      truths.push_back(impact(k, lengths_of(contestant, k)));
    return truths[i];
  }

  void add(std::vector<FeatureCall>& calls, const Contestant& contestant, std::size_t i,
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
  std::vector<CcdOutcome> solve(const CcdEntry& entry, const std::vector<FeatureCall>& calls,
                                double time_limit) const {
    std::vector<CcdOutcome> outcomes;
    ask_calls<CcdOutcome, queries_of_a_call>(
        calls, time_limit,
        [&] {
          return [&](const FeatureCall& call, std::span<CcdOutcome> answers) {
            const Lengths& lengths = call.lengths;
            entry.make({.tolerance = lengths.tolerance, .separation = lengths.separation})
                ->solve(family_.pair, call.queries, answers);
          };
        },
        [&](std::size_t, const CcdOutcome& outcome) { outcomes.push_back(outcome); });
    return outcomes;
  }

  // A contact is in the first half or in the second.
  std::vector<Graded> ask_halves(const Contestant& contestant, const CcdEntry& entry,
                                 double time_limit) {
    std::vector<Graded> grades(queries_.size());
    std::array<std::vector<FeatureCall>, 2> calls;
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
    for (const FeatureCall& call : calls[0]) {
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

  Graded grade(const Contestant& contestant, std::size_t i, const CcdOutcome& outcome,
               bool reversed) {
    return grade_feature(outcome, truth(contestant, i),
                         {&queries_[i], first_count(), lengths_of(contestant, i), reversed},
                         contestant.info->origin == Origin::oracle, oracle_);
  }

  const families::CcdFamily& family_;
  BatchRange range_;
  std::vector<CcdQuery> queries_;
  mutable std::vector<std::optional<Lengths>> separated_;   // found when they are first asked for
  std::array<std::vector<oracle::ccd::Impact>, 2> truths_;  // by the contestant's task
  mutable oracle::Oracle oracle_;
};

constexpr std::array<std::string_view, 2> feature_tasks = {"contact", "separation"};

std::vector<Family> feature_families() {
  std::vector<Family> list;
  for (const families::CcdFamily& family : families::ccd_families()) {
    list.push_back({.name = family.name, .group = std::string(to_string(family.pair))});
  }
  for (const FeatureAxis& at : feature_axes()) {
    list.push_back(
        {.name = at.axis + "-" + at.value, .group = "axes", .axis = at.axis, .value = at.value});
  }
  return list;
}

}  // namespace

const Kind& feature_kind() {
  static const KindOf<CcdEntry> kind(
      {.registry = kind_words<CcdEntry>,
       .title = "Continuous collision of features",
       .contract = "continuous collision",
       .legend = "The tolerance is 1e-6 of the size or less, unless another is stated; *near* is a "
                 "hit where the features come within it. *Inexact*: a time of impact that is late "
                 "by more than 1e-6 of the step, or so early that the features are further apart "
                 "than the tolerance, or a bound that does not hold.",
       .tasks = feature_tasks,
       .draw_number = 5},
      {.options = feature_options,
       .read = read_feature_questions,
       .offers =
           [](const CcdEntry& entry, Precision scalar, std::uint8_t task) {
             return scalar == Precision::float64 && (task == 0 || entry.separations);
           },
       .families = feature_families,
       .draw = drawn_batch<FeatureBatch>,
       .sets = feature_sets});
  return kind;
}

}  // namespace touchstone::kinds
