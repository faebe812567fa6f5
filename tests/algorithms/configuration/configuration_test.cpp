// Tests configuration queries of every origin on small robots: against the oracle's answer for every pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::Random;

std::unique_ptr<ConcavePhase> concave(const char* name) {
  ConcaveSettings settings;
  settings.mid_phase = registry::find<MidPhaseEntry>("wide-bvh")->make;
  settings.narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); };
  return registry::find<ConcaveEntry>(name)->make(settings);
}

std::unique_ptr<ConfigurationQuery> query_of(const ConfigurationEntry& entry) {
  const bool is_exact = entry.info.origin == Origin::oracle;
  return entry.make(
      {.narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); },
       .concave_phase = [is_exact] { return concave(is_exact ? "exact" : "fused"); }});
}

// All but the oracle that offer the task.
std::vector<const ConfigurationEntry*> asked(ConfigurationTask task) {
  std::vector<const ConfigurationEntry*> all;
  for (const ConfigurationEntry& entry : registry::entries<ConfigurationEntry>()) {
    if (!is_built(entry.info) || entry.info.origin == Origin::oracle) continue;
    if (std::ranges::count(entry.tasks, task) > 0) all.push_back(&entry);
  }
  return all;
}

const ConfigurationEntry& exact() { return *registry::find<ConfigurationEntry>("exact"); }

ConcaveBody ball(double radius) {
  Shape shape;
  shape.radius = radius;
  return {nullptr, {{shape, {}, 0}}};
}

ConcaveBody box(const Vec3d& half) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = half;
  return {nullptr, {{shape, {}, 0}}};
}

Pose at(double x, double y, double z) { return {Mat3d::Identity(), Vec3d(x, y, z)}; }

// A ball that is a link, and another one in the world at the origin; both have the radius 1.
ConfigurationModel two_balls() {
  ConfigurationModel model;
  model.links = 1;
  model.parts = {{ball(1), 0, {}}, {ball(1), ModelPart::world, {}}};
  model.pairs = {{0, 1}};
  return model;
}

ConfigurationAnswer ask(const ConfigurationEntry& entry, const ConfigurationModel& model,
                        ConfigurationTask task, const std::vector<Pose>& poses) {
  const auto query = query_of(entry);
  query->bind(model);
  ConfigurationAnswer answer;
  const auto steps = static_cast<std::uint32_t>(poses.size() / model.links);
  query->solve(task, {poses, model.links, steps}, {&answer, 1});
  return answer;
}

TEST(Configurations, ATouchIsAContact) {
  const ConfigurationModel model = two_balls();
  for (const ConfigurationEntry& entry : registry::entries<ConfigurationEntry>()) {
    if (!is_built(entry.info)) continue;
    const auto answer_at = [&](double x) {
      return ask(entry, model, ConfigurationTask::free, {at(x, 0, 0)}).answer;
    };
    EXPECT_EQ(answer_at(1.5), Answer::overlapping) << entry.info.name;
    EXPECT_EQ(answer_at(2.5), Answer::separated) << entry.info.name;
    if (entry.approximate) continue;
    EXPECT_EQ(answer_at(2), Answer::overlapping) << entry.info.name;
    EXPECT_EQ(answer_at(std::nextafter(2, 3)), Answer::separated) << entry.info.name;
  }
}

TEST(Configurations, OnlyPairsThatAreAskedCount) {
  ConfigurationModel model = two_balls();
  model.pairs.clear();
  for (const ConfigurationEntry* entry : asked(ConfigurationTask::free)) {
    EXPECT_EQ(ask(*entry, model, ConfigurationTask::free, {at(0, 0, 0)}).answer, Answer::separated)
        << entry->info.name;
  }
  for (const ConfigurationEntry* entry : asked(ConfigurationTask::distance)) {
    const auto far = ask(*entry, model, ConfigurationTask::distance, {at(0, 0, 0)});
    EXPECT_EQ(far.answer, Answer::separated) << entry->info.name;
    EXPECT_EQ(far.distance, std::numeric_limits<double>::infinity()) << entry->info.name;
  }
}

