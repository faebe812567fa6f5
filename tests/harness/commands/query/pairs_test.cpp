// Tests of touchstone query with boxes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>

#include "algorithms/registry.h"
#include "harness/base/hash.h"
#include "harness/kinds/box/box_kind.h"
#include "harness/scene/box_frames.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* box_header = "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n";
const std::vector<std::string> pair_columns = {"frame",      "algorithm", "threads", "status",
                                               "pair_count", "pair_hash", "seconds"};

// Makes some frames in which boxes move, come and go.
std::string random_boxes(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(0, 10), size(0, 3);
  std::string text = box_header;
  std::vector<std::array<float, 6>> boxes;
  for (int frame = 0; frame < 6; ++frame) {
    const std::size_t count = 40 + random() % 30;
    while (boxes.size() < count) boxes.emplace_back();
    for (std::size_t id = 0; id < count; ++id) {
      auto& box = boxes[id];
      if (box[5] == 0 || random() % 3 == 0) {
        for (std::size_t i = 0; i < 3; ++i) {
          box[i] = place(random);
          box[i + 3] = box[i] + size(random);
        }
      }
      text += fmt::format("{},{},{},{},{},{},{},{}\n", frame, id, box[0], box[1], box[2], box[3],
                          box[4], box[5]);
    }
    boxes.resize(count);
  }
  return text;
}

// Finds the pairs by the definition, one list a frame.
std::vector<std::vector<IndexPair>> all_pairs(const std::filesystem::path& file) {
  std::vector<std::vector<IndexPair>> lists;
  for (const scene::BoxFrame& frame : scene::read_box_frames(file)) {
    std::vector<IndexPair>& list = lists.emplace_back();
    for (std::uint32_t a = 0; a < frame.count; ++a) {
      for (std::uint32_t b = a + 1; b < frame.count; ++b) {
        if (overlap(frame.boxes[a], frame.boxes[b])) list.push_back({a, b});
      }
    }
  }
  return lists;
}

class PairsCommand : public ::testing::Test {
 protected:
  void expect_refusal(const std::string& arguments, const std::string& text) {
    touchstone::expect_refusal("query " + arguments, text, folder);
  }
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  TemporaryFolder folder;
};

TEST_F(PairsCommand, EveryBroadPhaseGivesTheRowsOfTheContract) {
  const auto file = folder.write("in.csv", random_boxes(1));
  const auto expected = all_pairs(file);
  for (const char* how :
       {"", " --rebuild", " --threads 1", " --threads 3", " --threads 3 --executor onetbb"}) {
    const Ran ran =
        run_program("query " + file.string() + " --broad all --out " + path("out.csv") + how);
    ASSERT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(folder.path() / "out.csv", pair_columns);
    std::size_t next = 0;
    for (std::size_t frame = 0; frame < expected.size(); ++frame) {
      for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
        if (!is_built(entry.info)) continue;
        ASSERT_LT(next, rows.size());
        const auto& row = rows[next++];
        EXPECT_EQ(row[0], std::to_string(frame));
        EXPECT_EQ(row[1], entry.info.name);
        EXPECT_EQ(row[2], how == std::string(" --threads 1")             ? "1"
                          : std::string(how).starts_with(" --threads 3") ? "3"
                                                                         : "2");
        EXPECT_GE(std::stod(row[6]), 0);
        if (!entry.info.known_defect.empty()) continue;
        EXPECT_TRUE(row[3] == "ok" || row[3] == "not_reported") << row[3];
        EXPECT_EQ(row[4], std::to_string(expected[frame].size())) << entry.info.name;
        EXPECT_EQ(row[5], base::to_hex(base::pair_hash(expected[frame]))) << entry.info.name;
      }
    }
    EXPECT_EQ(next, rows.size());
  }
}

TEST_F(PairsCommand, TheHashIsTheContracts) {
  // The expected hash is the sum over the pairs (0,1) and (0,2), each mixed as the contract says,
  // computed separately.
  const auto file = folder.write(
      "in.csv", std::string(box_header) + "0,0,0,0,0,9,9,9\n0,1,1,1,1,2,2,2\n0,2,9,9,9,9,9,9\n");
  ASSERT_EQ(
      run_program("query " + file.string() + " --broad naive --out " + path("out.csv")).status, 0);
  const auto rows = read_rows(folder.path() / "out.csv", pair_columns);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0][4], "2");
  EXPECT_EQ(rows[0][5], "286263caa599b38f");
}

