// Tests of what pairs of bodies do in a scene.
#include "harness/report/pair_mix.h"

#include <gtest/gtest.h>

#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

report::PairMix mix_of(const std::string& text) {
  const TemporaryFolder folder;
  return report::pair_mix(scene::load_scene(folder.write("s.toml", text)));
}

const std::string cube = "[[body]]\nshape = {type = \"box\", half_extents = [0.5, 0.5, 0.5]}\n";

TEST(PairMix, TellsRestingFromSlidingAndFree) {
  const std::string text =
      "frames = 5\n[[body]]\nshape = {type = \"halfspace\", normal = [0, 0, 1], offset = 0}\n" +
      cube + "translation = [0, 0, 0.5]\nmoving = false\n" + cube +
      "translation = [0, 0, 1.5]\nvelocity = [0.3, 0, 0]\n" +  // on the first one, and slides
      "[[body]]\nshape = {type = \"sphere\", radius = 0.5}\ntranslation = [9, 0, 0.52]\nmoving = "
      "false\n[[body]]\nshape = {type = \"sphere\", radius = 0.5}\ntranslation = [9.9, 0.9, "
      "0.5]\nmoving = false\n";
  const report::PairMix mix = mix_of(text);
  EXPECT_EQ(mix.frames, 4u);
  EXPECT_EQ(mix.resting, 4u * 2) << "a cube and a ball on the ground";
  EXPECT_EQ(mix.sliding, 4u);
  EXPECT_EQ(mix.apart, 4u) << "two balls whose boxes overlap";
  EXPECT_EQ(mix.unknown + mix.not_convex, 0u);
  EXPECT_EQ(mix.gaps[3], 4u * 3) << "those in contact";
  EXPECT_EQ(mix.gaps[6], 4u) << "1.273 - 1 m";
  EXPECT_EQ(mix.again, mix.after_first);
}

TEST(PairMix, CountsDepthsAndWhatIsLeftOut) {
  const report::PairMix mix =
      mix_of("ignore = [[\"out\", \"base\"]]\n" + cube + "name = \"base\"\n" + cube +
             "translation = [0.95, 0, 0]\n" + cube +
             "name = \"out\"\n[[body]]\nshape = {type = \"torus\", around = 8, across = 8, "
             "tube_radius = 0.2}\n");
  EXPECT_EQ(mix.frames, 1u);
  EXPECT_EQ(mix.known(), 2u) << "both other pairs of the cubes";
  EXPECT_EQ(mix.gaps[1], 2u) << "0.05 m deep";
  EXPECT_EQ(mix.not_convex, 3u);
}

TEST(PairMix, FollowsPairsThatComeAndGo) {
  const report::PairMix mix =
      mix_of("generator = \"uniform\"\ncount = 300\nstep = 0.2\nframes = 40\n");
  EXPECT_EQ(mix.frames, 24u);
  EXPECT_GT(mix.again, 0u);
  EXPECT_LT(mix.again, mix.after_first);
}

}  // namespace
}  // namespace touchstone
