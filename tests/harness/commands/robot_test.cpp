// Tests of touchstone robot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/scene/robot/robot.h"
#include "tests/harness/commands/program.h"

namespace touchstone {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Balls of 0.1 m on a vertical rail, at 0, 1 and 2 m: the second slides from 0.85 to 1 m, so that it touches the first never,
// and the third one as low as 1.1 m is beyond its reach too. A fourth is a mesh that always meets the third.
class RobotCommand : public testing::Test {
 protected:
  RobotCommand() {
    const auto ball = [](const std::string& name) {
      return "<link name=\"" + name +
             "\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link>";
    };
    const auto slide = [](const std::string& child, double at, double low, double high) {
      return "<joint name=\"" + child +
             "_slide\" type=\"prismatic\"><parent link=\"rail\"/><child link=\"" + child +
             "\"/><origin xyz=\"0 0 " + std::to_string(at) +
             "\"/><axis xyz=\"0 0 1\"/><limit lower=\"" + std::to_string(low) + "\" upper=\"" +
             std::to_string(high) + "\"/></joint>";
    };
    folder_.write(
        "tip.obj",
        "v 0 0 0\nv 0.05 0 0\nv 0 0.05 0\nv 0 0 0.15\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    folder_.write("rail.urdf", "<robot name=\"rail\"><link name=\"rail\"/>" + ball("low") +
                                   ball("middle") + ball("high") +
                                   "<link name=\"tip\"><collision><geometry><mesh "
                                   "filename=\"tip.obj\"/></geometry></collision></link>" +
                                   slide("low", 0, 0, 0.1) + slide("middle", 1, -0.85, 0) +
                                   slide("high", 2, 0, 0.5) + slide("tip", 2, 0, 0) + "</robot>");
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
};

// The links hang on one that has no shape, which joins them all: another link between keeps them apart.
TEST_F(RobotCommand, LeavesOutLinksThatShareAnEmptyLink) {
  const Ran ran = run_program("robot " + path("rail.urdf") + " --random 20 --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("rail: 5 links, 4 shapes, 4 joints with a value; 0 bodies"));
  EXPECT_THAT(ran.text, HasSubstr("Not asked: 6 pairs of links that a joint joins"));
  EXPECT_THAT(ran.text, HasSubstr("Free: 20 of 20 configurations, 100 %: no pair is asked"));
  EXPECT_THAT(ran.text, Not(HasSubstr("Who says fastest"))) << "of nothing";
}

TEST_F(RobotCommand, CountsContactsAndWhatSrdfHides) {
  std::string urdf = folder_.read("rail.urdf");
  const std::string empty = "<link name=\"rail\"/>";
  urdf.replace(urdf.find(empty), empty.size(),
               "<link name=\"rail\"><collision><origin xyz=\"5 0 0\"/><geometry><sphere "
               "radius=\"0.1\"/></geometry></collision></link>");
  folder_.write("rail.urdf", urdf);
  folder_.write("rail.srdf",
                "<robot name=\"rail\"><disable_collisions link1=\"low\" link2=\"middle\"/>"
                "<disable_collisions link1=\"low\" link2=\"high\"/>"
                "<disable_collisions link1=\"low\" link2=\"camera\"/></robot>");
  folder_.write(
      "world.toml",
      "[[body]]\nname = \"plate\"\nshape = {type = \"box\", half_extents = [1, 1, 0.01]}\n"
      "translation = [0, 0, 2.4]\n[[body]]\nshape = {type = \"halfspace\", normal = [0, 0, 1], "
      "offset = -9}\n");
  const Ran ran = run_program("robot " + path("rail.urdf") + " --random 400 --scene " +
                              path("world.toml") + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("2 bodies around it"));
  EXPECT_THAT(ran.text, HasSubstr("Left out: what SRDF says of \"camera\""));
  EXPECT_THAT(ran.text,
              ContainsRegex("SRDF hides[^:]*:\nlinks +touch in *\n-+\nlow, middle +[1-9]"));
  EXPECT_THAT(ran.text, ContainsRegex("some configurations:\nlinks +touch in *\n-+\nhigh, tip "
                                      "+[1-9][^\n]*\nhigh, plate +[1-9]"));
  EXPECT_THAT(ran.text, HasSubstr("Each of them touches in less than 0.75 %"));
  EXPECT_THAT(ran.text, ContainsRegex("fixed-pairs +ours +[0-9.e+]+ +0 of 400"));
  EXPECT_THAT(folder_.read("out/pairs.csv"), ContainsRegex("low,high,yes,400,0,0\n"));
  EXPECT_THAT(folder_.read("out/pairs.csv"), ContainsRegex("high,tip,no,400,[1-9]"));
  const std::string proposal = folder_.read("out/proposed.srdf");
  EXPECT_THAT(proposal, HasSubstr("link1=\"low\" link2=\"high\" reason=\"Never\""));
  EXPECT_THAT(proposal, HasSubstr("link1=\"rail\" link2=\"low\" reason=\"Adjacent\""));
  EXPECT_THAT(proposal, Not(HasSubstr("plate")));
  EXPECT_THAT(proposal, Not(HasSubstr("link1=\"low\" link2=\"middle\"")));
  // What `run`, `advise` and `report` take.
  const scene::Scene scene = scene::load_scene(path("out/scene.toml"));
  EXPECT_EQ(scene.frames, 400);
  EXPECT_EQ(scene.bodies.size(), 7U);
  EXPECT_FALSE(scene.bodies[5].moving);
  const Ran twice = run_program("robot " + path("rail.urdf") + " --out " + path("out"));
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.text, HasSubstr("scene.toml is there; expected another --out, or --overwrite"));
  const scene::Robot again = scene::read_robot(path("rail.urdf"), path("out/proposed.srdf"));
  EXPECT_FALSE(again.disabled.empty());
  for (const char* file : {"scene.toml", "pairs.csv", "proposed.srdf", "configurations.toml"}) {
    std::filesystem::remove(path("out") + "/" + file);
  }
  const Ran timed = run_program("robot " + path("rail.urdf") + " --out " + path("out"));
  EXPECT_EQ(timed.status, 2);
  EXPECT_THAT(timed.text, HasSubstr("times is there; expected another --out, or --overwrite"));
}

TEST_F(RobotCommand, TakesRecordedConfigurations) {
  folder_.write("path.csv", "middle_slide\n0\n-0.85\n");
  std::string urdf = folder_.read("rail.urdf");
  urdf.replace(urdf.find("<link name=\"rail\"/>"), 19,
               "<link name=\"rail\"><collision><origin xyz=\"5 0 0\"/><geometry><sphere "
               "radius=\"0.1\"/></geometry></collision></link>");
  folder_.write("rail.urdf", urdf);
  const Ran ran = run_program("robot " + path("rail.urdf") + " --configurations " +
                              path("path.csv") + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("Free: 0 of 2"));
  EXPECT_THAT(ran.text,
              ContainsRegex("Always in contact[^:]*:[^\n]*\nlinks[^\n]*\n-+\nhigh, tip +2 +100 %"));
  EXPECT_THAT(ran.text, ContainsRegex("low, middle +1 +50 %"));
  EXPECT_THAT(ran.text, Not(HasSubstr("at 95 %"))) << "recorded ones are no sample";
  const std::string proposal = folder_.read("out/proposed.srdf");
  EXPECT_THAT(proposal, Not(HasSubstr("Never"))) << "they show nothing of others";
  EXPECT_THAT(proposal, HasSubstr("reason=\"Always\""));
}

// An obstacle may have the name of a link, and bodies without one are told apart.
TEST_F(RobotCommand, TellsLinksFromWhatIsAroundThem) {
  folder_.write("world.toml",
                "[[body]]\nname = \"low\"\nshape = {type = \"sphere\", radius = 0.1}\ntranslation "
                "= [0, 0, 0]\n"
                "[[body]]\nshape = {type = \"sphere\", radius = 0.1}\ntranslation = [0, 0, 9]\n"
                "[[body]]\nshape = {type = \"sphere\", radius = 0.1}\ntranslation = [0, 0, 0]\n");
  const Ran ran = run_program("robot " + path("rail.urdf") + " --random 3 --scene " +
                              path("world.toml") + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  const std::string pairs = folder_.read("out/pairs.csv");
  EXPECT_THAT(pairs, HasSubstr("low,low,no,3,3,0\n"));
  EXPECT_THAT(pairs, HasSubstr("low,body 5,no,3,0,0\n"));
  EXPECT_THAT(pairs, HasSubstr("low,body 6,no,3,3,0\n"));
  EXPECT_THAT(folder_.read("out/proposed.srdf"), Not(HasSubstr("Never")));
  expect_refusal("robot " + path("rail.urdf") + " --scene " + path("out/scene.toml") + " --out " +
                     path("out2"),
                 "bodies that stand still", folder_);
}

TEST_F(RobotCommand, RefusesWhatItCannotRead) {
  expect_refusal("robot " + path("none.urdf"), "none.urdf", folder_);
  folder_.write("bad.urdf", "<robot><link/></robot>");
  expect_refusal("robot " + path("bad.urdf") + " --out " + path("out"), "no attribute name",
                 folder_);
  expect_refusal("robot " + path("rail.urdf") + " --meshes wire", "wire", folder_);
  folder_.write("world.toml", "[[body]]\nshape = {type = \"sphere\", radius = 1}\n");
  expect_refusal("robot " + path("world.toml"), "world.toml: found the ending '.toml'", folder_);
  expect_refusal("robot " + path("rail.urdf") + " --scene " + path("rail.urdf"),
                 "rail.urdf: found the ending '.urdf'; expected a scene (.toml, .json)", folder_);
  expect_refusal("robot " + path("rail.urdf") + " --scene " + path("none.toml"), "none.toml",
                 folder_);
  expect_refusal("robot " + path("rail.urdf") + " --srdf " + path("none.srdf"), "none.srdf",
                 folder_);
}

}  // namespace
}  // namespace touchstone
