#include "harness/files/certificates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using oracle::Integer;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Two spheres that are 1 apart.
constexpr const char* plain =
    R"({"id":"x","encoding":"matrix64","a":{"shape":{"type":"sphere","radius":1}},)"
    R"("b":{"shape":{"type":"cone","radius":1,"half_length":2},"translation":[3,0,0]},)"
    R"("answer":"separated","lower":{"sign":1,"numerator":"9","denominator":"1"},)"
    R"("upper":{"sign":1,"numerator":"81","denominator":"9"},"direction":["-1","0","0"],)"
    R"("generators_a":[0],"generators_b":[["0x0p+0","-0x1.8p-1","0x0p+0"]],)"
    R"("closest":[[0,0,"7"]],"surface":{"points":[[0,0]],"triangles":[[0,1,2]]}})";

class Certificates : public ::testing::Test {
 protected:
  std::vector<files::StoredCertificate> read(const std::string& content) {
    std::vector<files::StoredCertificate> all;
    lines.clear();
    files::read_certificates(folder.write("in.jsonl", content),
                             [&](const files::StoredCertificate& stored, std::int64_t line) {
                               all.push_back(stored);
                               lines.push_back(line);
                             });
    return all;
  }
  // The message for the plain certificate with one part of its text replaced.
  std::string error(const std::string& part, const std::string& other) {
    std::string text = plain;
    const auto place = text.find(part);
    if (place == std::string::npos) throw std::logic_error(part);
    text.replace(place, part.size(), other);
    return folder.without_path(input_fault([&] { read(text); }));
  }
  TemporaryFolder folder;
  std::vector<std::int64_t> lines;
};

TEST_F(Certificates, EveryPart) {
  const auto all = read(std::string(plain) + "\n\n" + plain + "\n");
  EXPECT_THAT(lines, ElementsAre(1, 3));
  ASSERT_EQ(all.size(), 2u);
  const files::StoredCertificate& stored = all[1];
  EXPECT_EQ(stored.id, "x");
  EXPECT_EQ(stored.encoding, "matrix64");
  EXPECT_EQ(stored.shape_a.kind, ShapeKind::sphere);
  EXPECT_EQ(stored.shape_b.half_length, 2);
  EXPECT_EQ(stored.pose_b.translation, Vec3d(3, 0, 0));
  EXPECT_FALSE(stored.quaternion_a);
  const oracle::Certificate& c = stored.certificate;
  EXPECT_EQ(c.answer, Answer::separated);
  EXPECT_EQ(c.upper.sign, 1);
  EXPECT_EQ(c.upper.numerator, 81);
  EXPECT_EQ(c.upper.denominator, 9);
  EXPECT_EQ(c.direction[0], -1);
  ASSERT_EQ(c.a.size(), 1u);
  EXPECT_EQ(c.a[0].vertex, 0);
  ASSERT_EQ(c.b.size(), 1u);
  EXPECT_EQ(c.b[0].vertex, -1);
  EXPECT_EQ(c.b[0].point[1], -0.75L);
  ASSERT_EQ(c.closest.size(), 1u);
  EXPECT_EQ(c.closest[0].weight, 7);
  EXPECT_EQ(c.surface.points.size(), 1u);
  EXPECT_EQ(c.surface.triangles.at(0)[2], 2u);
}

TEST_F(Certificates, WrongIntegers) {
  for (const char* text : {"", "-", "-0", "007", "0x10", "1.5", "1e5", " 1", "1 ", "+1", "--1"}) {
    EXPECT_THAT(error(R"("7")", std::string("\"") + text + "\""),
                StartsWith("in.jsonl:1: closest[0][2]: found \"" + std::string(text) +
                           "\"; expected an integer in a string"));
  }
  EXPECT_EQ(error(R"("7")", "7"),
            "in.jsonl:1: closest[0][2]: found 7; expected an integer in a string, such as \"-12\"");
  EXPECT_THAT(error(R"("numerator":"9")", R"("numerator":9)"), HasSubstr("lower.numerator: "));
  EXPECT_THAT(error(R"("sign":1)", R"("sign":2)"),
              HasSubstr("lower.sign: found 2; expected -1, 0 or 1"));
  EXPECT_THAT(error(R"("sign":1)", R"("sign":1.0)"), HasSubstr("lower.sign: found 1.0"));
  EXPECT_THAT(error(R"(["-1","0","0"])", R"(["-1","0"])"),
              HasSubstr("direction: found an array of 2; expected an array of 3 integers"));
}

