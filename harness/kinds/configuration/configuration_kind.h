// What the files about configurations of robots share.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/configuration_query.h"
#include "harness/families/draws.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/timed_set.h"
#include "harness/scene/scene.h"

namespace touchstone::kinds {

inline constexpr std::array<std::string_view, 3> configuration_tasks = {"free", "distance",
                                                                        "motion"};

// Who answers for pairs of parts: `certified` and `fused`, or the oracle.
enum class PairAnswers : std::uint8_t { fast, exact };
// An instance of the entry. The oracle asks `answers`, and all others the fast ones.
std::unique_ptr<ConfigurationQuery> make_query(const ConfigurationEntry& entry,
                                               PairAnswers answers = PairAnswers::exact);
bool supports(const ConfigurationEntry& entry, const ConfigurationModel& model);

// What is right of configurations of a model, by every pair on its own.
class ConfigurationTruth {
 public:
  ConfigurationTruth(const ConfigurationModel& model, PairAnswers answers);

  ConfigurationAnswer answer(ConfigurationTask task, std::span<const Pose> poses,
                             std::uint32_t steps);
  // Whether the pair is asked and shares a point; false if that is not known.
  bool touches(const IndexPair& pair, std::span<const Pose> links);
  // Of a contact: whether it names a pair in contact. Of a finite distance: whether that is the distance of the pair that
  // it names. True for all other answers. `poses` are those of the answer's configuration or motion.
  bool names_pair(const ConfigurationAnswer& answer, std::span<const Pose> poses);

 private:
  Outcome outcome_of(ConcaveTask task, const IndexPair& pair, std::span<const Pose> links);

  const ConfigurationModel& model_;
  std::unique_ptr<ConfigurationQuery> query_;
  std::unique_ptr<ConcavePhase> phase_;
  std::vector<ConcaveBody> bodies_;
};

// A robot among what stands still, and its configurations: of each the poses of all links.
struct SceneConfigurations {
  ConfigurationModel model;
  std::vector<Pose> poses;  // configuration by configuration
  // Of the parts: the name of the body, and its number in the scene.
  std::vector<std::string> names;
};

// The bodies of a scene that follow tracks are parts of links, and its frames are the configurations. Consecutive bodies
// of one name that keep their places relative to each other are one link, in the frame of the first of them. The
// places of the others in it are rounded. Other bodies are the world. Throws InputError if they move, or nothing
// follows a track.
SceneConfigurations scene_configurations(const scene::Scene& scene, const std::string& file);

// Of drawn robots.

// A robot of four to seven links, and a motion of it.
struct DrawnMotion {
  static constexpr std::uint32_t steps = 4;
  std::vector<Pose> poses;  // of each step those of all links
  std::span<const Pose> last(std::uint32_t links) const { return std::span(poses).last(links); }
};

// What links are made of, and where motions end: anywhere, or at contact, up to 1e-6 m.
std::vector<Family> configuration_families();
ConfigurationModel drawn_robot(std::uint32_t family, families::Draws& draws);
DrawnMotion drawn_motion(std::uint32_t family, const ConfigurationModel& robot,
                         families::Draws& draws);

// Timed sets of a scene's configurations.

std::vector<PlannedSet> configuration_sets(files::TomlTable& table,
                                           const std::filesystem::path& home);
// One of them, of these algorithms and a task.
TimedSet configuration_set(std::shared_ptr<const SceneConfigurations> input,
                           const std::vector<const ConfigurationEntry*>& entries,
                           ConfigurationTask task, std::uint32_t steps);

// Configurations of a robot, in a CSV file or a scene.

std::vector<QueryOption> configuration_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_configuration_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
