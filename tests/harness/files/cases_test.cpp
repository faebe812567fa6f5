#include "harness/files/cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* sphere = R"({"shape":{"type":"sphere","radius":1}})";

// A case whose body a has this shape and these further members.
std::string with_shape(const std::string& shape, const std::string& pose = "") {
  return R"({"id":"x","a":{"shape":)" + shape + pose + R"(},"b":)" + sphere + "}";
}

class Cases : public ::testing::Test {
 protected:
  std::vector<files::Case> read(const std::string& content) {
    return files::read_cases(folder.write("in.jsonl", content));
  }
  // The first body of the only case.
  std::pair<Shape, Pose> body(const std::string& shape, const std::string& pose = "") {
    const std::vector<files::Case> cases = read(with_shape(shape, pose));
    EXPECT_EQ(cases.size(), 1u);
    return {cases.at(0).shape_a, cases.at(0).pose_a};
  }
  std::string error(const std::string& content) {
    return folder.without_path(input_fault([&] { read(content); }));
  }
  std::string shape_error(const std::string& shape, const std::string& pose = "") {
    return error("\n" + with_shape(shape, pose));
  }
  TemporaryFolder folder;
};

TEST_F(Cases, EveryShape) {
  EXPECT_EQ(body(R"({"type":"sphere","radius":2})").first.radius, 2);
  EXPECT_EQ(body(R"({"type":"box","half_extents":[1,2.5,0]})").first.half_extents,
            Vec3d(1, 2.5, 0));
  EXPECT_EQ(body(R"({"type":"ellipsoid","radii":[1,2,3]})").first.radii, Vec3d(1, 2, 3));
  const Shape halfspace = body(R"({"type":"halfspace","normal":[0,0,2],"offset":-1})").first;
  EXPECT_EQ(halfspace.normal, Vec3d(0, 0, 2));
  EXPECT_EQ(halfspace.offset, -1);
  for (const char* kind : {"capsule", "cylinder", "cone"}) {
    const Shape shape =
        body(std::string(R"({"type":")") + kind + R"(","radius":1,"half_length":3})").first;
    EXPECT_EQ(to_string(shape.kind), kind);
    EXPECT_EQ(shape.radius, 1);
    EXPECT_EQ(shape.half_length, 3);
  }
  const Shape hull =
      body(R"({"type":"hull","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1],[0.1,0.1,0.1]]})").first;
  ASSERT_TRUE(hull.hull);
  EXPECT_EQ(hull.hull->vertices.size(), 5u);
  EXPECT_EQ(hull.hull->dimension, 3);
  EXPECT_EQ(hull.hull->faces.size(), 4u);
}

TEST_F(Cases, DegenerateHullsAreGoodInput) {
  EXPECT_EQ(body(R"({"type":"hull","vertices":[[1,2,3]]})").first.hull->dimension, 0);
  EXPECT_EQ(body(R"({"type":"hull","vertices":[[1,2,3],[2,2,3]]})").first.hull->dimension, 1);
  EXPECT_EQ(
      body(R"({"type":"hull","vertices":[[0,0,0],[1,0,0],[0,1,0],[1,1,0]]})").first.hull->dimension,
      2);
}

TEST_F(Cases, Poses) {
  const std::string ball = R"({"type":"sphere","radius":0})";
  EXPECT_EQ(body(ball).second.rotation, Mat3d::Identity());
  EXPECT_EQ(body(ball).second.translation, Vec3d::Zero());
  EXPECT_EQ(body(ball, R"(,"translation":[1e300,-0.1,5])").second.translation,
            Vec3d(1e300, -0.1, 5));
  Mat3d rows;
  rows << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_EQ(body(ball, R"(,"rotation":[1,2,3,4,5,6,7,8,9])").second.rotation, rows);
  EXPECT_EQ(body(ball, R"(,"quaternion_wxyz":[-7,0,0,0])").second.rotation, Mat3d::Identity());
  Mat3d quarter;  // a quarter turn about z
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (const char* scale : {"1", "3", "1e300", "1e-300", "5e-324"}) {
    const std::string q = std::string(R"(,"quaternion_wxyz":[)") + scale + ",0,0," + scale + "]";
    EXPECT_LT((body(ball, q).second.rotation - quarter).norm(), 1e-15) << scale;
  }
}

