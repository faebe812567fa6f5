#include "harness/scene/box_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr const char* header = "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n";

class BoxFrames : public ::testing::Test {
 protected:
  std::vector<scene::BoxFrame> read(const std::string& rows) {
    return scene::read_box_frames(folder.write("in.csv", header + rows));
  }
  std::string error(const std::string& rows) {
    return folder.without_path(input_fault([&] { read(rows); }));
  }
  TemporaryFolder folder;
};

TEST_F(BoxFrames, ReadsFramesAndWhatIsNewInThem) {
  const auto frames = read(
      "3,0,0,0,0,1,1,1\n3,1,5,5,5,6,6,6\n"
      "4,0,0,0,0,1,1,1\n4,1,5,5,5,6,6,7\n4,2,1,1,1,1,1,1\n"
      "9,0,-0,0,0,1,1,1\n"
      "10,0,-0,0,0,1,1,1\n10,1,5,5,5,6,6,7\n");
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[0].number, 3);
  EXPECT_EQ(frames[0].boxes[1], (Aabb{{5, 5, 5}, {6, 6, 6}}));
  EXPECT_THAT(frames[0].moved, IsEmpty());
  EXPECT_THAT(frames[0].inserted, IsEmpty());

  EXPECT_THAT(frames[1].moved, ElementsAre(1));
  EXPECT_THAT(frames[1].inserted, ElementsAre(2));
  EXPECT_THAT(frames[1].removed, IsEmpty());

  EXPECT_EQ(frames[2].number, 9);
  EXPECT_EQ(frames[2].count, 1u);
  EXPECT_EQ(frames[2].own_boxes().size(), 1u);
  EXPECT_THAT(frames[2].moved, ElementsAre(0)) << "0 and -0 have other bits";
  EXPECT_THAT(frames[2].removed, ElementsAre(1, 2));
  ASSERT_EQ(frames[2].boxes.size(), 3u);
  EXPECT_TRUE(frames[2].boxes[1].is_empty());

  EXPECT_THAT(frames[3].moved, IsEmpty());
  EXPECT_THAT(frames[3].inserted, ElementsAre(1));
  EXPECT_THAT(frames[3].removed, IsEmpty()) << "id 2 was gone already";
  ASSERT_EQ(frames[3].boxes.size(), 3u);
  EXPECT_TRUE(frames[3].boxes[2].is_empty());
}

TEST_F(BoxFrames, IdsMayHaveNoBody) {
  const auto frames =
      read("0,0,,,,,,\n0,1,0,0,0,1,1,1\n1,0,0,0,0,1,1,1\n1,1,,,,,,\n2,0,0,0,0,1,1,1\n");
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_TRUE(frames[0].boxes[0].is_empty());
  EXPECT_THAT(frames[1].inserted, ElementsAre(0));
  EXPECT_THAT(frames[1].removed, ElementsAre(1));
  EXPECT_THAT(frames[1].moved, IsEmpty());
  EXPECT_THAT(frames[2].removed, IsEmpty()) << "gone already";
  EXPECT_THAT(error("0,0,,,,1,1,1\n"), StartsWith("in.csv:2: column min_x"));
  const std::vector<std::vector<Aabb>> written = {{Aabb::empty(), {{0, 0, 0}, {1, 1, 1}}},
                                                  {{{0, 0, 0}, {1, 1, 1}}, Aabb::empty()}};
  scene::write_box_frames(written, folder.path() / "out.csv");
  const auto again = scene::read_box_frames(folder.path() / "out.csv");
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(again[0].boxes, written[0]);
  EXPECT_EQ(again[1].boxes, written[1]);
}

TEST_F(BoxFrames, RoundsOutward) {
  const Aabb box = read("0,0,0.1,-0.1,1e-300,0.1,-0.1,1e-300\n")[0].boxes[0];
  EXPECT_LT(double{box.min[0]}, 0.1);
  EXPECT_GT(double{box.max[0]}, 0.1);
  EXPECT_LT(double{box.min[1]}, -0.1);
  EXPECT_GT(double{box.max[1]}, -0.1);
  EXPECT_EQ(box.min[2], 0);
  EXPECT_GT(box.max[2], 0);
}

TEST_F(BoxFrames, BadBoxes) {
  EXPECT_THAT(error(""), StartsWith("in.csv:1: no box behind the header"));
  EXPECT_EQ(error("0,0,0,0,0,1,1,1\n0,1,nan,0,0,1,1,1\n"),
            "in.csv:3: found nan; expected a finite number in the range of float");
  EXPECT_EQ(error("0,0,0,0,0,1,inf,1\n"),
            "in.csv:2: found inf; expected a finite number in the range of float");
  EXPECT_THAT(error("0,0,0,0,0,1,1e39,1\n"), StartsWith("in.csv:2: found 1e39; expected a finite"));
  EXPECT_EQ(error("0,0,0,2,0,1,1,1\n"), "in.csv:2: y from 2 to 1; expected min <= max");
  EXPECT_EQ(error("0,0,0,0,0,1,one,1\n"), "in.csv:2: column max_y: found 'one'; expected a number");
  EXPECT_EQ(error("0,0,0,0,0,1,1\n"), "in.csv:2: 7 fields; expected 8, as in the header");
}

TEST_F(BoxFrames, IdsAndFramesOutOfOrder) {
  EXPECT_THAT(error("0,1,0,0,0,1,1,1\n"), StartsWith("in.csv:2: id 1; expected 0"));
  EXPECT_THAT(error("0,0,0,0,0,1,1,1\n0,0,0,0,0,1,1,1\n"),
              StartsWith("in.csv:3: id 0; expected 1"));
  EXPECT_THAT(error("0,0,0,0,0,1,1,1\n0,2,0,0,0,1,1,1\n"),
              StartsWith("in.csv:3: id 2; expected 1"));
  EXPECT_THAT(error("0,-1,0,0,0,1,1,1\n"), StartsWith("in.csv:2: id -1; expected 0"));
  EXPECT_THAT(error("0,0.5,0,0,0,1,1,1\n"), StartsWith("in.csv:2: column id: found '0.5'"));
  EXPECT_THAT(error("0,0,0,0,0,1,1,1\n1,1,0,0,0,1,1,1\n"),
              StartsWith("in.csv:3: id 1; expected 0"));
  EXPECT_THAT(error("1,0,0,0,0,1,1,1\n0,0,0,0,0,1,1,1\n"),
              StartsWith("in.csv:3: frame 0 after frame 1; expected frames in rising order"));
  EXPECT_THAT(error("-1,0,0,0,0,1,1,1\n"),
              StartsWith("in.csv:2: frame -1; expected frames from 0"));
}

TEST_F(BoxFrames, Recordings) {
  const Aabb near = {{0, 0, 0}, {1, 1, 1}}, far = {{8, 8, 8}, {9, 9, 9}};
  const auto file = folder.path() / "in.aabbs";
  scene::write_aabbs({"scene", "cubes", {{0, 0, 0}, {9, 9, 9}}, {{near, far}, {near, near}}}, file);
  const auto frames = scene::read_box_frames(file);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].number, 1);
  EXPECT_EQ(frames[1].count, 2u);
  EXPECT_THAT(frames[1].boxes, ElementsAre(near, near));
  EXPECT_THAT(frames[1].moved, ElementsAre(1));
  EXPECT_THROW(scene::read_box_frames(folder.write("bad.aabbs", "short")), base::InputError);
}

}  // namespace
}  // namespace touchstone