TEST_F(PairsCommand, WritesThePairsInOrder) {
  const auto file = folder.write("in.csv", random_boxes(2));
  const auto expected = all_pairs(file);
  const Ran ran = run_program("query " + file.string() + " --broad naive --out " + path("out.csv") +
                              " --pairs " + path("pairs.csv"));
  ASSERT_EQ(ran.status, 0) << ran.text;
  std::vector<std::vector<std::string>> wanted;
  for (std::size_t frame = 0; frame < expected.size(); ++frame) {
    for (const IndexPair& pair : expected[frame]) {
      wanted.push_back(
          {std::to_string(frame), "naive", std::to_string(pair.a), std::to_string(pair.b)});
    }
  }
  EXPECT_GT(wanted.size(), 20u);
  EXPECT_EQ(read_rows(folder.path() / "pairs.csv", {"frame", "algorithm", "a", "b"}), wanted);
  EXPECT_THAT(folder.names(), ElementsAre("in.csv", "out.csv", "pairs.csv"));
}

TEST_F(PairsCommand, WritesWhatBeganAndEnded) {
  const auto file = folder.write("in.csv", random_boxes(3));
  const auto expected = all_pairs(file);
  for (const char* how : {"", " --rebuild"}) {
    const Ran ran = run_program("query " + file.string() + " --broad naive,dynamic-bvh --out " +
                                path("out.csv") + " --changes " + path("changes.csv") + how);
    ASSERT_EQ(ran.status, 0) << ran.text;
    std::vector<std::vector<std::string>> wanted;
    std::size_t ended = 0;
    for (std::size_t frame = 0; frame < expected.size(); ++frame) {
      const auto& now = expected[frame];
      const auto before = frame == 0 ? std::vector<IndexPair>{} : expected[frame - 1];
      for (const char* algorithm : {"dynamic-bvh", "naive"}) {
        const auto want = [&](const auto& of, const auto& without, const char* change) {
          for (const IndexPair& pair : of) {
            if (std::ranges::binary_search(without, pair)) continue;
            wanted.push_back({std::to_string(frame), algorithm, std::to_string(pair.a),
                              std::to_string(pair.b), change});
          }
        };
        want(now, before, "began");
        const std::size_t rows = wanted.size();
        want(before, now, "ended");
        ended += wanted.size() - rows;
      }
    }
    EXPECT_GT(wanted.size(), 100u);
    EXPECT_GT(ended, 20u);
    auto rows =
        read_rows(folder.path() / "changes.csv", {"frame", "algorithm", "a", "b", "change"});
    // The order of the algorithms is that of the list.
    std::ranges::stable_sort(rows, {}, [](const auto& row) { return row[0] + row[1]; });
    EXPECT_EQ(rows, wanted);
  }
}

TEST_F(PairsCommand, ReadsRecordings) {
  const Aabb near = {{0, 0, 0}, {1, 1, 1}}, far = {{8, 8, 8}, {9, 9, 9}};
  scene::write_aabbs({"scene", "cubes", {{0, 0, 0}, {9, 9, 9}}, {{near, far}, {near, near}}},
                     folder.path() / "in.aabbs");
  ASSERT_EQ(
      run_program("query " + path("in.aabbs") + " --broad naive --out " + path("out.csv")).status,
      0);
  const auto rows = read_rows(folder.path() / "out.csv", {"frame", "pair_count"});
  EXPECT_THAT(rows, ElementsAre(ElementsAre("0", "0"), ElementsAre("1", "1")));
}

