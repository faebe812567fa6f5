// The kind of configurations of a robot: batches, forms, contestants.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/geometry/tessellation.h"
#include "harness/kinds/configuration/configuration_grade.h"
#include "harness/kinds/configuration/configuration_kind.h"
#include "harness/kinds/mesh_cases.h"
#include "harness/scene/pose_log.h"
#include "harness/scene/scene.h"

namespace touchstone::kinds {
namespace {

std::span<const Pose> asked_poses(ConfigurationTask task, const DrawnMotion& motion,
                                  std::uint32_t links) {
  return task == ConfigurationTask::motion ? std::span<const Pose>(motion.poses)
                                           : motion.last(links);
}

std::uint32_t asked_steps(ConfigurationTask task) {
  return task == ConfigurationTask::motion ? DrawnMotion::steps : 1;
}

ConfigurationModel scaled_robot(ConfigurationModel robot, double scale) {
  for (ModelPart& part : robot.parts) {
    part.pose.translation *= scale;
    part.body = geometry::scaled_body(std::move(part.body), scale);
  }
  return robot;
}

// Turned by a rotation that permutes axes, about the origin, so that no product of poses is rounded otherwise.
Pose turned(const Pose& pose, const FormNumbers& numbers) {
  return {numbers.turn(pose.rotation), numbers.turn(pose.translation)};
}

auto solver(const ConfigurationEntry& entry, ConfigurationTask task) {
  return [&entry, task](const ConfigurationModel& robot, std::span<const DrawnMotion> motions,
                        std::span<ConfigurationAnswer> answers) {
    if (!supports(entry, robot)) return;
    const auto query = make_query(entry);
    query->bind(robot);
    std::vector<Pose> poses;
    for (const DrawnMotion& motion : motions) {
      const auto asked = asked_poses(task, motion, robot.links);
      poses.insert(poses.end(), asked.begin(), asked.end());
    }
    query->solve(task, {poses, robot.links, asked_steps(task)}, answers);
  };
}

class ConfigurationBatch final : public Batch {
 public:
  ConfigurationBatch(std::uint32_t number, const BatchRange& range)
      : cases_(
            range,
            [&](std::uint64_t group) {
              families::RandomDraws draws(base::mix(range.seed) + number, ~group);
              return drawn_robot(number, draws);
            },
            [&](std::uint64_t index, const ConfigurationModel& robot) {
              auto draws = draws_of(configuration_kind(), number, range.seed, index);
              return drawn_motion(number, robot, draws);
            }) {}

  std::vector<Graded> ask(const Contestant& contestant, CaseForm form, double time_limit) override {
    const auto& entry = contestant.of<ConfigurationEntry>();
    const auto task = static_cast<ConfigurationTask>(contestant.task);
    return cases_.ask(
        form, time_limit, [&](std::size_t i) { return in_form(i, form); },
        [&] { return solver(entry, task); },
        [&](std::size_t i, ConfigurationAnswer answer) {
          if (form == CaseForm::scaled) answer.distance /= cases_.numbers(i).scale;
          return grade(task, i, answer);
        });
  }

  std::string write(const Contestant& contestant, std::size_t place,
                    const std::filesystem::path& stem) const override {
    const auto task = static_cast<ConfigurationTask>(contestant.task);
    write_case(cases_.target(place), asked_poses(task, cases_[place], cases_.target(place).links),
               stem);
    return fmt::format(
        "touchstone query {}.toml --kind configuration --with exact,{} --task {} --out answers.csv",
        stem.string(), contestant.info->name, contestant.task_name());
  }

 private:
  std::optional<std::pair<ConfigurationModel, DrawnMotion>> in_form(std::size_t i,
                                                                    CaseForm form) const {
    const FormNumbers numbers = cases_.numbers(i);
    ConfigurationModel robot = cases_.target(i);
    DrawnMotion motion = cases_[i];
    if (form == CaseForm::scaled) {
      for (Pose& pose : motion.poses) pose.translation *= numbers.scale;
      return std::pair(scaled_robot(std::move(robot), numbers.scale), std::move(motion));
    }
    if (form != CaseForm::moved) return std::nullopt;
    for (Pose& pose : motion.poses) pose = turned(pose, numbers);
    for (ModelPart& part : robot.parts) {
      if (part.link == ModelPart::world) part.pose = turned(part.pose, numbers);
    }
    return std::pair(std::move(robot), std::move(motion));
  }

