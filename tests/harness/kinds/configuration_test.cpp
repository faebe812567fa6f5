// Tests the kind of configurations: what is right, models of scenes, and drawn robots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "harness/kinds/configuration/configuration_grade.h"
#include "harness/kinds/configuration/configuration_kind.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/kind.h"
#include "tests/algorithms/one_in.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using kinds::Grade;

ConfigurationAnswer answer_of(Answer answer, double distance = Outcome::none) {
  return {.answer = answer, .status = Status::ok, .pair = {0, 1}, .distance = distance};
}

TEST(ConfigurationGrades, AreOfTheSideOfContactThePairAndTheDistance) {
  const auto grade = [](ConfigurationTask task, const ConfigurationAnswer& said,
                        const ConfigurationAnswer& is, bool names_contact = true) {
    return kinds::grade_configuration(task, said, is, names_contact, 10).grade;
  };
  const auto free = answer_of(Answer::separated), contact = answer_of(Answer::overlapping);
  EXPECT_EQ(grade(ConfigurationTask::free, free, free), Grade::right);
  EXPECT_EQ(grade(ConfigurationTask::free, contact, contact), Grade::right);
  EXPECT_EQ(grade(ConfigurationTask::free, free, contact), Grade::missed);
  EXPECT_EQ(grade(ConfigurationTask::free, contact, free), Grade::false_hit);
  EXPECT_EQ(grade(ConfigurationTask::free, contact, contact, false), Grade::inexact);
  EXPECT_EQ(grade(ConfigurationTask::free, answer_of(Answer::unknown), free), Grade::gave_up);
  EXPECT_EQ(grade(ConfigurationTask::free, free, answer_of(Answer::unknown)), Grade::unresolved);

  const auto distance = [&](double said, double is) {
    return grade(ConfigurationTask::distance, answer_of(Answer::separated, said),
                 answer_of(Answer::separated, is));
  };
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(distance(1 + 9e-11, 1), Grade::right);
  EXPECT_EQ(distance(1 + 2e-10, 1), Grade::inexact);
  EXPECT_EQ(distance(infinite, infinite), Grade::right);
  EXPECT_EQ(distance(1, infinite), Grade::inexact);
  EXPECT_EQ(distance(Outcome::none, 1), Grade::inexact);

  ConfigurationAnswer first = contact, later = contact;
  first.step = 2;
  later.step = 3;
  EXPECT_EQ(grade(ConfigurationTask::motion, first, first), Grade::right);
  EXPECT_EQ(grade(ConfigurationTask::motion, later, first), Grade::missed);
  EXPECT_EQ(grade(ConfigurationTask::motion, first, later), Grade::false_hit);
}

// Two shapes of one name on tracks that go together are a link; the third body is the world.
TEST(SceneConfigurations, ShapesOfOneNameThatKeepTogetherAreALink) {
  const TemporaryFolder folder;
  folder.write("log.csv",
               "frame,body,x,y,z,qw,qx,qy,qz\n0,0,0,0,0,1,0,0,0\n0,1,0,0,1,1,0,0,0\n"
               "1,0,0,0,5,0.6,0.8,0,0\n1,1,0,-0.96,4.72,0.6,0.8,0,0\n");
  const std::string ball = "shape = {type = \"sphere\", radius = 0.25}\n";
  const std::string text =
      "poses = \"log.csv\"\nignore = [[\"arm\", \"arm\"]]\n[[body]]\nname = \"arm\"\n" + ball +
      "[[body]]\nname = \"arm\"\n" + ball +
      "[[body]]\nname = \"table\"\nmoving = false\ntranslation = [0, 0, 1.5]\n" + ball;
  const auto file = folder.write("scene.toml", text);
  const kinds::SceneConfigurations made =
      kinds::scene_configurations(scene::load_scene(file), "scene.toml");
  EXPECT_EQ(made.model.links, 1U);
  ASSERT_EQ(made.model.parts.size(), 3U);
  EXPECT_EQ(made.model.parts[1].link, 0U);
  EXPECT_EQ(made.model.parts[1].pose.translation, Vec3d(0, 0, 1));
  EXPECT_EQ(made.model.parts[2].link, ModelPart::world);
  EXPECT_EQ(made.model.pairs, (std::vector<IndexPair>{{0, 2}, {1, 2}}));
  EXPECT_EQ(made.names[2], "table");
  ASSERT_EQ(made.poses.size(), 2U);
  kinds::ConfigurationTruth truth(made.model, kinds::PairAnswers::exact);
  const std::span<const Pose> poses = made.poses;
  EXPECT_EQ(truth.answer(ConfigurationTask::free, poses.first(1), 1).answer, Answer::overlapping);
  EXPECT_EQ(truth.answer(ConfigurationTask::free, poses.last(1), 1).answer, Answer::separated);
  EXPECT_TRUE(truth.touches({1, 2}, poses.first(1)));
  EXPECT_FALSE(truth.touches({0, 2}, poses.first(1)));
  EXPECT_FALSE(truth.touches({0, 1}, poses.first(1))) << "a pair that is not asked";
  for (const Answer contact : {Answer::overlapping, Answer::touching}) {
    EXPECT_FALSE(truth.names_pair(answer_of(contact), poses.first(1)));
  }
  EXPECT_TRUE(truth.names_pair(answer_of(Answer::separated), poses.first(1)));
  ConfigurationAnswer far = truth.answer(ConfigurationTask::distance, poses.last(1), 1);
  EXPECT_EQ(far.pair, (IndexPair{1, 2}));
  EXPECT_TRUE(truth.names_pair(far, poses.last(1)));
  far.pair = {0, 2};
  EXPECT_FALSE(truth.names_pair(far, poses.last(1))) << "this one is farther";
}