TEST_F(PairsCommand, WhatTakesTooLongIsARowOfItsOwn) {
  std::string text = box_header;
  for (int id = 0; id < 100000; ++id) text += fmt::format("0,{0},{0},0,0,{0}.5,1,1\n", id);
  text += "1,0,0,0,0,1,1,1\n1,1,1,1,1,1,1,1\n";
  const auto file = folder.write("in.csv", text);
  const Ran ran = run_program("query " + file.string() + " --broad naive --time-limit 0.05 --out " +
                              path("out.csv") + " --pairs " + path("pairs.csv"));
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("naive, frame 0: no answer in time"));
  const auto rows = read_rows(folder.path() / "out.csv",
                              {"frame", "status", "pair_count", "pair_hash", "seconds"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_THAT(rows[0], ElementsAre("0", "timed_out", "", "", ""));
  EXPECT_THAT(read_rows(folder.path() / "pairs.csv", {"frame", "a", "b"}),
              ElementsAre(ElementsAre("1", "0", "1")));
}

TEST_F(PairsCommand, WritesThePairsOfWhatMoved) {
  const auto file = folder.write("in.csv", random_boxes(5));
  const auto expected = all_pairs(file);
  const auto frames = scene::read_box_frames(file);
  const Ran ran = run_program("query " + file.string() + " --broad naive,dynamic-bvh --out " +
                              path("out.csv") + " --moved " + path("moved.csv"));
  ASSERT_EQ(ran.status, 0) << ran.text;
  std::vector<std::vector<std::string>> wanted;
  std::size_t left_out = 0;
  for (std::size_t frame = 0; frame < expected.size(); ++frame) {
    std::set<std::uint32_t> fresh(frames[frame].moved.begin(), frames[frame].moved.end());
    fresh.insert(frames[frame].inserted.begin(), frames[frame].inserted.end());
    for (const char* algorithm : {"dynamic-bvh", "naive"}) {
      for (const IndexPair& pair : expected[frame]) {
        if (frame > 0 && !fresh.contains(pair.a) && !fresh.contains(pair.b)) {
          ++left_out;
        } else {
          wanted.push_back(
              {std::to_string(frame), algorithm, std::to_string(pair.a), std::to_string(pair.b)});
        }
      }
    }
  }
  EXPECT_GT(left_out, 10u);
  auto found = read_rows(folder.path() / "moved.csv", {"frame", "algorithm", "a", "b"});
  std::ranges::sort(found);
  std::ranges::sort(wanted);
  EXPECT_EQ(found, wanted);
}

TEST_F(PairsCommand, TwoBodiesAtRestAreNoPair) {
  const auto file = folder.write("in.csv", random_boxes(6));
  std::string resting = "id\n";
  for (int id = 0; id < 40; ++id) resting += id % 3 == 0 ? "" : fmt::format("{}\n", id);
  const auto ids = folder.write("resting.csv", resting);
  const auto expected = all_pairs(file);
  const Ran ran = run_program("query " + file.string() + " --broad all --out " + path("out.csv") +
                              " --pairs " + path("pairs.csv") + " --changes " +
                              path("changes.csv") + " --resting " + ids.string());
  ASSERT_EQ(ran.status, 0) << ran.text;
  const auto rests = [](std::uint32_t id) { return id < 40 && id % 3 != 0; };
  std::vector<std::vector<IndexPair>> wanted;
  std::size_t left_out = 0;
  for (const auto& pairs : expected) {
    auto& kept = wanted.emplace_back();
    for (const IndexPair& pair : pairs) {
      if (rests(pair.a) && rests(pair.b)) {
        ++left_out;
      } else {
        kept.push_back(pair);
      }
    }
  }
  EXPECT_GT(left_out, 10u);
  std::size_t rows = 0, began = 0;
  for (const auto& row : read_rows(folder.path() / "out.csv", pair_columns)) {
    const auto frame = static_cast<std::size_t>(std::stoi(row[0]));
    if (row[1].starts_with("fcl-sap") || row[1].starts_with("fcl-interval")) continue;
    EXPECT_EQ(row[4], std::to_string(wanted[frame].size())) << row[1];
    EXPECT_EQ(row[5], base::to_hex(base::pair_hash(wanted[frame]))) << row[1];
    ++rows;
  }
  EXPECT_GE(rows, 6 * 13u);
  for (const auto& row :
       read_rows(folder.path() / "changes.csv", {"frame", "algorithm", "a", "b", "change"})) {
    EXPECT_FALSE(rests(static_cast<std::uint32_t>(std::stoul(row[2]))) &&
                 rests(static_cast<std::uint32_t>(std::stoul(row[3]))));
    began += row[0] == "0" && row[1] == "naive" ? 1 : 0;
  }
  EXPECT_EQ(began, wanted[0].size());
}

TEST_F(PairsCommand, BadInput) {
  const auto refuse = [&](const std::string& content, const std::string& text) {
    folder.write("in.csv", content);
    expect_refusal(path("in.csv") + " --kind box --broad naive --out " + path("out.csv"),
                   path("in.csv") + text);
  };
  const std::string good = std::string(box_header) + "0,0,0,0,0,1,1,1\n";
  refuse("", ":1: an empty file; expected a header line");
  refuse(box_header, ":1: no box behind the header");
  refuse("0,0,0,0,0,1,1,1\n", ":1: no column 'frame'");
  refuse(good + "0,1,0,0,nan,1,1,1\n", ":3: found nan; expected a finite number");
  refuse(good + "0,1,0,0,0,1,-inf,1\n", ":3: found -inf; expected a finite number");
  refuse(good + "0,1,0,3,0,1,1,1\n", ":3: y from 3 to 1; expected min <= max");
  refuse(good + "0,0,0,0,0,1,1,1\n", ":3: id 0; expected 1");
  refuse(good + "0,2,0,0,0,1,1,1\n", ":3: id 2; expected 1");
  refuse(good + "0,1,0,0,0,1,1,x\n", ":3: column max_z: found 'x'; expected a number");
  refuse(good + "0,1,0,0\n", ":3: 4 fields; expected 8");
  folder.write("in.aabbs", "no recording");
  expect_refusal(path("in.aabbs") + " --broad naive --out " + path("out.csv"), path("in.aabbs"));
}

TEST_F(PairsCommand, BadRequests) {
  folder.write("in.csv", std::string(box_header) + "0,0,0,0,0,1,1,1\n");
  const std::string in = path("in.csv");
  const std::string out = " --out " + path("out.csv");
  expect_refusal(in + " --broad quick" + out, "no broad phase is called 'quick'; expected some of");
  expect_refusal(in + " --broad naive,,naive" + out, "no broad phase is called ''");
  expect_refusal(in + " --broad naive --threads 0" + out, "--threads");
  expect_refusal(in + " --broad naive --time-limit 0" + out, "--time-limit");
  expect_refusal(in + " --broad naive --threads two" + out, "--threads");
  expect_refusal(path("none.csv") + " --broad naive" + out, "none.csv: No such file or directory");
  expect_refusal(folder.path().string() + " --kind box --broad naive" + out, "Is a directory");
  expect_refusal(in + " --broad naive --out " + path("none/out.csv"), "No such file or directory");
  expect_refusal(in + " --broad naive --out " + folder.path().string(), "Is a directory");
  expect_refusal(in + " --broad naive --out /dev/full", "/dev/full: cannot be written: No space");
  expect_refusal(in + " --broad naive" + out + " --pairs /dev/full --threads 1",
                 "/dev/full: cannot be written: No space");
  expect_refusal(in + " --broad naive" + out + " --pairs " + path("none/p.csv"), "No such file");
  expect_refusal(in + " --broad naive" + out + " --pairs " + path("out.csv"), "the same file");
  expect_refusal(in + " --broad naive" + out + " --changes " + path("none/c.csv"), "No such file");
  expect_refusal(
      in + " --broad naive" + out + " --pairs " + path("p.csv") + " --changes " + path("p.csv"),
      "--pairs and --changes name the same file");
  expect_refusal(
      in + " --broad naive" + out + " --moved " + path("p.csv") + " --pairs " + path("p.csv"),
      "--pairs and --moved name the same file");
  folder.write("ids.csv", "id\n0\n1\n");
  expect_refusal(in + " --broad naive" + out + " --resting " + path("ids.csv"),
                 "ids.csv:3: column id: found 1; expected the id of a box, 0 to 0");
  expect_refusal(in + " --broad naive" + out + " --resting " + path("none.csv"), "none.csv");
}

// A frame of a mesh of three faces: a square of two in the plane z = 0, and a triangle that falls onto it. Edges by their
// greater vertex: 1-0, 2-0, 2-1, 3-0, 3-2, 5-4, 6-4, 6-5 are 7 to 14; the faces are 15 to 17.
std::string ply(double z) {
  return fmt::format(
      "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n4 0 0\n4 4 0\n0 4 0\n1 1 {0}\n2 1 {0}\n1 2 {0}\n3 0 1 2\n3 0 2 3\n3 4 5 6\n",
      z);
}

class MeshFrames : public PairsCommand {
 protected:
  void put(const std::string& name, const std::string& text) const {
    const auto file = folder.path() / "ball" / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  void put_frames() const {
    put("frames/ball9.ply", ply(3));
    put("frames/ball10.ply", ply(1));
    put("frames/ball11.ply", ply(-1));
  }
  std::string frames() const { return path("ball/frames"); }
};

TEST_F(MeshFrames, AreBoxesOfWhatTheFeaturesSweep) {
  put_frames();
  const auto steps = scene::read_box_frames(frames());
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].number, 9);
  EXPECT_EQ(steps[1].number, 10);
  ASSERT_EQ(steps[1].count, 18U);
  EXPECT_EQ(steps[1].boxes[4], (Aabb{{1, 1, -1}, {1, 1, 1}}));   // a vertex
  EXPECT_EQ(steps[1].boxes[10], (Aabb{{0, 0, 0}, {0, 4, 0}}));   // the edge from 3 to 0
  EXPECT_EQ(steps[1].boxes[14], (Aabb{{1, 1, -1}, {2, 2, 1}}));  // the edge from 6 to 5
  EXPECT_EQ(steps[1].boxes[17], (Aabb{{1, 1, -1}, {2, 2, 1}}));  // the face that falls
  EXPECT_EQ(steps[1].moved.size(), 7U);  // three vertices, three edges, a face
  const auto one = scene::read_box_frames(frames() + "/ball10.ply");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].boxes, steps[1].boxes);
}

