// Measures gaps and relative motion of pairs.
#include "harness/report/pair_mix.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/pair_query.h"
#include "algorithms/registry.h"
#include "harness/scene/kinematics.h"
#include "harness/scene/player.h"

namespace touchstone::report {
namespace {

constexpr std::size_t most_mix_frames = 24, most_mix_pairs = 20'000;
constexpr double contact_share = 0.01, rest_share = 0.001;

double edge_of(const Aabb& box) {
  double edge = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    edge = std::max(edge, static_cast<double>(box.max[axis]) - box.min[axis]);
  return edge;
}

std::size_t range_of(double part) {
  constexpr std::array limits = {-0.1, -0.01, -0.001, 0.001, 0.01, 0.1};
  return static_cast<std::size_t>(std::ranges::upper_bound(limits, part) - limits.begin());
}

// How far a point of the body goes.
Vec3d shift(const Pose& from, const Pose& to, const Vec3d& point) {
  return to(from.rotation.transpose() * (point - from.translation)) - point;
}

class Mix {
 public:
  explicit Mix(const scene::Scene& scene)
      : scene_(scene),
        player_(scene, scene::BoxKind::tight),
        ahead_(scene),
        query_(registry::find<NarrowPhaseEntry>("gjk")->make({}), scene.shapes),
        executor_(1),
        broad_(registry::find<BroadPhaseEntry>("sweep-one-axis")->make(executor_)) {}

  PairMix look() {
    // The last frame of several has none behind it, to which bodies would move.
    const auto frames = static_cast<std::size_t>(std::max(scene_.frames - 1, 1));
    mix_.frames = std::min(frames, most_mix_frames);
    for (std::size_t i = 0; i < mix_.frames; ++i) {
      const std::size_t frame = i * frames / mix_.frames;
      while (static_cast<std::size_t>(player_.frame()) < frame) next();
      look_at_frame();
    }
    return mix_;
  }

 private:
  void next() {
    player_.next();
    ahead_.next();
  }

  std::vector<IndexPair> pairs() {
    PairSink sink;
    broad_->build(player_.boxes());
    broad_->find_pairs(sink);
    std::vector<IndexPair> found = sink.gather();
    for (IndexPair& pair : found) {
      if (pair.b < pair.a) std::swap(pair.a, pair.b);
    }
    const auto place = [](const IndexPair& pair) { return std::pair(pair.a, pair.b); };
    std::ranges::sort(found, {}, place);
    return found;
  }

  void look_at_frame() {
    ahead_.next();
    std::vector<IndexPair> here = pairs();
    std::vector<IndexPair> asked = scene_.pairs.empty() ? here : scene_.pairs;
    scene_.filter.apply(asked);
    const std::size_t step = (asked.size() + most_mix_pairs - 1) / most_mix_pairs;
    for (std::size_t i = 0; i < asked.size(); i += step) look_at(asked[i]);
    if (!player_.next()) return;
    const std::vector<IndexPair> then = pairs();
    std::vector<IndexPair> both;
    const auto less = [](const IndexPair& x, const IndexPair& y) {
      return std::pair(x.a, x.b) < std::pair(y.a, y.b);
    };
    std::ranges::set_intersection(here, then, std::back_inserter(both), less);
    mix_.again += both.size();
    mix_.after_first += then.size();
  }

  void look_at(const IndexPair& pair) {
    const scene::Body &a = scene_.bodies[pair.a], &b = scene_.bodies[pair.b];
    if (scene_.concave_of(a.shape) != nullptr || scene_.concave_of(b.shape) != nullptr) {
      ++mix_.not_convex;
      return;
    }
    const std::span<const Pose> poses = player_.poses(), then = ahead_.poses();
    const Outcome outcome =
        query_.solve(Task::signed_distance, {a.shape, poses[pair.a], b.shape, poses[pair.b]});
    const double edge =
        std::min(edge_of(player_.boxes()[pair.a]), edge_of(player_.boxes()[pair.b]));
    if (!std::isfinite(outcome.distance) || !(edge > 0)) {
      ++mix_.unknown;
      return;
    }
    ++mix_.gaps[range_of(outcome.distance / edge)];
    if (outcome.distance > contact_share * edge) {
      ++mix_.apart;
      return;
    }
    const Vec3d at = 0.5 * (outcome.witness_a + outcome.witness_b);
    const double slip =
        (shift(poses[pair.a], then[pair.a], at) - shift(poses[pair.b], then[pair.b], at)).norm();
    ++(slip < rest_share * edge ? mix_.resting : mix_.sliding);
  }

  const scene::Scene& scene_;
  scene::ScenePlayer player_;
  scene::Kinematics ahead_;  // a frame ahead of the player while pairs are looked at
  PairQuery query_;
  Executor executor_;
  std::unique_ptr<BroadPhase> broad_;
  PairMix mix_;
};

}  // namespace

PairMix pair_mix(const scene::Scene& scene) { return Mix(scene).look(); }

}  // namespace touchstone::report