TEST(Configurations, TheFirstStepInContactIsNamed) {
  const ConfigurationModel model = two_balls();
  const std::vector<Pose> through = {at(4, 0, 0), at(3, 0, 0), at(1, 0, 0), at(0, 0, 0)};
  const std::vector<Pose> past = {at(4, 3, 0), at(0, 3, 0), at(-4, 3, 0)};
  for (const ConfigurationEntry* entry : asked(ConfigurationTask::motion)) {
    const auto hit = ask(*entry, model, ConfigurationTask::motion, through);
    EXPECT_EQ(hit.answer, Answer::overlapping) << entry->info.name;
    EXPECT_EQ(hit.step, 2U) << entry->info.name;
    EXPECT_EQ(hit.pair, (IndexPair{0, 1})) << entry->info.name;
    const auto miss = ask(*entry, model, ConfigurationTask::motion, past);
    EXPECT_EQ(miss.answer, Answer::separated) << entry->info.name;
    EXPECT_EQ(miss.step, ConfigurationAnswer::none) << entry->info.name;
  }
}

// More steps than are asked at once.
TEST(Configurations, LongMotionsNameTheFirstStepToo) {
  const ConfigurationModel model = two_balls();
  for (const std::uint32_t first : {0U, 15U, 16U, 37U, 40U}) {
    std::vector<Pose> poses;
    for (std::uint32_t step = 0; step < 40; ++step) {
      poses.push_back(at(step < first ? 3 : 1, 0, step == first + 1 ? 9 : 0));
    }
    for (const ConfigurationEntry* entry : asked(ConfigurationTask::motion)) {
      const auto hit = ask(*entry, model, ConfigurationTask::motion, poses);
      EXPECT_EQ(hit.step, first < 40 ? first : ConfigurationAnswer::none) << entry->info.name;
    }
  }
}

// Balls apart or not by about what floats are rounded, in directions in which centres are rounded.
TEST(Configurations, FloatsDecideNoBallsThatAreNearContact) {
  const ConfigurationModel model = two_balls();
  Random random(3);
  std::vector<Pose> poses;
  std::vector<Answer> right;
  int contacts = 0, frees = 0;
  for (int i = 0; i < drawn(512, 32); ++i) {
    const double off = std::ldexp(random.uniform(-1, 1), -16 - i % 16);
    poses.push_back({random.rotation(), (2 + off) * random.direction()});
    right.push_back(ask(exact(), model, ConfigurationTask::free, {poses.back()}).answer);
    ++(right.back() == Answer::overlapping ? contacts : frees);
  }
  EXPECT_GT(contacts, 5);
  EXPECT_GT(frees, 5);
  for (const ConfigurationEntry* entry : asked(ConfigurationTask::free)) {
    if (entry->info.origin != Origin::ours) continue;
    const auto query = query_of(*entry);
    query->bind(model);
    std::vector<ConfigurationAnswer> answers(poses.size());
    query->solve(ConfigurationTask::free, {poses, 1, 1}, answers);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      EXPECT_EQ(answers[i].answer, right[i]) << entry->info.name << " " << i;
    }
  }
}

