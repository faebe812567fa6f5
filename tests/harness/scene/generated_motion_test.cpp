// Steps, random order, bodies that jump, come and go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <vector>

#include "harness/base/error.h"
#include "harness/scene/kinematics.h"
#include "harness/scene/player.h"
#include "harness/scene/scene.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/scene/scene_text.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

std::string error(const std::string& content) {
  return input_fault([&] { load_text(content); });
}

bool same_bits(const Aabb& a, const Aabb& b) { return std::memcmp(&a, &b, sizeof(Aabb)) == 0; }

std::vector<Vec3d> sorted_places(const scene::Kinematics& kinematics, std::size_t bodies) {
  std::vector<Vec3d> places;
  for (std::size_t i = 0; i < bodies; ++i) {
    if (kinematics.is_present(i)) places.push_back(kinematics.poses()[i].translation);
  }
  std::ranges::sort(places, [](const Vec3d& a, const Vec3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return places;
}

TEST(Step, IsTheGreatestDisplacementInMedianSizes) {
  for (const char* generator : {"uniform", "clustered", "ground", "stack", "brownian"}) {
    const scene::Scene scene =
        load_text(std::string("generator = \"") + generator +
                  "\"\ncount = 400\nmoving = 1\nframes = 3\nstep = 0.05\n" +
                  (generator == std::string("stack") ? "size = 2" : "size = [2, 2]"));
    scene::Kinematics kinematics(scene);
    double greatest = 0;
    for (int frame = 1; frame < scene.frames; ++frame) {
      std::vector<Vec3d> before;
      for (const Pose& pose : kinematics.poses()) before.push_back(pose.translation);
      kinematics.next();
      for (std::size_t i = 0; i < before.size(); ++i) {
        greatest = std::max(greatest, (kinematics.poses()[i].translation - before[i]).norm());
      }
    }
    EXPECT_LE(greatest, 0.1 * (1 + 1e-6)) << generator;
    EXPECT_GT(greatest, 0.08) << generator;
  }
}

TEST(Step, FaultsAreTold) {
  EXPECT_THAT(error("generator = \"uniform\"\nstep = 0.1\nspeed = 1\n"),
              HasSubstr("scene.toml:2: step: given beside speed"));
  EXPECT_THAT(error("generator = \"uniform\"\nstep = -0.1\n"), HasSubstr("scene.toml:2: step"));
  EXPECT_THAT(error("generator = \"pairs\"\ncount = 4\nstep = 0.1\n"),
              HasSubstr("whose bodies stand still"));
}

TEST(Order, ShufflingKeepsTheBodies) {
  for (const char* generator : {"city", "ground", "uniform"}) {
    const std::string content =
        std::string("generator = \"") + generator + "\"\ncount = 300\nframes = 2\n";
    const scene::Scene plain = load_text(content),
                       shuffled = load_text(content + "shuffled = true\n");
    EXPECT_NE(scene::scene_hash(plain), scene::scene_hash(shuffled));
    EXPECT_EQ(scene::scene_hash(plain),
              scene::scene_hash(load_text(content + "shuffled = false\n")));
    const auto boxes = [](const scene::Scene& scene) {
      const scene::ScenePlayer player(scene, scene::BoxKind::tight);
      std::vector<Aabb> all(player.boxes().begin(), player.boxes().end());
      std::ranges::sort(all, [](const Aabb& a, const Aabb& b) {
        return std::pair(a.min, a.max) < std::pair(b.min, b.max);
      });
      return all;
    };
    EXPECT_EQ(boxes(plain), boxes(shuffled)) << generator;
  }
  EXPECT_THAT(error("generator = \"pairs\"\ncount = 4\nshuffled = true\n"),
              HasSubstr("shuffled: given with bodies that are listed in pairs"));
}

TEST(Exchange, TeleportsPermuteThePlacesOfThoseThatMove) {
  const scene::Scene scene = load_text(
      "generator = \"clustered\"\ncount = 300\nframes = 6\nmoving = 0.5\nspeed = 0\nspin = 0\n"
      "teleports = 0.1\n");
  EXPECT_EQ(scene.motion.teleports, 15u);
  scene::Kinematics kinematics(scene);
  const auto start = sorted_places(kinematics, scene.bodies.size());
  std::set<std::size_t> jumped;
  for (int frame = 1; frame < scene.frames; ++frame) {
    std::vector<Vec3d> before;
    for (const Pose& pose : kinematics.poses()) before.push_back(pose.translation);
    kinematics.next();
    std::size_t count = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (kinematics.poses()[i].translation == before[i]) continue;
      EXPECT_TRUE(scene.bodies[i].moving);
      jumped.insert(i);
      ++count;
    }
    EXPECT_EQ(count, 15u);
    EXPECT_EQ(sorted_places(kinematics, scene.bodies.size()), start);
  }
  EXPECT_GT(jumped.size(), 30u) << "not the same ones each time";
}

// Checks the promises of FrameChange and of the file's format.
TEST(Exchange, ChurnKeepsTheContractOfFrameChange) {
  const scene::Scene scene = load_text(
      "generator = \"uniform\"\ncount = 400\nframes = 12\nmoving = 0.5\nchurn = 0.1\n"
      "teleports = 0.05\n");
  EXPECT_EQ(scene.size(), 400u);
  EXPECT_EQ(scene.motion.churn, 20u);
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  EXPECT_EQ(player.boxes().size(), 400u);
  EXPECT_TRUE(player.change().inserted.empty());
  std::vector<Aabb> before(player.boxes().begin(), player.boxes().end());
  std::set<std::uint32_t> gone, last_gone;
  bool again = false;
  while (player.next()) {
    const FrameChange change = player.change();
    ASSERT_EQ(change.boxes.size(), 420u) << "grows once";
    EXPECT_EQ(change.inserted.size(), 20u);
    EXPECT_EQ(change.removed.size(), 20u);
    std::vector<int> listed(change.boxes.size(), 0);
    for (const auto& list : {change.moved, change.inserted, change.removed}) {
      EXPECT_TRUE(std::ranges::is_sorted(list));
      for (const std::uint32_t id : list) ++listed[id];
    }
    const auto was = [&](std::size_t id) { return id < before.size() && !before[id].is_empty(); };
    for (const std::uint32_t id : change.moved) EXPECT_TRUE(was(id));
    for (const std::uint32_t id : change.inserted) {
      EXPECT_FALSE(was(id));
      EXPECT_FALSE(change.boxes[id].is_empty());
      again = again || gone.contains(id);
    }
    for (const std::uint32_t id : change.removed) {
      EXPECT_TRUE(was(id));
      EXPECT_TRUE(same_bits(change.boxes[id], Aabb::empty()));
      gone.insert(id);
    }
    std::size_t present = 0;
    for (std::size_t id = 0; id < change.boxes.size(); ++id) {
      EXPECT_LE(listed[id], 1);
      present += !change.boxes[id].is_empty();
      if (listed[id] == 0 && id < before.size()) {
        EXPECT_TRUE(same_bits(before[id], change.boxes[id]));
      }
    }
    EXPECT_EQ(present, 400u);
    before.assign(change.boxes.begin(), change.boxes.end());
  }
  EXPECT_TRUE(again) << "ids are used again";
  EXPECT_GT(gone.size(), 60u);
}

TEST(Exchange, ThoseThatComeTakeThePlacesLeft) {
  const scene::Scene scene = load_text(
      "generator = \"uniform\"\ncount = 200\nframes = 8\nspeed = 0\nspin = 0\nchurn = 0.25\n");
  scene::Kinematics kinematics(scene);
  const auto start = sorted_places(kinematics, scene.bodies.size());
  for (int frame = 1; frame < scene.frames; ++frame) {
    kinematics.next();
    EXPECT_EQ(sorted_places(kinematics, scene.bodies.size()), start);
  }
}

TEST(Exchange, ShareOfOneAndOneBody) {
  scene::Scene scene =
      load_text("generator = \"uniform\"\ncount = 50\nframes = 4\nchurn = 1\nteleports = 1\n");
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  while (player.next()) {
    EXPECT_TRUE(player.change().moved.empty());
    EXPECT_EQ(player.change().removed.size(), 50u);
  }
  scene = load_text("generator = \"uniform\"\ncount = 1\nframes = 3\nchurn = 1\nteleports = 1\n");
  EXPECT_EQ(scene.motion.teleports, 0u);
  scene::ScenePlayer alone(scene, scene::BoxKind::tight);
  while (alone.next()) EXPECT_EQ(alone.change().inserted.size(), 1u);
}

TEST(Exchange, HashAndFramesAreTheSameEachTimeAndTellTheKeysApart) {
  const std::string content = "generator = \"uniform\"\ncount = 200\nframes = 6\n";
  std::set<std::string> hashes;
  for (const char* more : {"", "churn = 0.1", "churn = 0.2", "teleports = 0.1", "teleports = 0.2",
                           "churn = 0.1\nteleports = 0.1"}) {
    const scene::Scene a = load_text(content + more), b = load_text(content + more);
    EXPECT_EQ(scene::scene_hash(a), scene::scene_hash(b));
    EXPECT_TRUE(hashes.insert(scene::scene_hash(a)).second) << more;
    scene::ScenePlayer first(a, scene::BoxKind::tight), second(b, scene::BoxKind::tight);
    do {
      EXPECT_TRUE(std::ranges::equal(first.boxes(), second.boxes(), same_bits));
      second.next();
    } while (first.next());
  }
  // Zero is equal to a missing key.
  EXPECT_TRUE(
      hashes.contains(scene::scene_hash(load_text(content + "churn = 0\nteleports = 0\n"))));
}

TEST(Exchange, FaultsAreTold) {
  EXPECT_THAT(error("generator = \"uniform\"\nchurn = 1.5\n"), HasSubstr("scene.toml:2: churn"));
  EXPECT_THAT(error("generator = \"uniform\"\nteleports = -1\n"), HasSubstr("teleports"));
  EXPECT_THAT(error("generator = \"uniform\"\nmoving = 0\nchurn = 0.1\n"),
              HasSubstr("churn: given where no body moves"));
  EXPECT_THAT(error("[[body]]\nshape = {type = \"sphere\", radius = 1}\nchurn = 0.1\n"),
              HasSubstr("churn"));
}

}  // namespace
}  // namespace touchstone