TEST_F(Cases, AnotherAxisIsTurnedIntoZ) {
  // The tip of a cone along x, y or z in a frame that is no rotation: it is permuted exactly.
  Mat3d frame;
  frame << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9;
  const std::string pose = R"(,"rotation":[0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9])";
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    for (const char* kind : {"capsule", "cylinder", "cone"}) {
      const Mat3d turned = body(std::string(R"({"type":")") + kind +
                                    R"(","radius":1,"half_length":2,"axis":")" + name + "\"}",
                                pose)
                               .second.rotation;
      EXPECT_EQ(turned.col(2), frame.col(axis));
      EXPECT_EQ(turned.col(0), frame.col((axis + 1) % 3));
      EXPECT_EQ(turned.col(1), frame.col((axis + 2) % 3));
    }
  }
}

TEST_F(Cases, LinesAndUnknownKeys) {
  const std::string line =
      with_shape(R"({"type":"sphere","radius":1,"colour":"red"})", R"(,"mass":3)");
  const std::vector<files::Case> cases = read("\xef\xbb\xbf" + line + "\r\n\n  \n" + line);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[1].id, "x");
  EXPECT_EQ(read(R"({"tags":["a"],"expect":null,"source":{},"id":"","a":)" + std::string(sphere) +
                 R"(,"b":)" + sphere + "}")
                .size(),
            1u);
}

TEST_F(Cases, MalformedJson) {
  EXPECT_THAT(error("{}\n{"), StartsWith("in.jsonl:1: no \"a\"; expected the first body"));
  EXPECT_THAT(error(with_shape(R"({"type":"sphere","radius":1})") + "\n\n{\"id\":"),
              StartsWith("in.jsonl:3: malformed JSON: column"));
  EXPECT_THAT(error("nonsense"), StartsWith("in.jsonl:1: malformed JSON: column 2: "));
  EXPECT_THAT(error("{} {}"), StartsWith("in.jsonl:1: malformed JSON"));
  EXPECT_THAT(error("[]"), StartsWith("in.jsonl:1: found an array of 0; expected a case"));
  EXPECT_THAT(error(std::string("\0", 1)), StartsWith("in.jsonl:1: malformed JSON"));
  EXPECT_THAT(error("{\"id\":\"\xff\"}"), StartsWith("in.jsonl:1: malformed JSON"));
  EXPECT_THAT(error(std::string(100000, '[')), StartsWith("in.jsonl:1: malformed JSON"));
  EXPECT_THAT(error(""), StartsWith("in.jsonl:1: no case; expected"));
  EXPECT_THAT(error("\n\n"), StartsWith("in.jsonl:1: no case; expected"));
}

TEST_F(Cases, FilesThatCannotBeRead) {
  EXPECT_THROW(files::read_cases(folder.path()), base::InputError);
  try {
    files::read_cases(folder.path() / "none.jsonl");
    FAIL();
  } catch (const base::InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("none.jsonl: No such file or directory"));
  }
}

