// What is asked of configurations of a robot: a row of joint values each, or a frame of a scene.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/csv.h"
#include "harness/kinds/configuration/configuration_kind.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {
namespace {

namespace fs = std::filesystem;

bool is_scene(const fs::path& file) {
  return file.extension() == ".toml" || file.extension() == ".urdf";
}

// The scene, or the robot, with the configurations of another file.
scene::Scene scene_with(const std::string& target, const fs::path& configurations) {
  base::check_kind(target, "a scene, or a robot");
  base::check_kind(configurations, "configurations");
  toml::table keys;
  fs::path file = target;
  if (file.extension() == ".urdf") {
    keys.insert("import", fs::absolute(file).string());
    keys.insert("meshes", "surface");
    file += ".toml";  // it has no line that could be wrong
  } else if (file.extension() == ".toml") {
    try {
      keys = toml::parse_file(target);
    } catch (const toml::parse_error& error) {
      throw base::InputError(target, error.source().begin.line, std::string(error.description()));
    }
    if (!keys.contains("import")) {
      throw base::InputError(
          target, 0, "has no robot; expected a scene with the key import, such as \"arm.urdf\"");
    }
    keys.erase("held");
  } else {
    throw base::InputError(fmt::format(
        "--in: found {}; expected a robot (.urdf) or a scene (.toml)", base::printable(target)));
  }
  keys.insert_or_assign("configurations", fs::absolute(configurations).string());
  std::ostringstream text;
  text << keys << "\n";
  return scene::scene_of_text(text.str(), file);
}

scene::Scene asked_scene(const QuestionInput& input) {
  if (!is_scene(input.file)) return scene_with(needed_target(input), input.file);
  if (input.has("--in")) {
    throw base::InputError(
        fmt::format("--in: {} has configurations of its own; expected none, or a CSV of joint "
                    "values in its place",
                    base::printable(input.file.string())));
  }
  return scene::load_scene(input.file);
}

class ConfigurationQuestions final : public AnswersOf<ConfigurationEntry, ConfigurationAnswer> {
 public:
  explicit ConfigurationQuestions(const QuestionInput& input)
      : input_(input),
        task_(static_cast<ConfigurationTask>(asked_task(input, configuration_tasks))) {
    select(input.names, "configuration query", Precision::float64);
    const scene::Scene scene = asked_scene(input);
    made_ = scene_configurations(scene, input.file.string());
    inputs_ = scene.inputs();
    inputs_.push_back({"FILE", input.file});
    const std::size_t count = made_.poses.size() / made_.model.links;
    if (task_ == ConfigurationTask::motion) steps_ = static_cast<std::uint32_t>(count);
    size_ = count / steps_;
  }

  std::size_t size() const override { return size_; }
  std::string label(std::size_t i) const override {
    return task_ == ConfigurationTask::motion
               ? fmt::format("motion of {} configurations, asked at these alone", steps_)
               : fmt::format("configuration {}", i);
  }
  std::vector<files::NamedFile> inputs() const override { return inputs_; }
  std::string_view unit() const override { return "m"; }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    const ConfigurationEntry& entry = *asked_[contestant].entry;
    const bool takes = std::ranges::count(entry.tasks, task_) > 0 && supports(entry, made_.model);
    return ask_each(
        contestant, input_.seconds(), [takes](std::size_t) { return takes; },
        [&] {
          std::shared_ptr<ConfigurationQuery> query = make_query(entry);
          query->bind(made_.model);
          return [this, query](std::size_t i) {
            ConfigurationAnswer answer;
            const std::size_t poses = std::size_t{steps_} * made_.model.links;
            query->solve(
                task_,
                {std::span(made_.poses).subspan(i * poses, poses), made_.model.links, steps_},
                {&answer, 1});
            return answer;
          };
        });
  }

  std::vector<std::string> columns() const override {
    return {"configuration", "algorithm", "task",     "answer", "first",
            "second",        "step",      "distance", "status"};
  }
  void write(files::CsvWriter& csv, std::size_t i, std::size_t contestant) const override {
    const ConfigurationAnswer& given = answer(i, contestant);
    csv.field(i).field(info(contestant).name).field(to_string(task_)).field(verdict(given));
    for (const std::uint32_t part : {given.pair.a, given.pair.b}) csv.field(name_of(part));
    write_if(csv, given.step != ConfigurationAnswer::none, given.step);
    csv.field(given.distance).field(to_string(given.status));
    csv.end_row();
  }

  ShownAnswer shown(std::size_t i, std::size_t contestant) const override {
    const ConfigurationAnswer& given = answer(i, contestant);
    ShownAnswer shown = {
        .verdict = verdict(given), .status = given.status, .number = given.distance};
    if (given.pair.a != ConfigurationAnswer::none) {
      shown.more = fmt::format("{}, {}", base::printable(name_of(given.pair.a)),
                               base::printable(name_of(given.pair.b)));
    }
    if (given.step != ConfigurationAnswer::none) {
      shown.more += fmt::format("; first in step {} of 0 to {}", given.step, steps_ - 1);
    }
    return shown;
  }
  std::vector<std::string_view> verdicts() const override { return {"free", "contact", "unknown"}; }

 private:
  static std::string_view verdict(const ConfigurationAnswer& answer) {
    switch (answer.answer) {
      case Answer::separated: return "free";
      case Answer::unknown: return "unknown";
      default: return "contact";
    }
  }
  std::string name_of(std::uint32_t part) const {
    return part < made_.names.size() ? made_.names[part] : "";
  }

  QuestionInput input_;
  ConfigurationTask task_;
  SceneConfigurations made_;
  std::uint32_t steps_ = 1;
  std::size_t size_ = 0;
  std::vector<files::NamedFile> inputs_;
};

}  // namespace

std::vector<QueryOption> configuration_options() { return {option::target}; }

std::unique_ptr<Questions> read_configuration_questions(const QuestionInput& input) {
  return std::make_unique<ConfigurationQuestions>(input);
}

}  // namespace touchstone::kinds
