// Asks the oracle and the algorithms about the pairs that the page shows.
#include "harness/report/case_view.h"

#include <fmt/format.h>

#include "algorithms/oracle/answer.h"
#include "algorithms/registry.h"
#include "harness/base/shell_word.h"
#include "harness/grade/graded_answer.h"
#include "harness/grade/wrong.h"
#include "harness/process/isolate.h"
#include "harness/process/queries/solve_case.h"
#include "harness/record/build_info.h"
#include "harness/report/body_view.h"

namespace touchstone::report {
namespace {

using files::OrderedJson;

// A pair that the page shows.
struct Subject {
  grade::TrueCase pair;
  Outcome truth;  // distance or depth, with witness points
  OrderedJson answers = OrderedJson::array();

  const files::Case& bodies() const { return pair.pair(); }
  // Returns what is asked about the pair besides its verdict.
  Task measure() const {
    return truth.answer == Answer::overlapping ? Task::penetration : Task::distance;
  }
};

Subject subject_of(const files::Case& c, std::uint64_t index, oracle::Oracle& oracle) {
  Subject subject = {.pair = grade::TrueCase(c, index, oracle), .truth = {}};
  const auto& given = subject.pair.truth(Encoding::as_given);
  subject.truth.answer = given.measure.answer;
  oracle::answer(oracle, given.pair.a(), given.pair.b(), subject.measure(), subject.truth);
  return subject;
}

OrderedJson answer_view(const NarrowPhaseEntry& entry, Precision scalar, Task task,
                        const Outcome& outcome, Subject& subject) {
  const grade::Query query = {.regime = 0, .entry = 0, .scalar = scalar, .task = task};
  const grade::GradedAnswer graded =
      grade::grade_answer(entry, false, query, subject.pair, outcome);
  const grade::AnswerClass of_answer = grade::class_of(entry, graded, false);
  // What an algorithm may do that is approximate by design is shown all the same.
  const bool is_excused = of_answer == grade::AnswerClass::right &&
                          graded.given.verdict == grade::Verdict::silent_error;
  const bool is_right = of_answer == grade::AnswerClass::right && !is_excused;
  return {{"algorithm", entry.info.name},
          {"origin", to_string(entry.info.origin)},
          {"scalar", to_string(scalar)},
          {"task", to_string(task)},
          {"answer", to_string(outcome.answer)},
          {"status", to_string(outcome.status)},
          {"distance", number(outcome.distance)},
          {"lower", number(outcome.lower)},
          {"upper", number(outcome.upper)},
          {"normal", triple(outcome.normal)},
          {"witness_a", triple(outcome.witness_a)},
          {"witness_b", triple(outcome.witness_b)},
          {"grade", is_excused ? "approximate" : to_string(of_answer)},
          {"why", is_right ? std::string() : grade::describe(entry, graded, false)}};
}

// The proof of a pair; its parts that do not apply are null. The plane lies half way between the
// witness points. Moving b by less than the depth leaves the bodies overlapping, so that b's
// witness point is the centre of a ball that it has to leave before they are apart.
OrderedJson proof_view(const Outcome& truth) {
  const bool overlaps = truth.answer == Answer::overlapping;
  const Vec3d middle = truth.witness_a + (truth.witness_b - truth.witness_a) / 2;
  OrderedJson plane, point, ball;
  if (!overlaps && middle.allFinite() && truth.normal.squaredNorm() > 0) {
    const Vec3d n = truth.normal.stableNormalized();
    plane = {{"normal", triple(n)}, {"offset", n.dot(middle)}};
  }
  if (truth.answer == Answer::touching) point = triple(middle);
  if (overlaps && truth.witness_b.allFinite() && std::isfinite(truth.distance)) {
    ball = {{"centre", triple(truth.witness_b)}, {"radius", -truth.distance}};
  }
  return {{"plane", std::move(plane)},
          {"point", std::move(point)},
          {"ball", std::move(ball)},
          {"on_a", triple(truth.witness_a)},
          {"on_b", triple(truth.witness_b)}};
}

struct Query {
  Subject* subject;
  Task task;
};

// Adds the answers of one algorithm to those of the pairs that it takes.
void ask(const NarrowPhaseEntry& entry, Precision scalar, double time_limit,
         std::vector<Subject>& subjects) {
  std::vector<Query> queries;
  for (Subject& subject : subjects) {
    const files::Case& c = subject.bodies();
    for (const Task task : {Task::intersect, subject.measure()}) {
      if (offers(entry, c.shape_a.kind, c.shape_b.kind, task)) queries.push_back({&subject, task});
    }
  }
  const NarrowPhaseSettings settings{.scalar = scalar};
  // A library that hangs on one pair hangs on more; the page need not wait for all.
  const process::IsolationLimits limits = {.item_seconds = time_limit, .failures = 10};
  const auto solved = process::isolated_answers<Outcome>(queries.size(), limits, [&] {
    return [&](std::size_t item) {
      const Query& query = queries[item];
      return process::solve_case(entry, settings, query.subject->bodies(), query.task);
    };
  });
  for (std::size_t item = 0; item < queries.size(); ++item) {
    const auto [subject, task] = queries[item];
    subject->answers.push_back(answer_view(entry, scalar, task, solved.answers[item], *subject));
  }
}

// Returns the path from the project's folder, where commands are given, if it is below that.
std::string from_project(const std::filesystem::path& file) {
  const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
  const std::filesystem::path inside = whole.lexically_relative(record::source_folder);
  return inside.empty() || inside.begin()->string() == ".." ? whole.string() : inside.string();
}

OrderedJson case_view(const ListedCase& listed, const std::filesystem::path& folder,
                      Subject& subject) {
  const files::Case& c = listed.c;
  const Outcome& truth = subject.truth;
  return {{"id", c.id},
          {"source", listed.file},
          {"about", listed.about},
          {"line", files::to_json(c)},
          {"query",
           fmt::format("./touchstone query {} --id {} --narrow all --task {} --out answers.csv",
                       base::shell_word(from_project(folder / listed.file)), base::shell_word(c.id),
                       to_string(subject.measure()))},
          {"a", body_view(c.shape_a, c.pose_a)},
          {"b", body_view(c.shape_b, c.pose_b)},
          {"truth",
           {{"answer", to_string(truth.answer)},
            {"lower", number(truth.lower)},
            {"upper", number(truth.upper)},
            {"normal", triple(truth.normal)}}},
          {"proof", proof_view(truth)},
          {"answers", std::move(subject.answers)}};
}

}  // namespace

std::vector<ListedCase> listed_cases(const std::filesystem::path& folder, const std::string& file) {
  std::vector<ListedCase> cases;
  for (files::Case& c : files::read_cases(folder / file)) {
    cases.push_back({std::move(c), file, file});
  }
  std::size_t next = 0;
  files::for_each_json_line(folder / file, "a case", [&](const files::JsonNode& line) {
    std::string& about = cases[next++].about;
    if (!line.has("source") || !line.value()["source"].is_object()) return;
    const files::Json& source = line.value()["source"];
    if (source.contains("wrong") && source["wrong"].is_string()) about = source["wrong"];
  });
  return cases;
}

OrderedJson case_views(const std::vector<ListedCase>& cases, const std::filesystem::path& folder,
                       double time_limit) {
  oracle::Oracle oracle;
  std::vector<Subject> subjects;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    subjects.push_back(subject_of(cases[i].c, i, oracle));
  }
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    for (const Precision scalar : {Precision::float64, Precision::float32}) {
      if (is_built(entry.info) && offers(entry, scalar)) ask(entry, scalar, time_limit, subjects);
    }
  }
  OrderedJson views = OrderedJson::array();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    views.push_back(case_view(cases[i], folder, subjects[i]));
  }
  return views;
}

}  // namespace touchstone::report
