// Tests of the pipeline of a configuration.
#include "harness/trade/pipeline/frame_pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "harness/trade/evaluation.h"
#include "tests/harness/trade/trade_scenes.h"

namespace touchstone {
namespace {

const std::string mixed = R"(
generator = "uniform"
count = 150
overlaps = 6
shapes = ["box", "sphere", "capsule", {type = "hull", points = 12}]
)";
const std::string boxes_alone = R"(
generator = "uniform"
count = 120
overlaps = 6
shapes = ["box"]
)";
const std::string spheres = R"(
generator = "uniform"
count = 150
overlaps = 6
shapes = ["sphere"]
)";
const std::string still = R"(
generator = "uniform"
count = 100
overlaps = 6
moving = 0
)";

// A scene with everything that a test needs for it.
struct World {
  explicit World(const std::string& text, Task asked = Task::intersect)
      : task(asked),
        scene(scene_of(text)),
        frames(scene, 8),
        library(frames, simple_representing()) {}

  std::vector<trade::FrameTruth> truth() const {
    return trade::find_truth(frames, trade::sampling_order(frames.frames.size()), 100, 1);
  }
  trade::Evaluation errors_of(const trade::TradeGrid& grid,
                              const std::vector<trade::FrameTruth>& known) {
    const trade::TradePoint point = point_of(grid, frames, library, task);
    return trade::evaluate(frames, {&point, 1}, known, task).front();
  }

  Task task;
  scene::Scene scene;
  trade::SceneFrames frames;
  trade::StandInLibrary library;
};

TEST(TradePipeline, WhatHoldsTheBodyMissesNoContact) {
  World world(mixed);
  const std::vector<trade::FrameTruth> truth = world.truth();
  std::vector<trade::TradeGrid> grids;
  for (const char* boxes_name : {"tight", "loose", "fat-0.1"}) {
    for (const char* narrow : {"none", "certified"}) {
      for (const proxies::Form form : {proxies::Form::as_given, proxies::Form::sphere}) {
        trade::TradeGrid grid = grid_with(narrow, "dynamic-bvh");
        grid.boxes = {*trade::parse_box_choice(boxes_name)};
        grid.representations = {all_as(form)};
        grids.push_back(grid);
      }
    }
  }
  std::int64_t false_positives = 0;
  for (const trade::TradeGrid& grid : grids) {
    const trade::Evaluation found = world.errors_of(grid, truth);
    ASSERT_TRUE(found.ok()) << found.words;
    EXPECT_EQ(found.errors.false_negatives, 0);
    EXPECT_EQ(found.errors.failed, 0);
    EXPECT_GT(found.errors.contacts, 100);
    EXPECT_GT(found.errors.near - found.errors.contacts, 100);
    false_positives += found.errors.false_positives;
    const bool is_exact =
        grid.narrow[0].size() == 1 && grid.representations[0] == all_as(proxies::Form::as_given);
    if (is_exact) {
      EXPECT_EQ(found.errors.wrong_share(), 0);
    }
  }
  EXPECT_GT(false_positives, 100);
}

// Rings that are linked and do not touch, then rings that do.
const std::string rings = R"(
frames = 2
body = [
  {shape = {type = "torus", tube_radius = 0.2}},
  {shape = {type = "torus", tube_radius = 0.2}, rotation = [1, 0, 0, 0, 0, -1, 0, 1, 0], translation = [1, 0, 0], velocity = [0.1, 0, 0]},
  {shape = {type = "torus", tube_radius = 0.2}, translation = [0, 8, 0]},
  {shape = {type = "torus", tube_radius = 0.2}, rotation = [1, 0, 0, 0, 0, -1, 0, 1, 0], translation = [1.9, 8, 0], velocity = [0.1, 0, 0]},
]
)";