TEST_F(Cases, MissingParts) {
  const std::string s = sphere;
  EXPECT_EQ(error(R"({"id":5,"a":)" + s + R"(,"b":)" + s + "}"),
            "in.jsonl:1: id: found 5; expected a string");
  EXPECT_EQ(error(R"({"id":"x","b":)" + s + "}"), "in.jsonl:1: no \"a\"; expected the first body");
  EXPECT_EQ(error(R"({"id":"x","a":)" + s + R"(,"b":null})"),
            "in.jsonl:1: b: found null; expected an object with a shape and its pose");
  EXPECT_THAT(error(R"({"id":"x","a":)" + s + R"(,"b":{}})"),
              StartsWith("in.jsonl:1: b: no \"shape\"; expected an object"));
  EXPECT_THAT(shape_error("{}"), StartsWith("in.jsonl:2: a.shape: no \"type\""));
  EXPECT_EQ(shape_error(R"({"type":"torus"})"),
            "in.jsonl:2: a.shape.type: found \"torus\"; expected one of sphere, capsule, box, "
            "cylinder, cone, ellipsoid, hull, halfspace");
  EXPECT_EQ(shape_error(R"({"type":"sphere"})"),
            "in.jsonl:2: a.shape: no \"radius\"; expected metres");
}

TEST_F(Cases, WrongValues) {
  EXPECT_EQ(shape_error(R"({"type":"sphere","radius":-1})"),
            "in.jsonl:2: a.shape.radius: found -1; expected a number >= 0");
  EXPECT_EQ(shape_error(R"({"type":"sphere","radius":"1"})"),
            "in.jsonl:2: a.shape.radius: found \"1\"; expected a number");
  EXPECT_EQ(shape_error(R"({"type":"box","half_extents":[1,-0.5,1]})"),
            "in.jsonl:2: a.shape.half_extents[1]: found -0.5; expected a number >= 0");
  EXPECT_EQ(
      shape_error(R"({"type":"box","half_extents":[1,1]})"),
      "in.jsonl:2: a.shape.half_extents: found an array of 2; expected an array of 3 numbers");
  EXPECT_EQ(
      shape_error(R"({"type":"box","half_extents":[1,1,1,1]})"),
      "in.jsonl:2: a.shape.half_extents: found an array of 4; expected an array of 3 numbers");
  EXPECT_EQ(shape_error(R"({"type":"box","half_extents":[1,null,1]})"),
            "in.jsonl:2: a.shape.half_extents[1]: found null; expected a number");
  EXPECT_THAT(shape_error(R"({"type":"ellipsoid","radii":[1,1,-1]})"), HasSubstr("radii[2]"));
  EXPECT_THAT(shape_error(R"({"type":"capsule","radius":1,"half_length":-2})"),
              HasSubstr("half_length: found -2"));
  EXPECT_EQ(shape_error(R"({"type":"cone","radius":1,"half_length":2,"axis":"w"})"),
            "in.jsonl:2: a.shape.axis: found \"w\"; expected \"x\", \"y\" or \"z\"");
  EXPECT_THAT(shape_error(R"({"type":"halfspace","normal":[0,0,-0.0],"offset":1})"),
              HasSubstr("a.shape.normal: the zero vector"));
  EXPECT_THAT(
      shape_error(R"({"type":"hull","vertices":[]})"),
      HasSubstr("a.shape.vertices: found an array of 0; expected an array of at least one"));
  EXPECT_EQ(shape_error(R"({"type":"hull","vertices":[[0,0,0],[1,"y",0]]})"),
            "in.jsonl:2: a.shape.vertices[1][1]: found \"y\"; expected a number");
  for (const char* number : {"NaN", "Infinity", "-Infinity", "1e999", "0x10", "+1", ".5"}) {
    EXPECT_THAT(shape_error(std::string(R"({"type":"sphere","radius":)") + number + "}"),
                StartsWith("in.jsonl:2: malformed JSON"))
        << number;
  }
}

