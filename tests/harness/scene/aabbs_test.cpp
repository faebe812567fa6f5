#include "harness/scene/box_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "harness/base/error.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

scene::BoxRecording example() {
  scene::BoxRecording recording{"Brownian", "Cubes", {{-8, -8, -8}, {8, 8, 8}}, {}};
  for (int frame = 0; frame < 3; ++frame) {
    auto& boxes = recording.frames.emplace_back();
    for (int i = 0; i < 5; ++i) {
      const float x = 0.1f * static_cast<float>(i + frame);
      boxes.push_back({{x, -x, -0.0f}, {x + 1, x, std::numeric_limits<float>::denorm_min()}});
    }
  }
  return recording;
}

// The format as Broadmark's loader reads it, byte by byte.
std::string word(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
  return bytes;
}
std::string number(float value) { return word(std::bit_cast<std::uint32_t>(value)); }
std::string box(const Aabb& b) {
  return number(b.min[0]) + number(b.min[1]) + number(b.min[2]) + word(0) + number(b.max[0]) +
         number(b.max[1]) + number(b.max[2]) + word(0);
}
std::string padded(std::string text) {
  text.resize(128, '\0');
  return text;
}
std::string file_of(const scene::BoxRecording& r, std::uint32_t count, std::uint32_t steps) {
  std::string bytes = padded(r.scene) + padded(r.type) + word(count) + word(steps) + word(0) +
                      word(0) + box(r.world);
  for (const auto& frame : r.frames) {
    for (const Aabb& b : frame) bytes += box(b);
  }
  return bytes;
}

void expect_same(const scene::BoxRecording& a, const scene::BoxRecording& b) {
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.world, b.world);
  EXPECT_EQ(a.frames, b.frames);
}

class Aabbs : public testing::Test {
 protected:
  std::string fault(const std::string& content) {
    const auto file = folder_.write("x.aabbs", content);
    const std::string text = input_fault([&] { scene::read_aabbs(file); });
    EXPECT_THAT(text, AnyOf("", StartsWith(file.string() + ": ")));
    return text;
  }
  TemporaryFolder folder_;
};

TEST_F(Aabbs, WritesBroadmarksBytes) {
  scene::write_aabbs(example(), folder_.path() / "out.aabbs");
  EXPECT_EQ(folder_.read("out.aabbs"), file_of(example(), 5, 2));
  EXPECT_EQ(folder_.read("out.aabbs").size(), 304u + 3 * 5 * 32);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"out.aabbs"});
}

TEST_F(Aabbs, ReadsBroadmarksBytes) {
  expect_same(scene::read_aabbs(folder_.write("in.aabbs", file_of(example(), 5, 2))), example());
}

TEST_F(Aabbs, RoundTripKeepsTheBits) {
  const auto file = folder_.path() / "a.aabbs";
  scene::write_aabbs(example(), file);
  const scene::BoxRecording read = scene::read_aabbs(file);
  expect_same(read, example());
  EXPECT_TRUE(std::signbit(read.frames[0][0].min[2]));
  scene::BoxRecording single = example();
  single.frames.resize(1);
  scene::write_aabbs(single, file);
  expect_same(scene::read_aabbs(file), single);
}

TEST_F(Aabbs, LongNamesAreCut) {
  scene::BoxRecording recording = example();
  recording.scene = std::string(300, 'x');
  scene::write_aabbs(recording, folder_.path() / "a.aabbs");
  EXPECT_EQ(scene::read_aabbs(folder_.path() / "a.aabbs").scene, std::string(127, 'x'));
}

TEST_F(Aabbs, RefusesFilesOfTheWrongSize) {
  const std::string good = file_of(example(), 5, 2);
  EXPECT_EQ(fault(good), "");
  EXPECT_THAT(fault(""), HasSubstr("expected a header of 304"));
  EXPECT_NE(fault(good.substr(0, 303)), "");
  EXPECT_THAT(fault(good.substr(0, good.size() - 1)), HasSubstr("expected 3 frames of 5 boxes"));
  EXPECT_NE(fault(good.substr(0, good.size() - 32)), "");
  EXPECT_NE(fault(good + "x"), "");
  EXPECT_NE(fault(good + std::string(32, '\0')), "");
  EXPECT_NE(fault(good.substr(0, 304)), "");
}

// The claimed size is compared with the file's before anything is allocated.
TEST_F(Aabbs, RefusesClaimsBeyondTheFile) {
  for (const std::uint32_t count : {0x7fffffffu, 0x40000000u, 0x08000000u, 0u, 0xffffffffu}) {
    for (const std::uint32_t steps : {0x7fffffffu, 0x1fffffffu, 2u, 0u, 0xffffffffu}) {
      EXPECT_NE(fault(file_of(example(), count, steps)), "") << count << ' ' << steps;
    }
  }
}

TEST_F(Aabbs, RefusesBadBoxes) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, inf, -inf}) {
    scene::BoxRecording recording = example();
    recording.frames[1][3].max[2] = bad;
    EXPECT_THAT(fault(file_of(recording, 5, 2)), HasSubstr("frame 1, box 3: z"));
    recording = example();
    recording.world.min[0] = bad;
    EXPECT_THAT(fault(file_of(recording, 5, 2)), HasSubstr("world"));
  }
  scene::BoxRecording recording = example();
  recording.frames[2][4] = {{0, 1, 0}, {1, 0, 1}};
  EXPECT_THAT(fault(file_of(recording, 5, 2)), HasSubstr("frame 2, box 4: y"));
}

TEST_F(Aabbs, RefusesTextsWithoutAnEnd) {
  std::string bytes = file_of(example(), 5, 2);
  bytes.replace(0, 128, std::string(128, 'x'));
  EXPECT_THAT(fault(bytes), HasSubstr("scene's name"));
}

TEST_F(Aabbs, RefusesWhatTheFormatCannotHold) {
  scene::BoxRecording recording = example();
  recording.frames[1].pop_back();
  EXPECT_THROW(scene::write_aabbs(recording, folder_.path() / "a.aabbs"), base::InputError);
  recording.frames.clear();
  EXPECT_THROW(scene::write_aabbs(recording, folder_.path() / "a.aabbs"), base::InputError);
  EXPECT_THROW(scene::write_aabbs(example(), folder_.path() / "none" / "a.aabbs"),
               base::InputError);
  EXPECT_THROW(scene::read_aabbs(folder_.path() / "none.aabbs"), base::InputError);
  EXPECT_THROW(scene::read_aabbs(folder_.path()), base::InputError);
  EXPECT_TRUE(folder_.names().empty());
}

}  // namespace
}  // namespace touchstone