TEST(TradePipeline, AConcavePhaseTakesTheMeshItself) {
  for (const Task task : {Task::intersect, Task::distance}) {
    World world(rings, task);
    const std::vector<trade::FrameTruth> truth = world.truth();
    trade::Representing as_hull = simple_representing();
    as_hull.represent = [](const Shape& hull, const geometry::Mesh*,
                           const proxies::Representation&) {
      return std::vector<proxies::Part>{{hull, {}}};
    };
    trade::StandInLibrary library(world.frames, as_hull);
    trade::TradeGrid grid = grid_with("gjk");
    grid.narrow.clear();
    grid.concave = {registry::find<ConcaveEntry>("fused")};
    for (const proxies::Form form :
         {proxies::Form::mesh, proxies::Form::as_given, proxies::Form::hull}) {
      grid.representations = {all_as(form)};
      const trade::TradePoint point = point_of(grid, world.frames, library, task);
      EXPECT_EQ(point.configuration.narrow_name(), "fused double");
      const trade::Evaluation found =
          trade::evaluate(world.frames, {&point, 1}, truth, task).front();
      ASSERT_TRUE(found.ok()) << found.words;
      EXPECT_EQ(found.errors.contacts, 2);
      EXPECT_EQ(found.errors.false_negatives, 0);
      // The hulls of linked rings overlap.
      EXPECT_EQ(found.errors.false_positives, form == proxies::Form::hull ? 2 : 0);
      EXPECT_EQ(point.configuration.representations.name(),
                form == proxies::Form::hull ? "hull" : "as-given");
      if (task == Task::distance && form != proxies::Form::hull) {
        EXPECT_LT(found.errors.value.greatest, 1e-6);
        EXPECT_GT(found.errors.values, 0);
      }
    }
  }
}

TEST(TradePipeline, NoNarrowPhaseTakesAMeshAsItIsGiven) {
  World world(rings);
  const trade::TradeGrid grid = grid_with("gjk");
  const trade::GridPoints made =
      trade::expand({&grid, 1}, world.frames, world.library, Task::intersect);
  EXPECT_TRUE(made.points.empty());
  ASSERT_EQ(made.left_out.size(), 1u);
  EXPECT_THAT(made.left_out.begin()->first, testing::HasSubstr("expected hull, parts or mesh"));
}

TEST(TradePipeline, WithoutANarrowPhaseEveryPairOfBoxesIsAContact) {
  World world(mixed);
  const std::vector<trade::FrameTruth> truth = world.truth();
  const trade::TradePoint point = point_of(grid_with("none"), world.frames, world.library);
  const trade::Evaluation found =
      trade::evaluate(world.frames, {&point, 1}, truth, Task::intersect).front();
  EXPECT_EQ(found.errors.false_positives + found.errors.far + found.errors.contacts,
            found.counters.pairs);
  EXPECT_GT(found.errors.false_positives, 50);
  EXPECT_EQ(found.counters.queries, 0);
  EXPECT_EQ(found.counters.shapes_bound, 0);
}

TEST(TradePipeline, NothingIsDoneThatTheSceneDoesNotNeed) {
  World balls(spheres);
  const auto truth = balls.truth();
  const trade::TradePoint point =
      point_of(grid_with("closed-form+gjk"), balls.frames, balls.library);
  EXPECT_EQ(trade::chain_name(point.configuration.narrow), "closed-form");
  const trade::Evaluation found =
      trade::evaluate(balls.frames, {&point, 1}, truth, Task::intersect).front();
  EXPECT_EQ(found.counters.hulls_built, 0);
  EXPECT_EQ(found.counters.shapes_bound, static_cast<std::int64_t>(point.stand_ins->shapes.size()));
  EXPECT_GT(found.counters.updates, 0);
  EXPECT_GT(found.counters.queries, 100);
  EXPECT_EQ(found.counters.witnesses, 0);

  World asked(spheres, Task::distance);
  EXPECT_GT(asked.errors_of(grid_with("closed-form+gjk"), truth).counters.witnesses, 0);

  World resting(still);
  EXPECT_TRUE(resting.frames.is_static());
  const trade::Evaluation at_rest = resting.errors_of(grid_with("gjk"), resting.truth());
  EXPECT_EQ(at_rest.counters.updates, 0);
  EXPECT_EQ(at_rest.counters.builds, 1);
}