  const ConfigurationAnswer& truth(std::size_t i, ConfigurationTask task) {
    auto& known = truths_[static_cast<std::size_t>(task)];
    if (known.empty()) {
      known = cases_.answers(solver(*registry::find<ConfigurationEntry>("exact"), task));
    }
    return known[i];
  }

  Graded grade(ConfigurationTask task, std::size_t i, const ConfigurationAnswer& answer) {
    const ConfigurationModel& robot = cases_.target(i);
    const auto poses = asked_poses(task, cases_[i], robot.links);
    bool names_pair = true;
    if (answer.pair.a != ConfigurationAnswer::none || answer.answer != Answer::separated) {
      // The distance is that of this form.
      if (pairs_.of != &robot)
        pairs_ = {&robot, std::make_unique<ConfigurationTruth>(robot, PairAnswers::exact)};
      names_pair = pairs_.truth->names_pair(answer, poses);
    }
    return grade_configuration(task, answer, truth(i, task), names_pair,
                               configuration_reach(robot, poses));
  }

  // A scene whose frames are the configurations, with each part of the robot as a body on a track.
  static void write_case(const ConfigurationModel& robot, std::span<const Pose> poses,
                         const std::filesystem::path& stem) {
    const std::filesystem::path scene = stem.string() + ".toml", log = stem.string() + ".csv";
    std::vector<SceneBody> bodies;
    std::vector<std::string> names;
    for (const ModelPart& part : robot.parts) {
      bodies.push_back({part.body, placed(part, poses.first(robot.links))});
      names.push_back(fmt::format("part {}", names.size()));
    }
    std::string ignored;
    for (std::uint32_t a = 0; a < robot.parts.size(); ++a) {
      for (std::uint32_t b = a + 1; b < robot.parts.size(); ++b) {
        if (robot.parts[a].link == ModelPart::world) continue;
        if (std::ranges::binary_search(robot.pairs, IndexPair{a, b})) continue;
        ignored += fmt::format("[\"{}\", \"{}\"], ", names[a], names[b]);
      }
    }
    scene::write_scene(scene, bodies, names,
                       fmt::format("poses = \"{}\"\nfixed_pairs = false\nignore = [{}]\n",
                                   log.filename().string(), ignored));
    scene::PoseMatrixWriter written(log);
    for (std::size_t step = 0; step < poses.size() / robot.links; ++step) {
      const auto links = poses.subspan(step * robot.links, robot.links);
      for (std::size_t i = 0; i < robot.parts.size(); ++i) {
        if (robot.parts[i].link == ModelPart::world) continue;
        written.add(step, i, placed(robot.parts[i], links));
      }
    }
    written.close();
  }

  TargetCases<ConfigurationModel, DrawnMotion, ConfigurationAnswer> cases_;
  std::array<std::vector<ConfigurationAnswer>, configuration_tasks.size()> truths_;
  // Of pairs of the robot that was asked last.
  struct {
    const ConfigurationModel* of = nullptr;
    std::unique_ptr<ConfigurationTruth> truth;
  } pairs_;
};

}  // namespace

const Kind& configuration_kind() {
  static const KindOf<ConfigurationEntry> kind(
      {.registry = kind_words<ConfigurationEntry>,
       .title = "Configurations of a robot",
       .contract = "configuration query",
       .legend = "A contact is a pair of parts that is asked and shares a point; of a motion, also "
                 "the first step in contact counts: a later one is missed, an earlier one false. "
                 "*Inexact*: a named pair that is not in contact or so near, or a distance that is "
                 "off by more than 1e-11 of the reach, which is the greatest distance of a link or "
                 "an obstacle "
                 "from the origin, and at least 1 m.",
       .tasks = configuration_tasks,
       .draw_number = 7},
      {.options = configuration_options,
       .read = read_configuration_questions,
       .offers =
           [](const ConfigurationEntry& entry, Precision scalar, std::uint8_t task) {
             return scalar == Precision::float64 &&
                    std::ranges::count(entry.tasks, static_cast<ConfigurationTask>(task)) > 0;
           },
       .promises = [](const ConfigurationEntry& entry) { return !entry.approximate; },
       .families = configuration_families,
       .draw = drawn_batch<ConfigurationBatch>,
       .sets = configuration_sets});
  return kind;
}

}  // namespace touchstone::kinds