TEST(Configurations, PartsWithoutPointsAndHalfSpacesAreTaken) {
  ConfigurationModel model = two_balls();
  Shape ground;
  ground.kind = ShapeKind::halfspace;
  model.parts[1].body = {nullptr, {{ground, {}, 0}}};
  model.parts.push_back({ConcaveBody{}, 0, {}});
  model.parts.push_back({ball(1), ModelPart::world, at(0, 0, 50)});
  model.pairs = {{0, 1}, {0, 3}, {1, 2}, {2, 3}};
  for (const ConfigurationEntry* entry : asked(ConfigurationTask::free)) {
    if (entry->info.origin != Origin::ours) continue;
    const auto high = ask(*entry, model, ConfigurationTask::free, {at(0, 0, 1.25)});
    EXPECT_EQ(high.answer, Answer::separated) << entry->info.name;
    const auto low = ask(*entry, model, ConfigurationTask::free, {at(0, 0, 0.75)});
    EXPECT_EQ(low.answer, Answer::overlapping) << entry->info.name;
    if (std::ranges::count(entry->tasks, ConfigurationTask::distance) == 0) continue;
    const auto far = ask(*entry, model, ConfigurationTask::distance, {at(0, 0, 3)});
    EXPECT_NEAR(far.distance, 2, 1e-12) << entry->info.name;
  }
}

// A matrix of a file may be off by a thousandth, and is taken as it stands: this one makes all longer by 4e-4.
TEST(Configurations, MatricesThatAreOffAreTakenAsTheyStand) {
  ConfigurationModel model = two_balls();
  model.parts[0].body = box({10, 10, 10});
  const Pose longer = {1.0004 * Mat3d::Identity(), Vec3d::Zero()};
  for (const bool of_part : {false, true}) {
    model.parts[0].pose = of_part ? longer : Pose{};
    const std::vector<Pose> poses = {of_part ? Pose{} : longer};
    for (const double x : {10.998, 11.003, 11.005}) {
      model.parts[1].pose = at(x, 0, 0);
      const auto right = ask(exact(), model, ConfigurationTask::free, poses).answer;
      EXPECT_EQ(right, x < 11.004 ? Answer::overlapping : Answer::separated);
      for (const ConfigurationEntry* entry : asked(ConfigurationTask::free)) {
        if (entry->info.origin != Origin::ours) continue;
        EXPECT_EQ(ask(*entry, model, ConfigurationTask::free, poses).answer, right)
            << entry->info.name << " at " << x;
      }
    }
  }
}

// The pair that was in contact last is not one of the next model.
TEST(Configurations, AModelLeavesNothingToASmallerOne) {
  ConfigurationModel large = two_balls();
  large.parts.insert(large.parts.begin() + 1, 1000, {ball(0.5), ModelPart::world, at(0, 0, 90)});
  const auto last = static_cast<std::uint32_t>(large.parts.size() - 1);
  large.pairs = {{0, last}};
  const ConfigurationModel small = two_balls();
  for (const ConfigurationEntry* entry : asked(ConfigurationTask::free)) {
    const auto query = query_of(*entry);
    const auto answer_of = [&](const ConfigurationModel& model, double x) {
      const Pose pose = at(x, 0, 0);
      ConfigurationAnswer answer;
      query->bind(model);
      query->solve(ConfigurationTask::free, {{&pose, 1}, 1, 1}, {&answer, 1});
      return answer;
    };
    EXPECT_EQ(answer_of(large, 1).pair, (IndexPair{0, last})) << entry->info.name;
    EXPECT_EQ(answer_of(small, 3).answer, Answer::separated) << entry->info.name;
    EXPECT_EQ(answer_of(small, 1).pair, (IndexPair{0, 1})) << entry->info.name;
  }
}

// A link is a half-space below -5 and a ball, and meets the world by either; and so is a compound of both.
TEST(Configurations, AHalfSpaceMovesWithALink) {
  Shape below;
  below.kind = ShapeKind::halfspace;
  below.offset = -5;
  for (const bool in_one : {false, true}) {
    ConfigurationModel model = two_balls();
    if (in_one) {
      model.parts[0].body.parts.push_back({below, {}, 0});
    } else {
      model.parts.push_back({{nullptr, {{below, {}, 0}}}, 0, {}});
      model.pairs = {{0, 1}, {1, 2}};
    }
    for (const ConfigurationEntry& entry : registry::entries<ConfigurationEntry>()) {
      if (!is_built(entry.info) || entry.approximate) continue;
      const auto answer_at = [&](double z) {
        return ask(entry, model, ConfigurationTask::free, {at(0, 0, z)}).answer;
      };
      EXPECT_EQ(answer_at(3), Answer::separated) << entry.info.name << in_one;
      EXPECT_EQ(answer_at(1), Answer::overlapping) << entry.info.name << in_one;
      EXPECT_EQ(answer_at(5), Answer::overlapping) << entry.info.name << in_one;
    }
  }
}