TEST(TradePipeline, WhatRestsIsSettledOnceAndFatBoxesAreKept) {
  World world(mixed + "moving = 0.3\nspeed = 0.2\nspin = 0.1\n");
  trade::TradeGrid grid = grid_with("gjk", "dynamic-bvh");
  grid.boxes = {{trade::BoxChoice::Kind::fat, 0.2}};
  const trade::TradePoint fat = point_of(grid, world.frames, world.library);
  Executor executor(1);
  trade::FramePipeline pipeline(world.frames, *fat.stand_ins, fat.configuration, Task::intersect,
                                executor);
  pipeline.start(0);
  const std::int64_t first = pipeline.counters().pairs;
  EXPECT_EQ(pipeline.counters().settled, 0);
  std::size_t moved = 0;
  while (pipeline.frame() + 1 < world.frames.frames.size()) {
    pipeline.advance();
    for (const trade::PairAnswer& answer : pipeline.answers()) {
      const bool moves =
          world.frames.moves[answer.pair.a] != 0 || world.frames.moves[answer.pair.b] != 0;
      EXPECT_TRUE(moves);
      ++moved;
    }
  }
  EXPECT_GT(moved, 50u);
  EXPECT_GT(pipeline.counters().settled, 50);
  EXPECT_LT(pipeline.counters().pairs,
            first * static_cast<std::int64_t>(world.frames.frames.size()));
  // In some update no box is new, so no pairs are searched.
  EXPECT_LT(pipeline.counters().searches, static_cast<std::int64_t>(world.frames.frames.size()));
  EXPECT_EQ(pipeline.counters().builds, 1);
}

// A box and its eight octants are equal sets of points.
TEST(TradePipeline, PartsAnswerAsTheWhole) {
  for (const Task task : {Task::intersect, Task::distance}) {
    World world(boxes_alone, task);
    trade::TradeGrid whole = grid_with("certified");
    trade::TradeGrid octants = whole;
    octants.representations = {all_as(proxies::Form::dop26)};
    Executor executor(1);
    const trade::TradePoint one = point_of(whole, world.frames, world.library, task);
    const trade::TradePoint eight = point_of(octants, world.frames, world.library, task);
    EXPECT_FALSE(eight.stand_ins->single);
    trade::FramePipeline a(world.frames, *one.stand_ins, one.configuration, task, executor);
    trade::FramePipeline b(world.frames, *eight.stand_ins, eight.configuration, task, executor);
    std::map<std::pair<std::uint32_t, std::uint32_t>, trade::PairAnswer> expected;
    a.start(0);
    b.start(0);
    a.advance();
    b.advance();
    for (const trade::PairAnswer& answer : a.answers()) {
      expected[{answer.pair.a, answer.pair.b}] = answer;
    }
    std::size_t contacts = 0, apart = 0;
    for (const trade::PairAnswer& answer : b.answers()) {
      const auto of_whole = expected.find({answer.pair.a, answer.pair.b});
      if (of_whole == expected.end()) continue;  // a pair of boxes that rounding enlarged
      ASSERT_EQ(grade::is_contact(answer.answer), grade::is_contact(of_whole->second.answer));
      ++(grade::is_contact(answer.answer) ? contacts : apart);
      if (task == Task::distance && !grade::is_contact(answer.answer)) {
        EXPECT_NEAR(answer.distance, of_whole->second.distance, 1e-12);
      }
    }
    EXPECT_GT(contacts, 30u);
    EXPECT_GT(apart, 30u);
  }
}

// A configuration that crashes has a row of its own, and the others are complete.
TEST(TradePipeline, WhatThrowsCostsItselfAlone) {
  World world(boxes_alone);
  const auto truth = world.truth();
  NarrowPhaseEntry broken = *registry::find<NarrowPhaseEntry>("gjk");
  broken.make = [](const NarrowPhaseSettings&) -> std::unique_ptr<NarrowPhase> {
    throw std::runtime_error("broken on purpose");
  };
  std::vector<trade::TradePoint> points(3, point_of(grid_with("gjk"), world.frames, world.library));
  points[1].configuration.narrow = {&broken};
  const auto found = trade::evaluate(world.frames, points, truth, Task::intersect);
  EXPECT_TRUE(found[0].ok());
  EXPECT_EQ(to_string(found[1].state), "threw");
  EXPECT_THAT(found[1].words, testing::HasSubstr("broken on purpose"));
  EXPECT_EQ(found[2].errors.near, found[0].errors.near);
}

}  // namespace
}  // namespace touchstone
