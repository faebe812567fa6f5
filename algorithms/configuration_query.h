// The contract of configuration queries: what a planner asks of a robot among obstacles. Which poses its links have is
// the caller's work (kinematics). Configuration queries and the harness include this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/concave_phase.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/pose.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {

enum class ConfigurationTask : std::uint8_t {
  free,      // does no pair of parts that is asked share a point?
  distance,  // how far is the nearest pair apart? 0 if one shares a point
  motion,    // of consecutive configurations, which is the first that is not free?
};

std::string_view to_string(ConfigurationTask task);

// A convex body, which is a compound of one part, or a mesh; closed, so that parts that touch share a point.
struct ModelPart {
  static constexpr std::uint32_t world = std::numeric_limits<std::uint32_t>::max();

  ConcaveBody body;
  std::uint32_t link = world;  // the link that it moves with, or the world
  // In the frame of the link, or in the world (metres). Rotations, and those of links, may be off by a thousandth, as
  // those of files may; they are taken as they stand.
  Pose pose;
};

// A robot and what stands around it.
struct ConfigurationModel {
  std::uint32_t links = 0;
  std::vector<ModelPart> parts;
  // The pairs of parts that are asked, a < b, each once and sorted. None is of two parts of the world, or of one link.
  std::vector<IndexPair> pairs;
};

// `inner`, which is relative to `outer`, in the world: in doubles, each sum from the left. A part is where the pose takes it
// that this gives for its link's pose and its own, literally; a part of the world is where its own pose takes it.
inline Pose placed_within(const Pose& outer, const Pose& inner) {
  const Mat3d &r = outer.rotation, &s = inner.rotation;
  const Vec3d& t = inner.translation;
  Pose placed;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      placed.rotation(i, k) = r(i, 0) * s(0, k) + r(i, 1) * s(1, k) + r(i, 2) * s(2, k);
    }
    placed.translation[i] = r(i, 0) * t[0] + r(i, 1) * t[1] + r(i, 2) * t[2] + outer.translation[i];
  }
  return placed;
}

// Where a part is: `links` are the poses of the links in the world.
inline Pose placed(const ModelPart& part, std::span<const Pose> links) {
  return part.link == ModelPart::world ? part.pose : placed_within(links[part.link], part.pose);
}

// Configurations behind each other: of each the poses of all links in the world.
struct Configurations {
  std::span<const Pose> poses;
  std::uint32_t links = 0;
  // So many consecutive configurations are one motion, which has one answer; 1 but for ConfigurationTask::motion.
  std::uint32_t steps = 1;

  std::size_t answers() const {
    return links == 0 ? 0 : poses.size() / (std::size_t{links} * steps);
  }
  // The poses of the links in a step of a motion.
  std::span<const Pose> of(std::size_t motion, std::uint32_t step = 0) const {
    return poses.subspan((motion * steps + step) * links, links);
  }
};

struct ConfigurationAnswer {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  // `separated`: all is free; `overlapping`: a pair shares a point, a touch included; or `unknown`.
  Answer answer = Answer::unknown;
  Status status = Status::unsupported;
  // A pair of parts that shares a point, whichever was found first; of `distance` the nearest one.
  IndexPair pair = {none, none};
  std::uint32_t step = none;        // of a motion: the first configuration in contact, from 0
  double distance = Outcome::none;  // metres, of `distance`; 0 in contact, infinite without pairs
};

// Writes an answer for each configuration, which is answer_of(links); of a motion that of the first step that is not free,
// or not known to be, with its number.
template <class AnswerOf>
void answer_steps(ConfigurationTask task, const Configurations& configurations,
                  std::span<ConfigurationAnswer> answers, const AnswerOf& answer_of) {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    for (std::uint32_t step = 0; step < configurations.steps; ++step) {
      answers[i] = answer_of(configurations.of(i, step));
      if (answers[i].answer == Answer::separated) continue;
      if (task == ConfigurationTask::motion) answers[i].step = step;
      break;
    }
  }
}

struct ConfigurationSettings {
  // What answers for pairs of convex parts, and for others, for algorithms that leave this to another one; never null.
  std::function<std::unique_ptr<NarrowPhase>()> narrow_phase = {};
  std::function<std::unique_ptr<ConcavePhase>()> concave_phase = {};
};

// One instance for each worker, never shared between threads.
class ConfigurationQuery {
 public:
  virtual ~ConfigurationQuery() = default;

  // Prepares all that no configuration changes; may come again, for another model. Numbers are finite, and the model
  // lives, unchanged, until then or the end.
  virtual void bind(const ConfigurationModel& model) = 0;

  // Writes the whole of answers[i] for each configuration, or motion, i. Never throws on finite input: a failure is a status.
  virtual void solve(ConfigurationTask task, const Configurations& configurations,
                     std::span<ConfigurationAnswer> answers) = 0;
};

struct ConfigurationEntry {
  AlgorithmInfo info;
  std::vector<ConfigurationTask> tasks;
  // True for the models that it supports; null means all. `bind` gets no others.
  bool (*supports)(const ConfigurationModel& model) = nullptr;
  // True if its answers are no promise. All is in doubles.
  bool approximate = false;
  // Null if it is not built.
  std::function<std::unique_ptr<ConfigurationQuery>(const ConfigurationSettings&)> make;
};

}  // namespace touchstone