// Squares of such lengths overflow or underflow, in floats or in doubles.
TEST(Configurations, NoLengthIsTooLongOrTooShort) {
  for (const double size : {1e-170, 1e-40, 1e-21, 1e-14, 1e14, 1e17, 1e25, 1e50, 1e170}) {
    ConfigurationModel model = two_balls();
    model.parts[0].body = model.parts[1].body = ball(size);
    for (const ConfigurationEntry* entry : asked(ConfigurationTask::free)) {
      if (entry->info.origin != Origin::ours) continue;
      const auto answer_at = [&](double x) {
        return ask(*entry, model, ConfigurationTask::free, {at(x * size, 0, 0)}).answer;
      };
      EXPECT_EQ(answer_at(1.5), Answer::overlapping) << entry->info.name << " " << size;
      EXPECT_EQ(answer_at(2.5), Answer::separated) << entry->info.name << " " << size;
    }
  }
}

// Peers of convex shapes and meshes know no placed part, and FCL no distance to a half-space.
TEST(Configurations, PeersRefuseWhatTheyDoNotHave) {
  ConfigurationModel placed = two_balls();
  placed.parts[0].body.parts[0].pose = at(5, 0, 0);
  ConfigurationModel ground = two_balls();
  Shape below;
  below.kind = ShapeKind::halfspace;
  ground.parts[1].body = {nullptr, {{below, {}, 0}}};
  for (const ConfigurationEntry& entry : registry::entries<ConfigurationEntry>()) {
    if (entry.info.origin != Origin::peer) continue;
    EXPECT_TRUE(entry.supports(two_balls())) << entry.info.name;
    EXPECT_FALSE(entry.supports(placed)) << entry.info.name;
    if (!is_built(entry.info) || !entry.supports(ground)) continue;
    const auto far = ask(entry, ground, ConfigurationTask::distance, {at(0, 0, 3)});
    EXPECT_EQ(far.answer, Answer::unknown) << entry.info.name;
    EXPECT_EQ(far.status, Status::unsupported) << entry.info.name;
  }
}

// Links of balls, boxes and meshes in a row, each turned against the one before, among boxes.
ConfigurationModel some_robot(Random& random, bool meshes) {
  ConfigurationModel model;
  model.links = 5;
  for (std::uint32_t link = 0; link < model.links; ++link) {
    for (int i = 0; i < 3; ++i) {
      ModelPart part = {ball(random.uniform(0.1, 0.3)), link, at(0, 0, 0.25 * i)};
      if (i == 1) {
        part.body = box({0.1, random.uniform(0.1, 0.2), 0.2});
        part.pose.rotation = random.rotation();
      }
      if (i == 2 && meshes) {
        part.body = {std::make_shared<const TriangleMesh>(
                         families::moved(families::torus(6, 4, 0.75, 0.25), 0.25, {0, 0, 0})),
                     {}};
      }
      model.parts.push_back(part);
    }
  }
  for (int i = 0; i < 4; ++i) {
    model.parts.push_back(
        {box({0.4, 0.2, 0.3}), ModelPart::world, {random.rotation(), 2 * random.direction()}});
  }
  for (std::uint32_t a = 0; a < model.parts.size(); ++a) {
    for (std::uint32_t b = a + 1; b < model.parts.size(); ++b) {
      const std::uint32_t first = model.parts[a].link, second = model.parts[b].link;
      if (first != ModelPart::world && second >= first + 2) model.pairs.push_back({a, b});
    }
  }
  return model;
}