TEST_F(Certificates, WrongIndices) {
  for (const char* text : {"-1", "4294967296", "0.0", "null", "\"0\"", "1e3"}) {
    EXPECT_THAT(error(R"([[0,0,"7"]])", std::string("[[0,") + text + ",\"7\"]]"),
                HasSubstr("closest[0][1]: found "));
    EXPECT_THAT(error("[[0,1,2]]", std::string("[[0,1,") + text + "]]"),
                HasSubstr("surface.triangles[0][2]: found "));
    EXPECT_THAT(error(R"("generators_a":[0])", std::string("\"generators_a\":[") + text + "]"),
                HasSubstr("generators_a[0]: found "));
  }
  EXPECT_THAT(error(R"("generators_a":[0])", R"("generators_a":[2147483648])"),
              HasSubstr("generators_a[0]: found 2147483648; expected the number of a vertex"));
  EXPECT_THAT(error(R"([[0,0,"7"]])", "[[0,0]]"),
              HasSubstr("closest[0]: found an array of 2; expected two indices and a weight"));
  EXPECT_THAT(error("[[0,1,2]]", "[[0,1,2,3]]"), HasSubstr("expected an array of 3 indices"));
}

TEST_F(Certificates, WrongPoints) {
  for (const char* text : {"nan", "inf", "0x", "1.5", "", "0x1p+0 ", " 0x1p+0", "+0x1p+0",
                           "0x1p+99999", "0x1p-99999", "0xnan"}) {
    EXPECT_THAT(error("-0x1.8p-1", text), HasSubstr("generators_b[0][1]: found "));
  }
  EXPECT_THAT(error(R"("-0x1.8p-1")", "1"),
              HasSubstr("found 1; expected a hexadecimal number in a string"));
  EXPECT_THAT(error(R"("-0x1.8p-1",)", ""), HasSubstr("generators_b[0]: found an array of 2"));
}

TEST_F(Certificates, WrongParts) {
  for (const char* key :
       {"id", "encoding", "a", "b", "answer", "lower", "upper", "direction", "generators_a",
        "generators_b", "closest", "surface", "points", "triangles", "denominator"}) {
    const std::string quoted = std::string("\"") + key + "\"";
    EXPECT_THAT(error(quoted + ":", "\"other\":"), HasSubstr("no " + quoted + "; expected "));
    EXPECT_THAT(error(quoted + ":", quoted + ":null,\"other\":"), HasSubstr("found null; expec"));
  }
  EXPECT_THAT(error("separated", "apart"), HasSubstr("answer: found \"apart\"; expected separat"));
  EXPECT_THAT(error("sphere", "torus"), HasSubstr("a.shape.type: found \"torus\""));
  EXPECT_EQ(folder.without_path(input_fault([&] { read("\n"); })),
            "in.jsonl:1: no certificate; expected one JSON object a line");
  EXPECT_THAT(input_fault([&] { read(std::string(plain) + "\n{"); }),
              HasSubstr("in.jsonl:2: malformed JSON"));
}

TEST_F(Certificates, WrongQuaternions) {
  const auto with = [&](const std::string& pose) {
    return error(R"("translation":[3,0,0])", pose);
  };
  EXPECT_EQ(with(R"("quaternion_exact":[0,2,0,0])"), "");
  EXPECT_THAT(with(R"("quaternion_exact":[0,0,-0.0,0])"),
              HasSubstr("b.quaternion_exact: the zero quaternion"));
  EXPECT_THAT(with(R"("quaternion_exact":[0,1,0])"), HasSubstr("b.quaternion_exact: found"));
  EXPECT_THAT(with(R"("quaternion_exact":[1,0,0,0],"rotation":[1,0,0,0,1,0,0,0,1])"),
              HasSubstr("b: both \"quaternion_exact\" and \"rotation\""));
  EXPECT_THAT(with(R"("quaternion_exact":[1,0,0,0],"quaternion_wxyz":[1,0,0,0])"),
              HasSubstr("b: both \"quaternion_exact\" and \"quaternion_wxyz\""));
  EXPECT_THAT(error(R"("half_length":2},"translation":[3,0,0])",
                    R"("half_length":2,"axis":"x"},"quaternion_exact":[1,0,0,0])"),
              HasSubstr("b: another axis than z"));
}

