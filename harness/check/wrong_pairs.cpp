// Asks versions again about the pairs that one of them gets wrong, and writes both.
#include "harness/check/wrong_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/files/case_json.h"
#include "harness/files/output_file.h"
#include "harness/kinds/pair/pair_request.h"
#include "harness/process/limited_query.h"

namespace touchstone::check {
namespace {

using files::OrderedJson;

std::string_view to_string(AnswerState state) {
  switch (state) {
    case AnswerState::right: break;
    case AnswerState::wrong: return "wrong";
    case AnswerState::gave_up: return "gave_up";
    case AnswerState::failed: return "failed";
  }
  return "right";
}

// Values that are not known are left out.
void set(OrderedJson& json, const char* key, const Vec3d& v) {
  if (v.allFinite()) json[key] = {v.x(), v.y(), v.z()};
}

OrderedJson answer_json(const WrongPair::Given& given, const Outcome& outcome) {
  OrderedJson json = {{"algorithm", given.algorithm},
                      {"scalar", touchstone::to_string(given.scalar)},
                      {"task", given.task},
                      {"grade", to_string(given.state)},
                      {"error", given.error},
                      {"answer", touchstone::to_string(outcome.answer)},
                      {"status", touchstone::to_string(outcome.status)}};
  if (std::isfinite(outcome.distance)) json["distance"] = outcome.distance;
  set(json, "normal", outcome.normal);
  set(json, "on_a", outcome.witness_a);
  set(json, "on_b", outcome.witness_b);
  return json;
}

Task task_of(std::string_view name) {
  for (const Task task :
       {Task::intersect, Task::distance, Task::penetration, Task::signed_distance}) {
    if (touchstone::to_string(task) == name) return task;
  }
  throw std::logic_error("no such task");
}

}  // namespace

void write_wrong_pairs(const kinds::CheckRequest& whole, const std::vector<WrongPair>& pairs) {
  const kinds::PairRequest request(whole);
  std::vector<files::Case> cases;
  for (const WrongPair& pair : pairs) {
    const auto regime = std::ranges::find(request.regimes, pair.regime, &kinds::Regime::name);
    cases.push_back(kinds::make(**regime, request.seed, static_cast<std::uint64_t>(pair.index)));
  }
  // Each algorithm is asked at once.
  struct Asked {
    std::vector<process::LimitedQuery> queries;
    std::vector<std::pair<std::size_t, std::size_t>> places;  // pair, answer
  };
  std::map<std::pair<std::string, Precision>, Asked> algorithms;
  std::vector<std::vector<Outcome>> outcomes;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    outcomes.emplace_back(pairs[i].answers.size());
    for (std::size_t k = 0; k < pairs[i].answers.size(); ++k) {
      const WrongPair::Given& given = pairs[i].answers[k];
      Asked& asked = algorithms[{given.algorithm, given.scalar}];
      asked.queries.push_back({&cases[i], task_of(given.task)});
      asked.places.emplace_back(i, k);
    }
  }
  for (const auto& [algorithm, asked] : algorithms) {
    const auto entry = std::ranges::find(
        request.narrow, algorithm.first,
        [](const NarrowPhaseEntry* one) -> const std::string& { return one->info.name; });
    const std::vector<Outcome> answers =
        process::ask_limited(**entry, {.scalar = algorithm.second}, asked.queries,
                             {.seconds = request.time_limit, .lost = asked.queries.size()});
    for (std::size_t i = 0; i < answers.size(); ++i) {
      outcomes[asked.places[i].first][asked.places[i].second] = answers[i];
    }
  }
  files::OutputFile file(request.out / wrong_pairs_file);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    OrderedJson line = {{"id", cases[i].id},
                        {"group", pairs[i].group},
                        {"a", files::body_to_json(cases[i].shape_a, cases[i].pose_a)},
                        {"b", files::body_to_json(cases[i].shape_b, cases[i].pose_b)},
                        {"answers", OrderedJson::array()}};
    for (std::size_t k = 0; k < outcomes[i].size(); ++k) {
      line["answers"].push_back(answer_json(pairs[i].answers[k], outcomes[i][k]));
    }
    file.write(line.dump() + "\n");
  }
  file.close();
}

}  // namespace touchstone::check