void add_configuration(Random& random, std::uint32_t links, std::vector<Pose>& poses) {
  Pose before;
  for (std::uint32_t link = 0; link < links; ++link) {
    const Mat3d turn =
        Eigen::AngleAxisd(random.uniform(-1, 1), random.direction()).toRotationMatrix();
    before = placed_within(before, {turn, Vec3d(0, 0, 0.6)});
    poses.push_back(before);
  }
}

TEST(Configurations, AgreeWithEveryPairByItself) {
  Random random(1);
  for (const bool meshes : {false, true}) {
    int contacts = 0, frees = 0;
    for (int robots = 0; robots < (meshes ? 4 : 10); ++robots) {
      const ConfigurationModel model = some_robot(random, meshes);
      constexpr std::size_t count = 24;
      std::vector<Pose> poses;
      for (std::size_t i = 0; i < count; ++i) add_configuration(random, model.links, poses);
      for (const ConfigurationTask task :
           {ConfigurationTask::free, ConfigurationTask::distance, ConfigurationTask::motion}) {
        const std::uint32_t steps = task == ConfigurationTask::motion ? 3 : 1;
        const Configurations all = {poses, model.links, steps};
        const auto answers_of = [&](const ConfigurationEntry& entry) {
          std::vector<ConfigurationAnswer> answers(all.answers());
          const auto query = query_of(entry);
          query->bind(two_balls());  // a model that was bound before leaves nothing behind
          query->bind(model);
          query->solve(task, all, answers);
          return answers;
        };
        const auto right = answers_of(exact());
        for (const ConfigurationEntry* entry : asked(task)) {
          if (meshes && entry->info.name == "mujoco-world") continue;  // hulls in place of meshes
          const auto answers = answers_of(*entry);
          for (std::size_t i = 0; i < answers.size(); ++i) {
            SCOPED_TRACE(entry->info.name + " " + std::string(to_string(task)));
            EXPECT_EQ(answers[i].answer, right[i].answer);
            EXPECT_EQ(answers[i].step, right[i].step);
            if (task == ConfigurationTask::distance) {
              EXPECT_NEAR(answers[i].distance, right[i].distance,
                          entry->approximate ? 1e-4 : 1e-11);
            }
            if (entry->approximate || answers[i].answer != Answer::overlapping) continue;
            EXPECT_TRUE(std::ranges::binary_search(model.pairs, answers[i].pair));
          }
        }
        if (task != ConfigurationTask::free) continue;
        for (const ConfigurationAnswer& answer : right) {
          ++(answer.answer == Answer::overlapping ? contacts : frees);
        }
      }
    }
    EXPECT_GT(contacts, 5);
    EXPECT_GT(frees, 5);
  }
}