TEST(SceneConfigurations, RefuseWhatHasNoRobot) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("scene.toml", "[[body]]\nshape = {type = \"sphere\", radius = 1}\n");
  EXPECT_THROW(kinds::scene_configurations(scene::load_scene(file), "scene.toml"),
               base::InputError);
}

// Near ones end within 1e-6 of contact, on either side of it.
TEST(DrawnRobots, TouchOftenAndEndNearContactWhereTheyAreToldTo) {
  const auto families = kinds::configuration_families();
  for (std::uint32_t number = 0; number < families.size(); ++number) {
    int contacts = 0, frees = 0, near = 0;
    const int count = drawn(30, 6);
    for (int i = 0; i < count; ++i) {
      families::RandomDraws draws(number, static_cast<std::uint64_t>(i));
      const ConfigurationModel robot = kinds::drawn_robot(number, draws);
      const kinds::DrawnMotion motion = kinds::drawn_motion(number, robot, draws);
      EXPECT_EQ(motion.poses.size(), std::size_t{robot.links} * kinds::DrawnMotion::steps);
      kinds::ConfigurationTruth truth(robot, kinds::PairAnswers::fast);
      const auto last = motion.last(robot.links);
      const bool touches =
          truth.answer(ConfigurationTask::free, last, 1).answer == Answer::overlapping;
      ++(touches ? contacts : frees);
      const auto far = truth.answer(ConfigurationTask::distance, last, 1);
      if (!touches && far.distance < 1e-6) ++near;
    }
    EXPECT_GT(contacts, 0) << families[number].name;
    EXPECT_GT(frees, 0) << families[number].name;
    if (families[number].name.ends_with("-near")) {
      EXPECT_GT(near, 0) << families[number].name;
    }
  }
}

// Rounded: the file has where the parts are, not their places in their links.
TEST(DrawnRobots, AreAskedAgainFromTheFilesOfACase) {
  const kinds::Kind& kind = kinds::configuration_kind();
  const auto contestants = kind.contestants({"world-tree"}, std::array{Precision::float64});
  const auto motion = static_cast<std::uint8_t>(ConfigurationTask::motion);
  const auto contestant = std::ranges::find(contestants, motion, &kinds::Contestant::task);
  ASSERT_NE(contestant, contestants.end());
  int contacts = 0, frees = 0;
  for (const kinds::Family& family : kind.families()) {
    if (family.name.ends_with("-near")) continue;
    const auto batch = kind.draw(family, {.seed = 3, .first = 0, .count = 6});
    for (std::size_t place = 0; place < 6; ++place) {
      SCOPED_TRACE(std::string(family.name) + " " + std::to_string(place));
      families::RandomDraws of_robot(base::mix(3) + family.number, ~0ULL);
      const ConfigurationModel robot = kinds::drawn_robot(family.number, of_robot);
      auto draws = kinds::draws_of(kind, family.number, 3, place);
      const kinds::DrawnMotion drawn = kinds::drawn_motion(family.number, robot, draws);
      const TemporaryFolder folder;
      const std::string command = batch->write(*contestant, place, folder.path() / "case");
      EXPECT_THAT(command, testing::HasSubstr("case.toml"));
      const auto file = folder.path() / "case.toml";
      const kinds::SceneConfigurations again =
          kinds::scene_configurations(scene::load_scene(file), file.string());
      EXPECT_EQ(again.model.parts.size(), robot.parts.size());
      EXPECT_EQ(again.model.pairs, robot.pairs);
      kinds::ConfigurationTruth before(robot, kinds::PairAnswers::fast),
          after(again.model, kinds::PairAnswers::fast);
      constexpr auto steps = kinds::DrawnMotion::steps;
      const auto is = before.answer(ConfigurationTask::motion, drawn.poses, steps),
                 was = after.answer(ConfigurationTask::motion, again.poses, steps);
      EXPECT_EQ(is.answer, was.answer);
      EXPECT_EQ(is.step, was.step);
      ++(is.answer == Answer::separated ? frees : contacts);
    }
  }
  EXPECT_GT(contacts, 0);
  EXPECT_GT(frees, 0);
}

}  // namespace
}  // namespace touchstone
