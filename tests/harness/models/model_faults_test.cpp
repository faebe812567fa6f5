// Processes that crash, hang and answer garbage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "harness/models/model.h"
#include "harness/models/model_stream.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/models/model_files.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::models {
namespace {

namespace fs = std::filesystem;
using namespace model_files;
using testing::HasSubstr;
using testing::StartsWith;

class ModelFaults : public testing::Test {
 protected:
  // What is said where a script takes the place of the program that reads.
  std::string fault_with(const std::string& script, ModelProcess limits = {}) {
    limits.program = folder_.write("script", "#!/bin/sh\n" + script + "\n");
    fs::permissions(limits.program, fs::perms::owner_all);
    const fs::path file = folder_.write("a.glb", "a model");
    return folder_.without_path(input_fault([&] { read_model(file, limits); }));
  }

  TemporaryFolder folder_;
};

TEST_F(ModelFaults, WhatIsNoFileIsRefused) {
  EXPECT_THAT(input_fault([&] { read_model(folder_.path() / "none.glb"); }),
              HasSubstr("none.glb: No such file"));
  fs::create_directory(folder_.path() / "folder.glb");
  EXPECT_THAT(input_fault([&] { read_model(folder_.path() / "folder.glb"); }),
              HasSubstr("folder.glb: Is a directory"));
}

TEST_F(ModelFaults, ACrashIsSaid) {
  // A sanitizer's runtime in a shell would catch it.
  EXPECT_EQ(fault_with("kill -SEGV $$"),
            "a.glb: Assimp crashed (SIGSEGV); expected a file that it reads");
  EXPECT_EQ(
      fault_with("echo free: invalid pointer >&2; kill -ABRT $$"),
      "a.glb: Assimp crashed (SIGABRT): free: invalid pointer?; expected a file that it reads");
  EXPECT_EQ(fault_with("kill -KILL $$"),
            "a.glb: Assimp was killed (SIGKILL) while it read this file");
  EXPECT_EQ(fault_with("printf 'no mesh' >&2; exit 1"), "a.glb: Assimp cannot read it: no mesh");
  EXPECT_EQ(fault_with("exit 9"), "a.glb: Assimp ended with status 9");
}

TEST_F(ModelFaults, AHangIsEnded) {
  EXPECT_EQ(fault_with("exec sleep 1000", {.program = {}, .seconds = 0.2}),
            "a.glb: took Assimp more than 0.2 s; expected a file that takes less");
  // It may hang when it has said all.
  EXPECT_EQ(fault_with("exec >&- 2>&-; exec sleep 1000", {.program = {}, .seconds = 0.2}),
            "a.glb: took Assimp more than 0.2 s; expected a file that takes less");
}

TEST_F(ModelFaults, TooMuchIsEnded) {
  EXPECT_EQ(fault_with("exit 3"),
            "a.glb: took Assimp more than 4096 MiB; expected a file that takes less");
  EXPECT_EQ(fault_with("exec cat /dev/zero", {.program = {}, .seconds = 60, .memory = 1 << 20}),
            "a.glb: Assimp answers more than 1048576 bytes; expected a smaller file");
  EXPECT_THAT(fault_with("yes >&2 & exec yes >&2", {.program = {}, .seconds = 0.3}),
              HasSubstr("more than 0.3 s"));
}

TEST_F(ModelFaults, GarbageIsRefused) {
  EXPECT_EQ(fault_with("exit 0"),
            "a.glb: what Assimp made of it ends early; expected a whole model");
  EXPECT_EQ(fault_with("echo a line that is none of a model"),
            "a.glb: what Assimp made of it is garbage; expected a whole model");
  EXPECT_THAT(input_fault([&] {
                read_model(folder_.write("a.glb", ""), {.program = folder_.path() / "gone"});
              }),
              HasSubstr("gone, which cannot be run (No such file or directory)"));
}

// A stream as the program writes it, of one mesh and two nodes.
std::string stream_of_a_model() {
  std::string text(stream_begin);
  const auto count = [&](std::uint64_t value) { text += bytes_of(value); };
  text += bytes_of(0.01) + bytes_of(std::array<double, 9>{1, 0, 0, 0, 0, -1, 0, 1, 0});
  count(1);
  count(3);
  count(1);
  text += bytes_of(std::array<double, 9>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  text += bytes_of(std::array<std::uint32_t, 3>{0, 1, 2});
  for (int i = 0; i < 7; ++i) count(0);
  count(1);
  count(4);
  text += "gone";
  count(2);
  for (const std::uint64_t parent : {0U, 1U}) {
    count(parent);
    count(4);
    text += "node" + bytes_of(std::array<double, 12>{1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0});
    count(1);
    text += bytes_of(std::uint32_t{0});
  }
  return text + std::string(stream_end);
}

TEST(ModelStream, IsReadWhole) {
  const Model model = parse_model("f", stream_of_a_model());
  EXPECT_EQ(model.nodes[1].to_file.translation, Vec3d(10, 0, 0));
  EXPECT_EQ(input_fault([] { parse_model("f", stream_of_a_model() + "x"); }),
            "f: what Assimp made of it has more behind its end; expected a whole model");
}

TEST(ModelStream, IsNotTrusted) {
  const std::string good = stream_of_a_model();
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THAT(input_fault([&] { parse_model("f", std::string_view(good).substr(0, size)); }),
                StartsWith("f: "));
  }
  std::mt19937_64 random(1);
  int read = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string changed = good;
    for (int k = 0; k < 1 + i % 3; ++k) {
      changed[random() % changed.size()] = static_cast<char>(i % 2 == 0 ? random() : 0xff);
    }
    Model model;
    const std::string fault = input_fault([&] { model = parse_model("f", changed); });
    ++(fault.empty() ? read : refused);
    EXPECT_TRUE(fault.empty() || fault.starts_with("f: ")) << fault;
    for (const ModelNode& node : model.nodes) {
      ASSERT_TRUE(node.to_file.linear.allFinite());
      for (const std::uint32_t mesh : node.meshes) ASSERT_LT(mesh, model.meshes.size());
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

TEST(ModelStream, InstancesWithoutEndAreRefused) {
  Model model;
  model.meshes.push_back({{{0, 0, 0}}, std::vector<std::array<std::uint32_t, 3>>(1'000'001)});
  model.nodes.push_back({"a", {}, std::vector<std::uint32_t>(100, 0)});
  EXPECT_EQ(input_fault([&] { whole_mesh("f", model); }),
            "f: its instances have more than 100000000 triangles; expected at most so many");
}

}  // namespace
}  // namespace touchstone::models