// A base that stands on a table, or beside it, and a hand, each at one of three places: often where they were before,
// or before that. One query answers all configurations as the exact one does.
TEST(Configurations, WhatIsKnownOfPairsHoldsUntilTheyMove) {
  ConfigurationModel model;
  model.links = 2;
  model.parts = {{box({1, 1, 0.5}), 0, {}},
                 {box({0.2, 0.3, 0.4}), 1, {}},
                 {box({2, 2, 0.25}), ModelPart::world, at(0, 0, -0.25)},
                 {{std::make_shared<const TriangleMesh>(TriangleMesh{
                       {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}}),
                   {}},
                  ModelPart::world,
                  at(0, 0, -0.001)}};
  const std::vector<Pose> bases = {at(0, 0, 0.5), at(0, 0, std::nextafter(0.5, 1)), at(9, 0, 0.2)},
                          hands = {at(0, 0, 1.4), at(0, 0, 1.5), at(1.2, 0, 0.4)};
  for (const auto& pairs :
       {std::vector<IndexPair>{{0, 1}, {0, 2}, {0, 3}, {1, 2}},
        std::vector<IndexPair>{{0, 1}, {0, 3}, {1, 2}}, std::vector<IndexPair>{{0, 1}, {1, 2}}}) {
    model.pairs = pairs;
    Random random(7);
    std::vector<Pose> poses;
    const std::size_t count = 400;
    for (std::size_t i = 0; i < count; ++i) {
      for (const auto* of : {&bases, &hands}) {
        const std::size_t before = poses.size() - 2;
        const bool stays = i > 0 && random.below(2) == 0;
        const Pose place = stays ? poses[before] : (*of)[static_cast<std::size_t>(random.below(3))];
        poses.push_back(place);
      }
    }
    for (const ConfigurationTask task : {ConfigurationTask::free, ConfigurationTask::distance}) {
      std::vector<ConfigurationAnswer> right(count);
      const auto every_pair = query_of(exact());
      every_pair->bind(model);
      every_pair->solve(task, {poses, 2, 1}, right);
      int contacts = 0;
      for (const auto& answer : right) contacts += answer.answer == Answer::overlapping ? 1 : 0;
      EXPECT_GT(contacts, 20);
      EXPECT_LT(contacts, 380);
      for (const ConfigurationEntry* entry : asked(task)) {
        if (entry->approximate) continue;
        std::vector<ConfigurationAnswer> answers(count);
        const auto query = query_of(*entry);
        query->bind(model);
        query->solve(task, {poses, 2, 1}, answers);
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(answers[i].answer, right[i].answer) << entry->info.name << " " << i;
          if (task == ConfigurationTask::distance && right[i].answer == Answer::separated) {
            ASSERT_NEAR(answers[i].distance, right[i].distance, 1e-12) << i;
          }
        }
      }
    }
  }
}

// A half-space below the robot, which reaches it now and then.
TEST(Configurations, AGroundIsMetByWhatReachesIt) {
  Random random(2);
  int contacts = 0, frees = 0;
  for (int robots = 0; robots < drawn(8, 1); ++robots) {
    ConfigurationModel model = some_robot(random, robots % 2 == 0);
    Shape ground;
    ground.kind = ShapeKind::halfspace;
    ground.normal = 2 * random.direction();
    ground.offset = -2.5;
    const auto number = static_cast<std::uint32_t>(model.parts.size());
    model.parts.push_back(
        {{nullptr, {{ground, {}, 0}}}, ModelPart::world, {random.rotation(), random.vector(0.1)}});
    for (std::uint32_t part = 0; part < number; ++part) {
      if (model.parts[part].link != ModelPart::world) model.pairs.push_back({part, number});
    }
    std::ranges::sort(model.pairs);
    constexpr std::size_t count = 32;
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < count; ++i) add_configuration(random, model.links, poses);
    for (const ConfigurationTask task : {ConfigurationTask::free, ConfigurationTask::distance}) {
      std::vector<ConfigurationAnswer> right(count), answers(count);
      const Configurations all = {poses, model.links, 1};
      const auto truth = query_of(exact());
      truth->bind(model);
      truth->solve(task, all, right);
      for (const ConfigurationEntry* entry : asked(task)) {
        if (entry->info.origin != Origin::ours) continue;
        const auto query = query_of(*entry);
        query->bind(model);
        query->solve(task, all, answers);
        for (std::size_t i = 0; i < count; ++i) {
          EXPECT_EQ(answers[i].answer, right[i].answer) << entry->info.name << " " << i;
          if (task == ConfigurationTask::free) {
            ++(right[i].answer == Answer::overlapping ? contacts : frees);
          } else {
            EXPECT_NEAR(answers[i].distance, right[i].distance, 1e-11) << entry->info.name;
          }
        }
      }
    }
  }
  EXPECT_GT(contacts, 5);
  EXPECT_GT(frees, 5);
}

}  // namespace
}  // namespace touchstone