TEST_F(Cases, WrongPoses) {
  const std::string ball = R"({"type":"sphere","radius":1})";
  EXPECT_THAT(shape_error(ball, R"(,"quaternion_wxyz":[0,0,0,0])"),
              StartsWith("in.jsonl:2: a.quaternion_wxyz: the zero quaternion"));
  EXPECT_THAT(shape_error(ball, R"(,"quaternion_wxyz":[1,0,0])"), HasSubstr("array of 4 numbers"));
  EXPECT_THAT(shape_error(ball, R"(,"rotation":[[1,0,0],[0,1,0],[0,0,1]])"),
              HasSubstr("a.rotation: found an array of 3; expected an array of 9 numbers"));
  EXPECT_THAT(shape_error(ball, R"(,"rotation":[1,0,0,0,1,0,0,0,1],"quaternion_wxyz":[1,0,0,0])"),
              HasSubstr("a: both \"rotation\" and \"quaternion_wxyz\""));
  EXPECT_THAT(shape_error(ball, R"(,"translation":[1,2])"), HasSubstr("a.translation: found"));
  EXPECT_THAT(shape_error(ball, R"(,"translation":{"x":1})"), HasSubstr("found an object"));
}

TEST_F(Cases, WhatIsWrittenComesBackBitForBit) {
  std::mt19937_64 random(3);
  const auto any = [&] {
    for (;;) {
      const double value = std::bit_cast<double>(random());
      if (std::isfinite(value)) return value;
    }
  };
  const auto vector = [&] {
    const double x = any(), y = any(), z = any();
    return Vec3d(x, y, z);
  };
  const auto same = [](const auto& a, const auto& b) {
    return std::equal(a.data(), a.data() + a.size(), b.data(), [](double x, double y) {
      return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    });
  };
  std::uniform_real_distribution<double> moderate(-1, 1);
  for (int i = 0; i < 400; ++i) {
    files::Case c;
    c.id = "quote \" and \xc3\xa9";
    c.shape_a.kind = all_shape_kinds[static_cast<std::size_t>(i) % all_shape_kinds.size()];
    c.shape_a.radius = std::abs(any());
    c.shape_a.half_length = std::abs(any());
    c.shape_a.half_extents = vector().cwiseAbs();
    c.shape_a.radii = vector().cwiseAbs();
    c.shape_a.normal = vector();
    c.shape_a.offset = any();
    std::vector<Vec3d> points;
    for (int k = 0; k < 5; ++k) {
      const double x = moderate(random), y = moderate(random), z = moderate(random);
      points.emplace_back(x, y, z);
    }
    c.shape_a.hull = make_hull(points);
    for (int k = 0; k < 9; ++k) c.pose_b.rotation(k) = any();
    c.pose_b.translation = vector();
    c.pose_a.translation = -Vec3d::Zero();
    const files::Case back = read(files::to_json(c)).at(0);
    EXPECT_EQ(back.id, c.id);
    ASSERT_EQ(back.shape_a.kind, c.shape_a.kind);
    EXPECT_TRUE(same(back.pose_a.rotation, c.pose_a.rotation));
    EXPECT_TRUE(same(back.pose_b.rotation, c.pose_b.rotation));
    EXPECT_TRUE(same(back.pose_a.translation, c.pose_a.translation));
    EXPECT_TRUE(same(back.pose_b.translation, c.pose_b.translation));
    switch (c.shape_a.kind) {
      case ShapeKind::box:
        EXPECT_TRUE(same(back.shape_a.half_extents, c.shape_a.half_extents));
        break;
      case ShapeKind::ellipsoid: EXPECT_TRUE(same(back.shape_a.radii, c.shape_a.radii)); break;
      case ShapeKind::halfspace:
        EXPECT_TRUE(same(back.shape_a.normal, c.shape_a.normal));
        EXPECT_EQ(back.shape_a.offset, c.shape_a.offset);
        break;
      case ShapeKind::hull:
        for (std::size_t k = 0; k < points.size(); ++k) {
          EXPECT_TRUE(same(back.shape_a.hull->vertices.at(k), points[k]));
        }
        break;
      default:
        EXPECT_EQ(back.shape_a.radius, c.shape_a.radius);
        if (c.shape_a.kind != ShapeKind::sphere) {
          EXPECT_EQ(back.shape_a.half_length, c.shape_a.half_length);
        }
    }
  }
}

}  // namespace
}  // namespace touchstone
