// Cases with meshes and compounds.
#include "harness/files/concave_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* ball = R"({"shape":{"type":"sphere","radius":1}})";

class ConcaveCases : public ::testing::Test {
 protected:
  // The case whose body a is this one.
  files::ConcaveCase read(const std::string& body) {
    const auto cases = files::read_concave_cases(
        folder.write("in.jsonl", R"({"id":"x","a":)" + body + R"(,"b":)" + ball + "}"));
    EXPECT_EQ(cases.size(), 1u);
    return cases.at(0);
  }
  std::string error(const std::string& shape) {
    return folder.without_path(input_fault([&] { read(R"({"shape":)" + shape + "}"); }));
  }
  TemporaryFolder folder;
};

TEST_F(ConcaveCases, Meshes) {
  const auto c = read(
      R"({"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0.5]],"triangles":[[0,1,2],[2,1,1]]},)"
      R"("translation":[1,2,3],"name":"unknown keys do no harm"})");
  ASSERT_TRUE(c.a.mesh);
  EXPECT_FALSE(c.a.mesh->solid);
  EXPECT_FALSE(c.is_convex);
  EXPECT_EQ(c.a.part_count(), 2u);
  EXPECT_EQ(c.a.mesh->vertices[2], Vec3d(0, 1, 0.5));
  EXPECT_THAT(c.a.mesh->triangles[1], ElementsAre(2, 1, 1));
  EXPECT_EQ(c.pose_a.translation, Vec3d(1, 2, 3));
  EXPECT_EQ(c.b.part_count(), 1u);
  EXPECT_EQ(read(R"({"shape":{"type":"mesh","vertices":[],"triangles":[]}})").a.part_count(), 0u);
}

TEST_F(ConcaveCases, Solids) {
  const char* tetrahedron =
      R"("type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"triangles":[[0,2,1],[0,1,3],[1,2,3])";
  const std::string closed = std::string("{") + tetrahedron + R"(,[0,3,2]],"solid":true})";
  EXPECT_TRUE(read(R"({"shape":)" + closed + "}").a.mesh->solid);
  EXPECT_THAT(error(std::string("{") + tetrahedron + R"(],"solid":true})"),
              HasSubstr("the surface is open at the edge from [0,0,0] to [0,"));
  // The same corner may come as several vertices.
  EXPECT_TRUE(read(R"({"shape":{"type":"mesh","solid":true,"vertices":[[0,0,0],[1,0,0],[0,1,0],)"
                   R"([0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2],[5,4,3]]}})")
                  .a.mesh->solid);
}

TEST_F(ConcaveCases, Compounds) {
  const auto c = read(R"({"shape":{"type":"compound","parts":[)"
                      R"({"shape":{"type":"sphere","radius":1},"translation":[1,0,0]},)"
                      R"({"shape":{"type":"compound","parts":[)"
                      R"({"shape":{"type":"box","half_extents":[1,2,3]},"translation":[0,1,0]},)"
                      R"({"shape":{"type":"capsule","radius":1,"half_length":2,"axis":"x"}}]},)"
                      R"("translation":[0,0,5],"rotation":[0,-1,0,1,0,0,0,0,1]},)"
                      R"({"shape":{"type":"sphere","radius":2}}]},"translation":[7,7,7]})");
  EXPECT_FALSE(c.is_convex);
  ASSERT_EQ(c.a.parts.size(), 4u);
  EXPECT_EQ(c.a.parts[0].pose.translation, Vec3d(1, 0, 0));
  EXPECT_EQ(c.a.parts[1].shape.kind, ShapeKind::box);
  EXPECT_EQ(c.a.parts[1].pose.translation, Vec3d(-1, 0, 5));
  EXPECT_EQ(c.a.parts[2].pose.rotation * Vec3d::UnitZ(), Vec3d(0, 1, 0));
  EXPECT_EQ(c.a.parts[3].shape.radius, 2);
  for (const ConvexPart& part : c.a.parts) EXPECT_EQ(part.rounding, 0);
  EXPECT_EQ(c.pose_a.translation, Vec3d(7, 7, 7));
  EXPECT_TRUE(read(R"({"shape":{"type":"compound","parts":[]}})").a.parts.empty());
}

TEST_F(ConcaveCases, SurfacesInCompoundsAreFlatHullsByTriangle) {
  const auto c = read(
      R"({"shape":{"type":"compound","parts":[{"shape":{"type":"sphere","radius":1}},)"
      R"({"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"triangles":)"
      R"([[0,1,2],[1,2,3],[3,3,3]]},"translation":[0,0,5]},{"shape":{"type":"sphere","radius":2}}]}})");
  ASSERT_EQ(c.a.parts.size(), 5u);
  for (const std::size_t at : {1, 2, 3}) {
    EXPECT_EQ(c.a.parts[at].shape.kind, ShapeKind::hull);
    EXPECT_EQ(c.a.parts[at].pose.translation, Vec3d(0, 0, 5));
  }
  EXPECT_THAT(c.a.parts[2].shape.hull->vertices,
              ::testing::UnorderedElementsAre(Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)));
  EXPECT_EQ(c.a.parts[4].shape.radius, 2);
}

TEST_F(ConcaveCases, SolidsInCompoundsKeepTheirInside) {
  const std::string solid =
      R"({"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],)"
      R"("triangles":[[0,2,1],[0,1,3],[1,2,3],[0,3,2]],"solid":true},)"
      R"("translation":[0,0,5]})";
  const auto c =
      read(R"({"shape":{"type":"compound","parts":[{"shape":{"type":"sphere","radius":1}},)"
           R"({"shape":{"type":"compound","parts":[)" +
           solid + R"(]},"translation":[0,7,0]},{"shape":{"type":"sphere","radius":2}}]}})");
  ASSERT_EQ(c.a.parts.size(), 6u);
  ASSERT_EQ(c.a.surfaces.size(), 1u);
  EXPECT_TRUE(c.a.has_inside());
  EXPECT_EQ(c.a.surfaces[0].first, 1u);
  EXPECT_EQ(c.a.surfaces[0].mesh->triangles.size(), 4u);
  EXPECT_EQ(c.a.parts[4].pose.translation, Vec3d(0, 7, 5));
  EXPECT_EQ(c.a.parts[5].shape.radius, 2);
}

