// The command `draw`: what it counts as contact.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::Not;

// A floor that does not move; a box that rests on it, and two balls that overlap in the air.
constexpr const char* box_on_a_floor = R"(
body = [
  {shape = {type = "box", half_extents = [5, 5, 1]}, translation = [0, 0, -1], moving = false},
  {shape = {type = "box", half_extents = [1, 1, 1]}, translation = [0, 0, 1]},
  {shape = {type = "sphere", radius = 1}, translation = [-3, 0, 4]},
  {shape = {type = "sphere", radius = 1}, translation = [-3, 1, 4]},
]
)";

class Draw : public testing::Test {
 protected:
  std::string printed(std::vector<std::string> options) {
    const std::string scene = folder_.write("resting.toml", box_on_a_floor).string();
    options.insert(options.begin(), {"draw", scene, "--out", (folder_.path() / "a.png").string(),
                                     "--width", "64", "--height", "64"});
    commands::CommandLine line("");
    commands::add_scene_draw(line.add_command("draw", ""));
    testing::internal::CaptureStdout();
    EXPECT_EQ(line.run(options), commands::exit_done);
    return testing::internal::GetCapturedStdout();
  }

  TemporaryFolder folder_;
};

TEST_F(Draw, WhatRestsOnAFixedBodyIsNotInContact) {
  const std::string text = printed({});
  EXPECT_THAT(text, HasSubstr("4 bodies: 2 certainly apart (grey), 0 possibly in contact (amber), "
                              "2 overlapping (red); contacts with fixed bodies do not count"));
}

TEST_F(Draw, ContactsWithFixedBodiesCountWhenTheyAreAskedFor) {
  const std::string text = printed({"--with-fixed"});
  EXPECT_THAT(text, HasSubstr("4 bodies: 0 certainly apart (grey), 0 possibly in contact (amber), "
                              "4 overlapping (red)"));
  EXPECT_THAT(text, Not(HasSubstr("do not count")));
}

}  // namespace
}  // namespace touchstone