TEST_F(MeshFrames, KnownPairsAreFound) {
  put_frames();
  put("boxes/ball10vf.json", "[[4, 15], [5,15], [15,4]]");
  put("boxes/ball10ee.json", "[[8,13]]");
  const Ran all = run_program("query " + frames() + " --out " + path("out.csv"));
  EXPECT_EQ(all.status, 0) << all.text;
  EXPECT_THAT(all.text, HasSubstr("Each algorithm found the 3 known pairs"));
  const std::size_t rows = read_rows(folder.path() / "out.csv", pair_columns).size();
  EXPECT_GE(rows, 2U);
  EXPECT_EQ(rows % 2, 0U);
  const Ran one = run_program("query " + frames() + "/ball10.ply --with naive");
  EXPECT_EQ(one.status, 0) << one.text;
  EXPECT_THAT(one.text, HasSubstr("Each algorithm found the 3 known pairs"));
}

class FindsNothing final : public BroadPhase {
 public:
  void build(std::span<const Aabb>) override {}
  void update(const FrameChange&) override {}
  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    return Status::ok;
  }
};

TEST_F(MeshFrames, KnownPairsThatAreNotFoundAreCounted) {
  put_frames();
  put("boxes/ball10vf.json", "[[5,15],[4,15]]");
  const auto steps = scene::read_box_frames(frames());
  BroadPhaseEntry entry = *registry::find<BroadPhaseEntry>("naive");
  entry.make = [](Executor&) { return std::make_unique<FindsNothing>(); };
  const kinds::BoxOptions options;
  const std::vector<char> is_resting;
  kinds::BoxContender nothing(entry, steps, options, is_resting);
  nothing.run();
  EXPECT_EQ(nothing.result(0).missing, 0U);
  EXPECT_EQ(nothing.result(1).missing, 2U);
  EXPECT_EQ(nothing.result(1).first_missing, (IndexPair{4, 15}));
  kinds::BoxContender right(*registry::find<BroadPhaseEntry>("naive"), steps, options, is_resting);
  right.run();
  EXPECT_EQ(right.result(1).missing, 0U);
}

