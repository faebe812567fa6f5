// Timed sets: the configurations of a scene's robot.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/kinds/configuration/configuration_grade.h"
#include "harness/kinds/configuration/configuration_kind.h"
#include "harness/kinds/set_keys.h"
#include "harness/scene/scene.h"

namespace touchstone::kinds {
namespace {

// What is right of the first so many motions of a set.
struct Right {
  std::vector<ConfigurationAnswer> answers;
  ConfigurationTruth truth;
};

struct SetInput {
  std::shared_ptr<const SceneConfigurations> made;
  ConfigurationTask task;
  std::uint32_t steps;
  std::size_t queries;
  std::shared_ptr<Right> right;

  Configurations configurations() const {
    return {std::span(made->poses).first(queries * steps * made->model.links), made->model.links,
            steps};
  }
};

TimedGrade grade_set(const SetInput& input, std::span<const ConfigurationAnswer> answers) {
  TimedGrade sum;
  sum.hits = sum.true_hits = 0;
  const Configurations all = input.configurations();
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto poses =
        all.poses.subspan(i * all.steps * all.links, std::size_t{all.steps} * all.links);
    const ConfigurationAnswer &answer = answers[i], &exact = input.right->answers[i];
    const double reach = configuration_reach(input.made->model, poses);
    sum.add(grade_configuration(input.task, answer, exact,
                                input.right->truth.names_pair(answer, poses), reach),
            static_cast<std::int64_t>(i));
    sum.hits += answer.answer == Answer::overlapping ? 1 : 0;
    sum.true_hits += exact.answer == Answer::overlapping ? 1 : 0;
    if (input.task == ConfigurationTask::distance && is_meant(answer.status) &&
        std::isfinite(exact.distance)) {
      sum.note_error(std::abs(answer.distance - exact.distance) / reach);
    }
  }
  return sum;
}

}  // namespace

TimedSet configuration_set(std::shared_ptr<const SceneConfigurations> made,
                           const std::vector<const ConfigurationEntry*>& entries,
                           ConfigurationTask task, std::uint32_t steps) {
  const ConfigurationModel& model = made->model;
  const auto input = std::make_shared<SetInput>();
  input->made = made;
  input->task = task;
  input->steps = task == ConfigurationTask::motion ? steps : 1;
  input->queries = made->poses.size() / (std::size_t{model.links} * input->steps);
  input->right =
      std::make_shared<Right>(Right{{}, ConfigurationTruth(made->model, PairAnswers::fast)});
  const Configurations all = input->configurations();
  for (std::size_t i = 0; i < input->queries; ++i) {
    const std::size_t poses = std::size_t{all.steps} * all.links;
    input->right->answers.push_back(
        input->right->truth.answer(task, all.poses.subspan(i * poses, poses), all.steps));
  }
  TimedSet set;
  set.queries = set.graded = static_cast<std::int64_t>(input->queries);
  set.truth = "proven-fast";
  for (const ConfigurationEntry* entry : entries) {
    if (std::ranges::count(entry->tasks, task) == 0 || !supports(*entry, model)) {
      set.left_out.push_back({entry->info.name, entry->info.origin});
      continue;
    }
    const auto query = std::make_shared<std::unique_ptr<ConfigurationQuery>>();
    const auto answers = std::make_shared<std::vector<ConfigurationAnswer>>(input->queries);
    TimedContestant contestant = contestant_in(*entry);
    contestant.approximate |= entry->approximate;
    contestant.prepare = [=] {
      *query = make_query(*entry, PairAnswers::fast);
      (*query)->bind(input->made->model);
    };
    contestant.answer = [=] { (*query)->solve(task, input->configurations(), *answers); };
    contestant.grade = [=] { return grade_set(*input, *answers); };
    contestant.hash = [=] {
      // Which pair is named depends on what was asked before.
      return hash_of_answers(std::span<const ConfigurationAnswer>(*answers),
                             [](const ConfigurationAnswer& one) {
                               return hash_of_parts(one.answer, one.status, one.step, one.distance);
                             });
    };
    set.contestants.push_back(std::move(contestant));
  }
  return set;
}

std::vector<PlannedSet> configuration_sets(files::TomlTable& table,
                                           const std::filesystem::path& home) {
  const std::vector<std::string> scenes = table.texts("scenes", {});
  if (scenes.empty()) table.fail("scenes", "expected the files of some scenes with a robot");
  const auto count = static_cast<std::size_t>(table.integer("queries", 1, 10'000'000, 1000));
  const auto steps = static_cast<std::uint32_t>(table.integer("steps", 2, 100'000, 32));
  const std::vector<std::size_t> tasks = choices(table, "tasks", configuration_tasks);
  const auto entries =
      selected(table, registry::entries<ConfigurationEntry>(), "configuration query");
  std::vector<PlannedSet> sets;
  for (const std::string& name : scenes) {
    const std::filesystem::path file = home / name;
    const scene::Scene scene = scene::load_scene(file);
    const auto made =
        std::make_shared<SceneConfigurations>(scene_configurations(scene, file.string()));
    const std::size_t links = made->model.links;
    made->poses.resize(std::min(made->poses.size(), count * links));
    for (const std::size_t task : tasks) {
      const auto asked = static_cast<ConfigurationTask>(task);
      if (asked == ConfigurationTask::motion && made->poses.size() < steps * links) {
        table.fail("steps",
                   fmt::format("{} has {} configurations; expected at least {} for a motion", name,
                               made->poses.size() / links, steps));
      }
      sets.push_back({fmt::format("{}, {} parts, {} pairs", scene.name, made->model.parts.size(),
                                  made->model.pairs.size()),
                      std::string(configuration_tasks[task]),
                      [=] { return configuration_set(made, entries, asked, steps); }});
    }
  }
  return sets;
}

}  // namespace touchstone::kinds
