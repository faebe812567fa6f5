// Asks the oracle and the algorithms about the pairs that the page shows.
#include "harness/report/case_view.h"

#include <fmt/format.h>

#include "algorithms/oracle/answer.h"
#include "algorithms/registry.h"
#include "harness/base/data_folder.h"
#include "harness/base/names.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/grade/graded_answer.h"
#include "harness/grade/wrong.h"
#include "harness/kinds/mesh/mesh_grade.h"
#include "harness/measure/narrow_choice.h"
#include "harness/process/isolate.h"
#include "harness/process/solve_case.h"
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

OrderedJson answer_view(const AlgorithmInfo& info, Precision scalar, std::string_view task,
                        const Outcome& outcome, std::string_view grade, std::string why) {
  return {{"algorithm", info.name},
          {"origin", to_string(info.origin)},
          {"scalar", to_string(scalar)},
          {"task", task},
          {"answer", to_string(outcome.answer)},
          {"status", to_string(outcome.status)},
          {"distance", number(outcome.distance)},
          {"lower", number(outcome.lower)},
          {"upper", number(outcome.upper)},
          {"normal", triple(outcome.normal)},
          {"witness_a", triple(outcome.witness_a)},
          {"witness_b", triple(outcome.witness_b)},
          {"grade", grade},
          {"why", std::move(why)}};
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
  return answer_view(entry.info, scalar, to_string(task), outcome,
                     is_excused ? "approximate" : to_string(of_answer),
                     is_right ? std::string() : grade::describe(entry, graded, false));
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
  const std::filesystem::path inside = whole.lexically_relative(base::data_folder().path);
  return inside.empty() || inside.begin()->string() == ".." ? whole.string() : inside.string();
}

OrderedJson truth_view(const Outcome& truth) {
  return {{"answer", to_string(truth.answer)},
          {"lower", number(truth.lower)},
          {"upper", number(truth.upper)},
          {"normal", triple(truth.normal)}};
}

OrderedJson case_view(const ListedCase& listed, const std::filesystem::path& folder,
                      Subject& subject) {
  const files::Case& c = listed.c;
  const Outcome& truth = subject.truth;
  return {
      {"id", c.id},
      {"source", listed.file},
      {"about", listed.about},
      {"line", files::to_json(c)},
      {"query",
       !listed.command.empty()
           ? listed.command
           : fmt::format("./touchstone query {} --id {} --narrow all --task {} --out answers.csv",
                         base::shell_word(from_project(folder / listed.file)),
                         base::shell_word(c.id), to_string(subject.measure()))},
      {"a", body_view(c.shape_a, c.pose_a)},
      {"b", body_view(c.shape_b, c.pose_b)},
      {"truth", truth_view(truth)},
      {"proof", proof_view(truth)},
      {"answers", std::move(subject.answers)}};
}

OrderedJson concave_body_view(const ConcaveBody& body, const Pose& pose) {
  if (!body.mesh && body.parts.size() == 1 && body.surfaces.empty()) {
    const ConvexPart& part = body.parts[0];
    return body_view(part.shape, {pose.rotation * part.pose.rotation, pose(part.pose.translation)});
  }
  OrderedJson view = body_view(Shape{}, pose);
  view["shape"] = mesh_view(
      body.mesh ? geometry::Mesh{.vertices = body.mesh->vertices, .triangles = body.mesh->triangles}
                : geometry::surface_of(body));
  return view;
}

Outcome solve_concave(const ConcaveEntry& entry, Precision scalar, ConcaveTask task,
                      const files::ConcaveCase& c) {
  const ConcaveSettings settings = {
      .scalar = scalar,
      .mid_phase = registry::find<MidPhaseEntry>(measure::usual_mid_phase)->make,
      .narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); }};
  const std::vector<ConcaveBody> bodies = {c.a, c.b};
  const std::unique_ptr<ConcavePhase> phase = entry.make(settings);
  phase->bind(bodies);
  Outcome outcome;
  std::vector<IndexPair> parts;
  phase->solve(task, {0, c.pose_a}, {1, c.pose_b}, outcome, parts);
  return outcome;
}

