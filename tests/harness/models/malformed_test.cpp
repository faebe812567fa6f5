// Models that are malformed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "harness/models/model.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/models/model_files.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::models {
namespace {

using namespace model_files;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string fault_of(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  const auto file = folder.write(name, content);
  return folder.without_path(input_fault([&] { read_model(file); }));
}

std::string with_points(const std::array<float, 12>& changed) {
  return gltf(R"({"mesh": 0})", data_uri(bytes_of(changed) + bytes_of(corners)));
}

TEST(MalformedModels, WhatIsMalformedIsRefusedWithTheFilesName) {
  const std::string json = gltf(R"({"mesh": 0})"), binary = glb(gltf(R"({"mesh": 0})", ""));
  const std::vector<std::pair<std::string, std::string>> whole = {
      {"a.gltf", json},
      {"a.glb", binary},
      {"a.dae", collada("", collada_node)},
      {"a.fbx", fbx({}, {})},
      {"a.3ds", three_ds()}};
  for (const auto& [name, content] : whole) {
    EXPECT_EQ(fault_of(name, content), "");
    EXPECT_THAT(fault_of(name, ""), StartsWith(name + ": Assimp cannot read it: ")) << name;
    EXPECT_THAT(fault_of(name, content.substr(0, content.size() / 2)), StartsWith(name + ": "))
        << name;
    EXPECT_THAT(fault_of(name, std::string(1000, 'x')), StartsWith(name + ": ")) << name;
    EXPECT_THAT(fault_of(name, std::string(1000, '\0')), StartsWith(name + ": ")) << name;
  }
  EXPECT_THAT(fault_of("a.dae", json), StartsWith("a.dae: "));
  EXPECT_THAT(fault_of("a.gltf", gltf(R"({"mesh": 0})", "gone.bin")),
              AnyOf(HasSubstr("gone.bin"), HasSubstr("could not open")));
}

TEST(MalformedModels, NumbersThatAreNoneAreRefused) {
  std::array<float, 12> changed = points;
  changed[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(fault_of("a.gltf", with_points(changed)), HasSubstr("is not finite"));
  changed[4] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(fault_of("a.gltf", with_points(changed)), HasSubstr("is not finite"));
  EXPECT_THAT(fault_of("a.dae", collada("<unit meter=\"0\"/>", collada_node)),
              StartsWith("a.dae: "));
  EXPECT_THAT(fault_of("a.dae", collada("<unit meter=\"-1\"/>", collada_node)),
              StartsWith("a.dae: "));
}

TEST(MalformedModels, IndicesAndCountsOutOfRangeAreRefused) {
  std::array<std::uint16_t, 12> wrong = corners;
  wrong[7] = 4;
  EXPECT_EQ(
      fault_of("a.gltf", gltf(R"({"mesh": 0})", data_uri(bytes_of(points) + bytes_of(wrong)))),
      "a.gltf: Assimp cannot read it: Some faces had out-of-range indices. Those faces were "
      "dropped.");
  std::string binary = three_ds();
  binary.replace(binary.find(bytes_of(corners[1]) + bytes_of(corners[2])), 1, "\7");
  EXPECT_THAT(fault_of("a.3ds", binary),
              HasSubstr("a.3ds: Assimp cannot read it: 3DS: Vertex index overflow"));
  std::string lines = fbx({}, {});
  lines.replace(lines.find("0,1,-4"), 6, "0,9,-4");
  EXPECT_THAT(fault_of("a.fbx", lines), HasSubstr("polygon vertex index out of range"));
  std::string text = gltf(R"({"mesh": 0})");
  text.replace(text.find("\"count\": 12"), 11, "\"count\": 4000000000");
  EXPECT_THAT(fault_of("a.gltf", text), StartsWith("a.gltf: "));
  EXPECT_THAT(fault_of("a.gltf", gltf(R"({"mesh": 7})")), StartsWith("a.gltf: "));
  EXPECT_THAT(fault_of("a.gltf", gltf(R"({"mesh": 0, "children": [0]})")), StartsWith("a.gltf: "));
  std::string mesh = collada("", collada_node);
  mesh.replace(mesh.find("0 2 1 0 1 3"), 11, "0 2 1 0 9 3");
  EXPECT_THAT(fault_of("a.dae", mesh), HasSubstr("Invalid data index (9/4)"));
}

}  // namespace
}  // namespace touchstone::models
