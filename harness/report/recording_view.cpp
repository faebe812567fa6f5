// Plays a scene and asks algorithms about its pairs.
#include "harness/report/recording_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "harness/report/body_view.h"
#include "harness/report/packed_numbers.h"
#include "harness/report/scene_view.h"

namespace touchstone::report {
namespace {

using files::OrderedJson;

// For each body a translation and a quaternion (w, x, y, z).
std::string packed_poses(const measure::BlockInput& input) {
  std::vector<float> numbers;
  for (const measure::BlockFrame& frame : input.frames) {
    for (const Pose& pose : frame.poses) {
      const Eigen::Quaterniond turn(pose.rotation);
      for (const double x : {pose.translation.x(), pose.translation.y(), pose.translation.z(),
                             turn.w(), turn.x(), turn.y(), turn.z()}) {
        numbers.push_back(static_cast<float>(x));
      }
    }
  }
  return packed_frames(numbers, 7 * input.frames.front().poses.size());
}

// For each body the least and the greatest corner of its box. An absent one has the empty box,
// whose numbers are infinite.
std::string packed_boxes(const measure::BlockInput& input, std::size_t bodies) {
  std::vector<float> numbers;
  for (const measure::BlockFrame& frame : input.frames) {
    for (std::size_t body = 0; body < bodies; ++body) {
      // The array of the first frame lacks those that arrive later.
      append(numbers, body < frame.boxes.size() ? frame.boxes[body] : Aabb::empty());
    }
  }
  return packed_frames(numbers, 6 * bodies);
}

// In a scene with bodies that are not convex, ours of the concave phases are asked too.
std::vector<measure::NarrowChoice> choices(const RecordingRequest& request,
                                           const measure::BlockInput& input) {
  std::vector<measure::NarrowChoice> all;
  for (const NarrowPhaseEntry* entry : request.narrow) {
    const auto scalar =
        offers(*entry, Precision::float64) ? Precision::float64 : Precision::float32;
    all.push_back({.entry = entry, .settings = {.scalar = scalar}});
  }
  if (input.bodies.empty()) return all;
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (entry.info.origin != Origin::ours || !is_built(entry.info)) continue;
    const auto made = measure::concave_choices(
        std::array{&entry}, std::array{registry::find<MidPhaseEntry>(measure::usual_mid_phase)},
        std::array{Precision::float64});
    all.insert(all.end(), made.begin(), made.end());
  }
  return all;
}

OrderedJson pairs_view(const ScenePairs& pairs, std::span<const measure::NarrowChoice> asked,
                       double time_limit) {
  std::vector<std::vector<std::uint8_t>> verdicts;
  for (const measure::NarrowChoice& choice : asked) {
    verdicts.push_back(pairs.verdicts(choice, time_limit));
  }
  const std::vector<double> distances = pairs.distances(time_limit);
  OrderedJson frames = OrderedJson::array();
  for (std::size_t frame = 0; frame < pairs.frames(); ++frame) {
    const std::size_t begin = pairs.start(frame), end = pairs.start(frame + 1);
    std::vector<std::uint8_t> by_pair;
    for (std::size_t i = begin; i < end; ++i) {
      for (const std::vector<std::uint8_t>& of_algorithm : verdicts) {
        by_pair.push_back(of_algorithm[i]);
      }
    }
    frames.push_back({{"bodies", packed(pairs.bodies(frame))},
                      {"verdicts", packed(by_pair)},
                      {"distances", packed(std::vector<double>(distances.begin() + begin,
                                                               distances.begin() + end))}});
  }
  return frames;
}

}  // namespace

OrderedJson recording_view(const RecordingRequest& request) {
  scene::Scene scene = scene::load_scene(request.scene, request.overrides);
  files::expect_other_files(scene.inputs(), std::vector<files::NamedFile>{{"--out", request.page}});
  const std::string hash = scene::scene_hash(scene);  // of all frames
  const int all_frames =
      scene.recording.empty() ? scene.frames : static_cast<int>(scene.recording.size());
  scene.frames = std::min(all_frames, request.most_frames);
  const bool boxes_only = !scene.recording.empty();
  if (boxes_only) scene.recording.resize(static_cast<std::size_t>(scene.frames));
  const measure::BlockInput input(scene, scene::BoxKind::tight, !boxes_only);
  std::size_t bodies = 0;
  for (const measure::BlockFrame& frame : input.frames) {
    bodies = std::max(bodies, frame.boxes.size());
  }
  const ScenePairs pairs(input);
  OrderedJson shapes = OrderedJson::array(), names = OrderedJson::array();
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    shapes.push_back(scene.concave_of(i) != nullptr ? mesh_view(*scene.mesh_of(i))
                                                    : shape_view(scene.shapes[i]));
  }
  OrderedJson fixed = OrderedJson::array();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].moving) fixed.push_back(i);
  }
  const std::vector<measure::NarrowChoice> asked = choices(request, input);
  for (const measure::NarrowChoice& choice : asked) {
    if (!boxes_only) names.push_back(choice.name());
  }
  return {{"name", scene.name},
          {"source", request.scene.string()},
          {"hash", hash},
          {"time_step", scene.motion.time_step},
          {"frames", input.frames.size()},
          {"frames_of_scene", all_frames},
          {"boxes_only", boxes_only},
          {"bodies", bodies},
          {"shapes", std::move(shapes)},
          {"shape_of", input.shape_of},
          {"fixed", std::move(fixed)},
          {"poses", boxes_only ? std::string() : packed_poses(input)},
          {"boxes", packed_boxes(input, bodies)},
          {"algorithms", std::move(names)},
          {"pairs", pairs_view(pairs, asked, request.time_limit)},
          {"structures", structure_views(input, request.broad)}};
}

}  // namespace touchstone::report
