// Planted algorithms of the kinds that are checked on families: each answers the same to everything.
#pragma once

#include <csignal>
#include <memory>

#include "harness/kinds/grading.h"

namespace touchstone {

enum class Habit : std::uint8_t { yes, no, gives_up, crashes };

template <Habit habit>
Status status_of_habit() {
  if constexpr (habit == Habit::crashes) std::raise(SIGKILL);
  return habit == Habit::gives_up ? Status::not_converged : Status::ok;
}

template <Habit habit>
struct PlantedConcave final : ConcavePhase {
  void bind(std::span<const ConcaveBody>) override {}
  void solve(ConcaveTask, const PlacedConcave&, const PlacedConcave&, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    outcome = {};
    pairs.clear();
    outcome.status = status_of_habit<habit>();
    outcome.answer = habit == Habit::yes ? Answer::overlapping : Answer::separated;
  }
};

template <Habit habit>
struct PlantedRays final : RayCast {
  void bind(const TriangleMesh&) override {}
  void cast(RayTask, std::span<const Ray>, std::span<RayHit> hits) override {
    for (RayHit& hit : hits) hit = {.hit = habit == Habit::yes, .status = status_of_habit<habit>()};
  }
};

template <Habit habit>
struct PlantedPoints final : PointQuery {
  void bind(const TriangleMesh&) override {}
  void query(PointTask, std::span<const Vec3d>, std::span<PointAnswer> answers) override {
    for (PointAnswer& answer : answers) {
      answer = {};
      answer.status = status_of_habit<habit>();
      answer.side = habit == Habit::yes ? PointSide::inside : PointSide::outside;
    }
  }
};

template <Habit habit>
struct PlantedSceneRays final : SceneRayCast {
  void bind(std::span<const SceneBody>) override {}
  void place(std::span<const Pose>) override {}
  void cast(RayTask, std::span<const Ray>, std::span<SceneRayHit> hits) override {
    for (SceneRayHit& hit : hits) {
      hit = {.hit = habit == Habit::yes, .status = status_of_habit<habit>()};
      if (hit.hit) hit.body = 0;
    }
  }
};

// Tells another body, or another length, than the first.
struct AstraySceneRays final : SceneRayCast {
  std::unique_ptr<SceneRayCast> exact = registry::find<SceneRayCastEntry>("exact")->make();
  std::uint32_t bodies = 0;

  void bind(std::span<const SceneBody> all) override {
    bodies = static_cast<std::uint32_t>(all.size());
    exact->bind(all);
  }
  void place(std::span<const Pose> poses) override { exact->place(poses); }
  void cast(RayTask task, std::span<const Ray> rays, std::span<SceneRayHit> hits) override {
    exact->cast(task, rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (!hits[i].hit) continue;
      if (i % 2 == 0) {
        hits[i].body = (hits[i].body + 1) % bodies;
      } else {
        hits[i].t += 1e-4 / rays[i].direction.norm();
      }
    }
  }
};

template <Habit habit>
struct PlantedCast final : Cast {
  void bind(std::span<const Shape>) override {}
  void solve(const CastBatch&, std::span<CastOutcome> outcomes) override {
    for (CastOutcome& outcome : outcomes) {
      outcome = {};
      outcome.status = status_of_habit<habit>();
      outcome.answer = habit == Habit::yes ? CastAnswer::hit : CastAnswer::miss;
      if (habit == Habit::yes) outcome.toi = outcome.lower = 0;
    }
  }
};

template <Habit habit>
struct PlantedCcd final : Ccd {
  void solve(FeaturePair, std::span<const CcdQuery>, std::span<CcdOutcome> outcomes) override {
    for (CcdOutcome& outcome : outcomes) {
      outcome = {};
      outcome.status = status_of_habit<habit>();
      outcome.answer = habit == Habit::yes ? CcdAnswer::hit : CcdAnswer::miss;
      if (habit == Habit::yes) outcome.toi = outcome.free_before = outcome.contact_by = 0;
    }
  }
};

template <Habit habit>
struct PlantedConfigurations final : ConfigurationQuery {
  IndexPair pair;

  void bind(const ConfigurationModel& model) override { pair = model.pairs.front(); }
  void solve(ConfigurationTask, const Configurations&,
             std::span<ConfigurationAnswer> answers) override {
    for (ConfigurationAnswer& answer : answers) {
      answer = {};
      answer.status = status_of_habit<habit>();
      answer.answer = habit == Habit::yes ? Answer::overlapping : Answer::separated;
      answer.pair = pair;
    }
  }
};

// One of each kind, in the order of kinds::kinds(), in double; of points the side is asked.
template <Habit habit>
struct PlantedKinds {
  Origin origin = Origin::ours;
  ConcaveEntry concave{
      .info = {.name = "planted", .citation = "none", .origin = origin},
      .tasks = {ConcaveTask::intersect},
      .scalars = {Precision::float64},
      .make = [](const auto&) { return std::make_unique<PlantedConcave<habit>>(); }};
  RayCastEntry rays{.info = concave.info,
                    .tasks = {RayTask::any},
                    .scalars = {Precision::float64},
                    .exact_verdicts = true,
                    .make = [](const auto&) { return std::make_unique<PlantedRays<habit>>(); }};
  PointQueryEntry points{.info = concave.info, .tasks = {PointTask::side}, .make = [] {
                           return std::make_unique<PlantedPoints<habit>>();
                         }};
  CastEntry cast{.info = concave.info,
                 .scalars = {Precision::float64},
                 .rotation = true,
                 .make = [](const auto&) { return std::make_unique<PlantedCast<habit>>(); }};
  CcdEntry ccd{.info = concave.info,
               .make = [](const auto&) { return std::make_unique<PlantedCcd<habit>>(); }};
  SceneRayCastEntry scene_rays{.info = concave.info, .tasks = {RayTask::any}, .make = [] {
                                 return std::make_unique<PlantedSceneRays<habit>>();
                               }};
  ConfigurationEntry configurations{
      .info = concave.info, .tasks = {ConfigurationTask::free}, .make = [](const auto&) {
        return std::make_unique<PlantedConfigurations<habit>>();
      }};

  std::vector<kinds::Contestant> contestants() const {
    const auto of = [](const kinds::Kind& kind, const auto& entry, std::uint8_t task) {
      return kinds::contestant_of(kind, entry, true, Precision::float64, task);
    };
    return {of(kinds::mesh_kind(), concave, 0),
            of(kinds::ray_kind(), rays, 1),
            of(kinds::point_kind(), points, 1),
            of(kinds::cast_kind(), cast, 0),
            of(kinds::feature_kind(), ccd, 0),
            of(kinds::scene_ray_kind(), scene_rays, 1),
            of(kinds::configuration_kind(), configurations, 0)};
  }
};

}  // namespace touchstone
