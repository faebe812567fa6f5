// Tests of touchstone scene describe and touchstone scene hash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/scene/scene.h"
#include "tests/harness/commands/program.h"

namespace touchstone {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class Describe : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  TemporaryFolder folder_;
};

TEST_F(Describe, SaysWhatAScenesBodiesAre) {
  folder_.write("s.toml",
                "frames = 3\n"
                "[[body]]\nshape = {type = \"box\", half_extents = [1, 1, 1]}\n"
                "velocity = [0.1, 0, 0]\n"
                "[[body]]\nshape = {type = \"box\", half_extents = [2, 1, 1]}\n"
                "translation = [0, 1, 0]\n"
                "[[body]]\nshape = {type = \"sphere\", radius = 0.25}\n"
                "translation = [9, 0, 0]\nmoving = false\n"
                "[[body]]\nshape = {type = \"sphere\", radius = 0.25}\n"
                "translation = [9, 9, 0]\nmoving = false\n");
  const Ran ran = run_program("scene describe " + path("s.toml"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("s: 4 bodies, 3 frames\n"));
  EXPECT_THAT(ran.text, ContainsRegex("box +2 +2 +2 +4 +4\n"));
  EXPECT_THAT(ran.text, ContainsRegex("sphere +2 +0 +0.5 +0.5 +0.5\n"));
  EXPECT_THAT(ran.text, ContainsRegex("all +4 +2 +0.5 +2 +4\n"));
  EXPECT_THAT(ran.text, HasSubstr("overlap in frame 0: 1, or 0.25 a body\n"));
  EXPECT_THAT(ran.text, HasSubstr("from a frame to the next: 25 % of all\n"));
  EXPECT_THAT(ran.text, HasSubstr("overlapped in the frame before too: 100 %\n"));
  EXPECT_THAT(ran.text, HasSubstr("Of 2 pairs of convex bodies whose boxes overlap, in 2 frames:"));
  EXPECT_THAT(ran.text, ContainsRegex("resting +sliding +free\n-+\n0 % +100 % +0 %\n"));
  EXPECT_THAT(ran.text, ContainsRegex("deeper than 10 % +100 %\n"));
  expect_refusal("scene describe " + path("none.toml"), "none.toml", folder_);
}

TEST_F(Describe, PrintsTheHashOfAScene) {
  folder_.write("s.toml", "generator = \"uniform\"\ncount = 30\nframes = 4\n");
  const Ran ran = run_program("scene hash " + path("s.toml"));
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.text, scene::scene_hash(scene::load_scene(path("s.toml"))) + "\n");
  EXPECT_NE(run_program("scene hash --seed 9 " + path("s.toml")).text, ran.text);
  EXPECT_NE(run_program("scene hash --frames 3 " + path("s.toml")).text, ran.text);
  expect_refusal("scene hash", "scene is required", folder_);
}

}  // namespace
}  // namespace touchstone