TEST_F(MeshFrames, BadOnes) {
  put_frames();
  const std::string with = " --broad naive --out " + path("out.csv");
  const auto refuse_list = [&](const std::string& list, const std::string& text) {
    put("boxes/ball10vf.json", list);
    expect_refusal(frames() + with, "boxes/ball10vf.json: " + text);
  };
  refuse_list("{}", "no array; expected pairs of ids");
  refuse_list("[[4]]", "entry 0: expected a pair of ids");
  refuse_list("[[4,-1]]", "entry 0: expected a pair of ids");
  refuse_list("[[4,15],[4,18]]", "entry 1: found 4 and 18; expected two of the 18 ids");
  refuse_list("[[1,17]]", "entry 0: the boxes 1 and 17 are apart");
  put("boxes/ball10vf.json", "[]");
  expect_refusal(frames() + "/ball11.ply" + with, "no next frame in its folder");
  put("frames/other11.ply", ply(0));
  expect_refusal(frames() + with, "has the number of other11.ply; expected one file a frame");
  std::filesystem::remove(folder.path() / "ball/frames/other11.ply");
  std::string other = ply(0);
  put("frames/ball12.ply", other.replace(other.find("3 4 5 6"), 7, "3 4 6 5"));
  expect_refusal(frames() + with, "other vertices or faces than ball11.ply");
  put("frames/ball12.ply", "ply\n");
  expect_refusal(frames() + with, "ball12.ply");
}

}  // namespace
}  // namespace touchstone
