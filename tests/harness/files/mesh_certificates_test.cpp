// Certificates of rays and points at meshes, as files.
#include "harness/files/ray_certificates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using Claim = oracle::PointCertificate::Claim;

const std::string mesh_text =
    R"({"mesh":{"type":"mesh","vertices":[[0.0,0.0,0.0],[1.0,0.0,0.0],[0.1,1.0,-0.0]],)"
    R"("triangles":[[0,1,2]],"solid":false}})";
const std::string ray_text =
    R"({"ray":7,"task":"closest","origin":[0.1,0.0,1e-310],"direction":[0.0,0.0,-1.0],)"
    R"("t_max":"inf","hit":true,"triangle":0,"t":["1","3"]})";
const std::string point_text =
    R"({"point":3,"at":[0.1,0.0,1.0],"claim":"nearest","triangle":0,"square":["1","3"]})";

class MeshCertificates : public ::testing::Test {
 protected:
  // The lines that are written for those that were read.
  std::string rewritten(const std::string& text, bool of_rays) {
    std::string out;
    const auto file = folder.write("in.jsonl", text);
    const auto mesh = [&](const TriangleMesh& read) { out += files::mesh_line(read) + "\n"; };
    const auto each = [&](const auto& stored, std::int64_t) { out += to_json(stored) + "\n"; };
    if (of_rays) {
      const auto scene = [&](const std::vector<files::PlacedConcave>& read) {
        out += files::scene_line(read) + "\n";
      };
      files::read_ray_certificates(file, {mesh, each, scene, each});
    } else {
      files::read_point_certificates(file, mesh, each);
    }
    return out;
  }
  std::string fault(const std::string& text, bool of_rays) {
    return folder.without_path(input_fault([&] { rewritten(text, of_rays); }));
  }
  void expect_fault(std::string text, const std::string& part, const std::string& other,
                    bool of_rays, const std::string& said) {
    const auto place = text.find(part);
    ASSERT_NE(place, std::string::npos) << part;
    text.replace(place, part.size(), other);
    EXPECT_THAT(fault(mesh_text + "\n" + text, of_rays), HasSubstr("in.jsonl:2: " + said));
  }
  TemporaryFolder folder;
};

TEST_F(MeshCertificates, AreReadAsTheyWereWritten) {
  const std::string miss =
      R"({"ray":0,"task":"any","origin":[0.1,0.0,1.0],"direction":[0.0,0.0,5e-324],)"
      R"("t_max":0.1,"hit":false})";
  const std::string rays = mesh_text + "\n" + ray_text + "\n" + miss + "\n";
  EXPECT_EQ(rewritten(rays, true), rays);
  const std::string points = mesh_text + "\n" + point_text + "\n" +
                             R"({"point":4,"at":[0.1,0.0,1.0],"claim":"inside","winding":-2})" +
                             "\n" +
                             R"({"point":4,"at":[0.1,0.0,1.0],"claim":"outside","winding":0})" +
                             "\n" + R"({"point":4,"at":[0.1,0.0,1.0],"claim":"surface"})" + "\n" +
                             R"({"point":4,"at":[0.1,0.0,1.0],"claim":"nearest"})" + "\n";
  EXPECT_EQ(rewritten(points, false), points);
}

const std::string ball_text =
    R"({"shape":{"type":"sphere","radius":1.0},"translation":[0.0,0.0,1.0],)"
    R"("rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0]})";
const std::string scene_text = R"({"bodies":[)" + ball_text + "," + ball_text + "]}";
const std::string at_scene =
    R"({"ray":7,"task":"any","origin":[0.1,0.0,3.0],"direction":[0.0,0.0,-1.0],"t_max":5.0,)"
    R"("ordered":true,"answer":"hit","lower":["1","3"],"upper":["2","3"],"body":1,"part":4,"generators":[0,3],)"
    R"("surface":{"points":[[0,1]],"triangles":[[0,1,2]]},)"
    R"("cover":{"order":[1,0],"steps":["halve",["1","-2","0"],"body"]},)"
    R"("of_bodies":[{"order":[0],"steps":["own","triangle"]}]})";

