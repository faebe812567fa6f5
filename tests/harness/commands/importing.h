// What tests of touchstone scene import share: a folder to import from, and the hash of what was made.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "harness/scene/scene.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

class Import : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "mine/meshes");
    folder_.write("mine/meshes/tip.obj",
                  "v 0 0 0\nv 0.05 0 0\nv 0 0.05 0\nv 0 0 0.15\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 "
                  "4\n");
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  // Imports the files, takes these away, and returns the hash of what was made. Expects these words.
  std::string import_alone(const std::string& files, const std::string& words = "") {
    const std::string out = "out" + std::to_string(made_++);
    const Ran ran = run_program("scene import " + files + " --out " + path(out));
    EXPECT_EQ(ran.status, 0) << ran.text;
    EXPECT_THAT(ran.text, testing::HasSubstr(words));
    std::filesystem::rename(folder_.path() / "mine", folder_.path() / "elsewhere");
    const std::string hash = scene::scene_hash(scene::load_scene(path(out + "/scene.toml")));
    std::filesystem::rename(folder_.path() / "elsewhere", folder_.path() / "mine");
    return hash;
  }
  static std::string hash_of(const std::string& file) {
    return scene::scene_hash(scene::load_scene(file));
  }

  TemporaryFolder folder_;
  int made_ = 0;
};

}  // namespace touchstone