kinds::MeshAnswer mesh_answer(const Outcome& outcome) {
  return {.status = outcome.status,
          .answer = outcome.answer,
          .distance = outcome.distance,
          .lower = outcome.lower,
          .upper = outcome.upper};
}

// Returns the grade in the words that the page has for answers about convex pairs.
std::string_view word_of(kinds::Grade grade, Status status, bool is_approximate) {
  switch (grade) {
    case kinds::Grade::right:
    case kinds::Grade::near:
    case kinds::Grade::bound:
    case kinds::Grade::inexact: return "right";  // the page judges the verdicts of meshes
    case kinds::Grade::missed:
    case kinds::Grade::false_hit: return is_approximate ? "approximate" : "silent";
    case kinds::Grade::failed: return status == Status::timed_out ? "hung" : "crashed";
    case kinds::Grade::not_asked:
    case kinds::Grade::unresolved:
    case kinds::Grade::gave_up: break;
  }
  return "honest";
}

std::string reason_of(kinds::Grade grade, const Outcome& truth) {
  if (grade == kinds::Grade::inexact) return "its distance or bounds are off";
  const bool is_on_wrong_side = grade == kinds::Grade::missed || grade == kinds::Grade::false_hit;
  return is_on_wrong_side ? fmt::format("the exact answer is {}", to_string(truth.answer)) : "";
}

OrderedJson concave_pair_view(const AskedPair& pair, double time_limit) {
  struct Asked {
    const ConcaveEntry* entry;
    Precision scalar;
    ConcaveTask task;
  };
  std::vector<Asked> asked;
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    const bool takes =
        is_built(entry.info) && (entry.supports == nullptr || entry.supports(pair.c.a, pair.c.b));
    for (const Precision scalar : {Precision::float64, Precision::float32}) {
      for (const ConcaveTask task : {ConcaveTask::distance, ConcaveTask::intersect}) {
        if (!takes || !offers(entry, task, scalar)) continue;
        asked.push_back({&entry, scalar, task});
        break;
      }
    }
  }
  const process::IsolationLimits limits = {.item_seconds = time_limit, .failures = 10};
  const auto solved = process::isolated_answers<Outcome>(asked.size(), limits, [&] {
    return [&](std::size_t i) {
      return solve_concave(*asked[i].entry, asked[i].scalar, asked[i].task, pair.c);
    };
  });
  Outcome truth;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (asked[i].entry->info.origin == Origin::oracle) truth = solved.answers[i];
  }
  const kinds::MeshAnswer exact = mesh_answer(truth);
  const double reach = kinds::mesh_reach(pair.c.a, pair.c.pose_a, pair.c.b, pair.c.pose_b);
  OrderedJson answers = OrderedJson::array();
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Outcome& outcome = solved.answers[i];
    const kinds::Grade grade = kinds::grade_mesh(asked[i].task, mesh_answer(outcome), exact, &exact,
                                                 asked[i].scalar, reach)
                                   .grade;
    answers.push_back(answer_view(
        asked[i].entry->info, asked[i].scalar,
        asked[i].task == ConcaveTask::distance ? "distance" : "intersect", outcome,
        word_of(grade, outcome.status, asked[i].entry->approximate), reason_of(grade, truth)));
  }
  return {{"id", pair.c.id},
          {"source", pair.source},
          {"about", pair.source},
          {"line", files::to_json(pair.c)},
          {"query", pair.command},
          {"a", concave_body_view(pair.c.a, pair.c.pose_a)},
          {"b", concave_body_view(pair.c.b, pair.c.pose_b)},
          {"truth", truth_view(truth)},
          {"proof", proof_view(truth)},
          {"answers", std::move(answers)}};
}

}  // namespace

files::OrderedJson pair_views(const std::vector<AskedPair>& pairs, double time_limit) {
  OrderedJson views = OrderedJson::array();
  for (const AskedPair& pair : pairs) {
    if (!pair.c.is_convex) {
      views.push_back(concave_pair_view(pair, time_limit));
      continue;
    }
    const ListedCase listed = {.c = files::convex_case(pair.c),
                               .file = pair.source,
                               .about = pair.source,
                               .command = pair.command};
    for (OrderedJson& view : case_views({listed}, {}, time_limit)) views.push_back(std::move(view));
  }
  return views;
}

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