TEST_F(MeshCertificates, OfRaysAtScenes) {
  const std::string once = rewritten(scene_text + "\n" + at_scene + "\n", true);
  EXPECT_THAT(once, HasSubstr("\n" + at_scene + "\n"));
  EXPECT_EQ(rewritten(once, true), once);
  // A file may have both.
  const std::string both = once + mesh_text + "\n" + ray_text + "\n";
  EXPECT_EQ(rewritten(both, true), both);
  const auto expect_scene_fault = [&](const std::string& part, const std::string& other,
                                      const std::string& said) {
    std::string text = at_scene;
    const auto place = text.find(part);
    ASSERT_NE(place, std::string::npos) << part;
    text.replace(place, part.size(), other);
    EXPECT_THAT(fault(scene_text + "\n" + text, true), HasSubstr("in.jsonl:2: " + said));
  };
  for (const std::string key :
       {"ray", "task", "origin", "direction", "t_max", "ordered", "answer", "lower", "upper",
        "body", "part", "generators", "surface", "cover", "of_bodies"}) {
    expect_scene_fault("\"" + key + "\":", "\"x\":", "no \"" + key + "\"");
  }
  expect_scene_fault("\"hit\"", "\"overlapping\"", "answer: found \"overlapping\"");
  expect_scene_fault("\"own\"", "\"plane\"", "of_bodies[0].steps[0]: found \"plane\"");
  expect_scene_fault("\"order\":", "\"x\":", "cover: no \"order\"");
  expect_scene_fault("\"steps\":", "\"x\":", "cover: no \"steps\"");
  expect_scene_fault("\"halve\"", "7", "cover.steps[0]: found 7");
  expect_scene_fault("[{\"order\"", "[0,{\"order\"", "of_bodies[0]: found 0");
  expect_scene_fault("[\"1\",\"3\"]", "[\"1\"]", "lower: found an array of 1");
  expect_scene_fault("\"order\":[1,0]", "\"order\":[1,0.5]", "cover.order[1]: found 0.5");
  EXPECT_THAT(fault(R"({"bodies":[{"shape":{"type":"sphere","radius":-1}}]})", true),
              HasSubstr("in.jsonl:1: bodies[0].shape.radius"));
  EXPECT_THAT(fault(R"({"bodies":{}})", true), HasSubstr("in.jsonl:1: bodies: found an object"));
}

TEST_F(MeshCertificates, WhatIsMalformedIsToldWithItsPlace) {
  EXPECT_THAT(fault(ray_text, true), HasSubstr("in.jsonl:1: a certificate before any mesh"));
  EXPECT_THAT(fault(point_text, false), HasSubstr("in.jsonl:1: a certificate before any mesh"));
  EXPECT_THAT(fault("[1]", true), HasSubstr("in.jsonl:1: found an array of 1"));
  EXPECT_THAT(fault(R"({"mesh":{"type":"mesh","vertices":[],"triangles":[[0,1,2]]}})", true),
              HasSubstr("mesh.triangles[0]"));
  EXPECT_THAT(fault(R"({"mesh":{"type":"box","vertices":[],"triangles":[]}})", true),
              HasSubstr("in.jsonl:1: mesh.type: found \"box\"; expected \"mesh\""));
  // Compounds within compounds are read by recursion.
  std::string nested = R"({"shape":{"type":"sphere","radius":1}})";
  for (int i = 0; i < 20000; ++i) {
    nested.insert(0, R"({"shape":{"type":"compound","parts":[)").append("]}}");
  }
  EXPECT_THAT(fault("{\"bodies\":[" + nested + "]}", true),
              HasSubstr("in.jsonl:1: bodies[0].shape.parts[0]"));
  EXPECT_THAT(fault(R"({"mesh":7})", false), HasSubstr("in.jsonl:1: mesh: found 7"));
  for (const std::string key : {"task", "origin", "direction", "t_max", "hit", "triangle", "t"}) {
    expect_fault(ray_text, "\"" + key + "\"", "\"x\"", true, "no \"" + key + "\"");
  }
  expect_fault(ray_text, "7", "-7", true, "ray: found -7");
  expect_fault(ray_text, "closest", "first", true, "task: found \"first\"");
  expect_fault(ray_text, "\"inf\"", "\"far\"", true, "t_max: found \"far\"");
  expect_fault(ray_text, "true", "1", true, "hit: found 1");
  expect_fault(ray_text, "true", "false", true, "\"triangle\" of a miss");
  expect_fault(ray_text, "\"triangle\":0", "\"triangle\":0.5", true, "triangle: found 0.5");
  expect_fault(ray_text, "\"1\",\"3\"", "\"1\"", true, "t: found an array of 1");
  expect_fault(ray_text, "\"3\"", "\"x\"", true, "t[1]: found \"x\"");
  expect_fault(ray_text, "[0.1,", "[", true, "origin: found an array of 2");
  for (const std::string key : {"at", "claim", "triangle", "square"}) {
    expect_fault(point_text, "\"" + key + "\"", "\"x\"", false, "no \"" + key + "\"");
  }
  expect_fault(point_text, "nearest", "near", false, "claim: found \"near\"");
  expect_fault(point_text, "nearest", "inside", false, "no \"winding\"");
  expect_fault(point_text, "nearest\"", "inside\",\"winding\":99999999999", false,
               "winding: found");
  // As a signed number of 64 bits that is -1.
  expect_fault(point_text, "nearest\"", "inside\",\"winding\":18446744073709551615", false,
               "winding: found 18446744073709551615");
  expect_fault(point_text, "nearest\"", "inside\",\"winding\":-2147483648", false,
               "winding: found -2147483648");
  // That number stands for no triangle.
  expect_fault(point_text, "\"triangle\":0", "\"triangle\":4294967295", false,
               "triangle: found 4294967295");
  expect_fault(ray_text, "\"triangle\":0", "\"triangle\":4294967295", true,
               "triangle: found 4294967295");
}

}  // namespace
}  // namespace touchstone