TEST_F(Certificates, WhatIsWrittenComesBackBitForBit) {
  std::mt19937_64 random(5);
  const auto any = [&] {
    for (;;) {
      const double value = std::bit_cast<double>(random());
      if (std::isfinite(value)) return value;
    }
  };
  const auto below = [&](std::uint64_t count) { return random() % count; };
  const auto integer = [&] {
    Integer value = below(2);
    for (std::uint64_t k = below(60); k > 0; --k) value = (value << 64) + random();
    return below(2) == 0 ? value : Integer(-value);
  };
  const auto index = [&] { return static_cast<std::uint32_t>(random()); };
  const auto generators = [&] {
    std::vector<oracle::Generator> list(below(4));
    for (oracle::Generator& generator : list) {
      if (below(2) == 0) {
        generator.vertex = static_cast<std::int32_t>(below(1ull << 31));
        continue;
      }
      for (long double& x : generator.point) {
        x = std::ldexp(static_cast<long double>(random()), static_cast<int>(below(32000)) - 16440);
        if (below(2) == 0) x = -x;
      }
    }
    return list;
  };
  const auto quaternion = [&]() -> std::optional<std::array<double, 4>> {
    if (below(2) == 0) return {};
    return {{any(), any(), -0.0, any()}};
  };
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  for (int i = 0; i < 300; ++i) {
    files::StoredCertificate stored;
    stored.id = "\xe2\x82\xac \"";
    stored.encoding = "quat64";
    stored.shape_a.radius = std::abs(any());
    stored.shape_b.kind = ShapeKind::hull;
    stored.shape_b.hull = make_hull({Vec3d(0.1, 0.2, -0.3), Vec3d(1e-300, -0.0, 5e-324)});
    stored.pose_a.translation = {any(), any(), any()};
    stored.quaternion_a = quaternion();
    stored.quaternion_b = quaternion();
    if (!stored.quaternion_a) stored.pose_a.rotation(1, 2) = any();
    oracle::Certificate& c = stored.certificate;
    c.answer = static_cast<Answer>(below(4));
    c.lower = {static_cast<int>(below(3)) - 1, integer(), integer()};
    c.upper = oracle::SignedRoot::infinity(1);
    c.a = generators();
    c.b = generators();
    c.direction = {integer(), integer(), integer()};
    for (std::uint64_t k = below(4); k > 0; --k) {
      c.closest.push_back({{index(), index()}, integer()});
      c.surface.points.push_back({index(), index()});
      c.surface.triangles.push_back({index(), index(), index()});
    }
    const auto all = read(files::to_json(stored));
    ASSERT_EQ(all.size(), 1u);
    const files::StoredCertificate& back = all[0];
    EXPECT_EQ(back.id, stored.id);
    EXPECT_EQ(back.encoding, stored.encoding);
    EXPECT_TRUE(same(back.shape_a.radius, stored.shape_a.radius));
    EXPECT_EQ(back.shape_b.hull->vertices, stored.shape_b.hull->vertices);
    EXPECT_TRUE(std::signbit(back.shape_b.hull->vertices[1].y()));
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(same(back.pose_a.translation[k], stored.pose_a.translation[k]));
    }
    EXPECT_TRUE(same(back.pose_a.rotation(1, 2), stored.pose_a.rotation(1, 2)));
    EXPECT_EQ(back.quaternion_a, stored.quaternion_a);
    EXPECT_EQ(back.quaternion_b, stored.quaternion_b);
    EXPECT_TRUE(!back.quaternion_b || std::signbit((*back.quaternion_b)[2]));
    const oracle::Certificate& d = back.certificate;
    EXPECT_EQ(d.answer, c.answer);
    for (const auto root : {&oracle::Certificate::lower, &oracle::Certificate::upper}) {
      EXPECT_EQ((d.*root).sign, (c.*root).sign);
      EXPECT_EQ((d.*root).numerator, (c.*root).numerator);
      EXPECT_EQ((d.*root).denominator, (c.*root).denominator);
    }
    EXPECT_EQ(d.direction, c.direction);
    for (const auto list : {&oracle::Certificate::a, &oracle::Certificate::b}) {
      ASSERT_EQ((d.*list).size(), (c.*list).size());
      for (std::size_t k = 0; k < (c.*list).size(); ++k) {
        EXPECT_EQ((d.*list)[k].vertex, (c.*list)[k].vertex);
        EXPECT_EQ((d.*list)[k].point, (c.*list)[k].point);
      }
    }
    ASSERT_EQ(d.closest.size(), c.closest.size());
    for (std::size_t k = 0; k < c.closest.size(); ++k) {
      EXPECT_EQ(d.closest[k].point, c.closest[k].point);
      EXPECT_EQ(d.closest[k].weight, c.closest[k].weight);
    }
    EXPECT_EQ(d.surface.points, c.surface.points);
    EXPECT_EQ(d.surface.triangles, c.surface.triangles);
    EXPECT_EQ(files::to_json(back), files::to_json(stored));
  }
}

}  // namespace
}  // namespace touchstone