TEST_F(ConcaveCases, AreWrittenAsTheyAreRead) {
  for (
      const char* body :
      {R"({"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0.1]],"triangles":[[0,1,2]]},"translation":[1,2,0.3]})",
       R"({"shape":{"type":"compound","parts":[{"shape":{"type":"sphere","radius":0.1},"translation":[0.7,0,0]}]}})",
       R"({"shape":{"type":"compound","parts":[{"shape":{"type":"sphere","radius":0.1}},{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0.1]],"triangles":[[0,1,2],[2,1,0]],"solid":true},"translation":[1,2,0.3]},{"shape":{"type":"sphere","radius":0.2}}]}})",
       ball}) {
    const files::ConcaveCase first = read(body);
    const auto cases =
        files::read_concave_cases(folder.write("again.jsonl", to_json(first) + "\n"));
    ASSERT_EQ(cases.size(), 1u);
    const files::ConcaveCase& again = cases[0];
    EXPECT_EQ(again.id, "x");
    EXPECT_EQ(again.pose_a.translation, first.pose_a.translation);
    EXPECT_EQ(again.a.part_count(), first.a.part_count());
    EXPECT_EQ(again.a.mesh == nullptr, first.a.mesh == nullptr);
    EXPECT_EQ(again.a.has_inside(), first.a.has_inside());
    EXPECT_EQ(to_json(again), to_json(first));
  }
}

TEST_F(ConcaveCases, RoundedPlacesSaySo) {
  const auto c =
      read(R"({"shape":{"type":"compound","parts":[{"shape":{"type":"compound","parts":[)"
           R"({"shape":{"type":"sphere","radius":1},"translation":[0.1,0.2,0.3]}]},)"
           R"("quaternion_wxyz":[1,0.3,0.2,0.1]}]}})");
  EXPECT_GT(c.a.parts[0].rounding, 0);
  EXPECT_LT(c.a.parts[0].rounding, 1e-13);
}

TEST_F(ConcaveCases, ConvexBodiesAreThoseOfOtherCases) {
  const auto c = read(R"({"shape":{"type":"cone","radius":1,"half_length":2,"axis":"y"},)"
                      R"("translation":[1,2,3]})");
  EXPECT_TRUE(c.is_convex);
  const files::Case convex = files::convex_case(c);
  EXPECT_EQ(convex.shape_a.kind, ShapeKind::cone);
  EXPECT_EQ(convex.pose_a.rotation * Vec3d::UnitZ(), Vec3d(0, 1, 0));
  EXPECT_EQ(convex.pose_a.translation, Vec3d(1, 2, 3));
}

TEST_F(ConcaveCases, Faults) {
  const char* mesh = R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":)";
  const auto with = [&](const std::string& triangles) { return error(mesh + triangles + "}"); };
  EXPECT_THAT(with("[[0,1,3]]"), HasSubstr("a.shape.triangles[0][2]: found 3; expected three "
                                           "numbers of vertices, from 0 to 2"));
  EXPECT_THAT(with("[[0,1,-1]]"), HasSubstr("found -1; expected"));
  EXPECT_THAT(with("[[0,1,1.5]]"), HasSubstr("found 1.5; expected"));
  EXPECT_THAT(with("[[0,1]]"), HasSubstr("found an array of 2; expected three numbers"));
  EXPECT_THAT(with("[[0,1,\"2\"]]"), HasSubstr("found \"2\"; expected"));
  EXPECT_THAT(with("7"), HasSubstr("found 7; expected an array of triangles"));
  EXPECT_THAT(with("[],\"solid\":1"), HasSubstr("found 1; expected true or false"));
  EXPECT_THAT(error(R"({"type":"mesh","vertices":[[0,0]],"triangles":[]})"),
              HasSubstr("expected an array of 3 numbers"));
  EXPECT_THAT(error(R"({"type":"mesh","vertices":[[0,0,NaN]],"triangles":[]})"),
              HasSubstr("in.jsonl:1"));
  EXPECT_THAT(error(R"({"type":"mesh","vertices":[[0,0,1e999]],"triangles":[]})"),
              HasSubstr("in.jsonl:1"));
  EXPECT_THAT(error(R"({"type":"mesh","vertices":[]})"), HasSubstr("no \"triangles\""));
  EXPECT_THAT(error(R"({"type":"mesh","vertices":[],"triangles":[[0,0,0]]})"),
              HasSubstr("expected no triangle"));
  EXPECT_THAT(error(R"({"type":"compound"})"), HasSubstr("no \"parts\""));
  EXPECT_THAT(error(R"({"type":"compound","parts":[{"shape":{"type":"blob"}}]})"),
              HasSubstr("halfspace, mesh, compound"));
  EXPECT_THAT(error(R"({"type":"compound","parts":[{"translation":[0,0,0]}]})"),
              HasSubstr("a.shape.parts[0]: no \"shape\""));
  EXPECT_THAT(
      error(
          R"({"type":"compound","parts":[{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]],"solid":true}}]})"),
      HasSubstr("a.shape.parts[0].shape: \"solid\" is true, and the surface is open"));
  EXPECT_THAT(error(R"({"type":"teapot"})"), HasSubstr("found \"teapot\""));
}

}  // namespace
}  // namespace touchstone
