// Certificates of the oracle as text, in the format of results/certificates.md.
#include <array>
#include <charconv>
#include <cstdio>

#include "algorithms/api/conversions.h"
#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::v1 {
namespace {

using oracle::Certificate;

// A value, or the values of an array or object, each of them text of JSON.
std::string number(double x) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), x);
  return {digits.data(), end};  // the shortest that is read as x again
}
std::string in_quotes(std::string_view text) { return '"' + std::string(text) + '"'; }

template <class List, class Text>
std::string array(const List& list, const Text& text) {
  std::string all;
  for (const auto& item : list) all += (all.empty() ? "" : ",") + text(item);
  return '[' + all + ']';
}
std::string array(const Vec3d& v) { return array(std::array{v.x(), v.y(), v.z()}, number); }

std::string shape_text(const touchstone::Shape& shape) {
  const auto with = [&](const std::string& sizes) {
    return "{\"type\":" + in_quotes(to_string(shape.kind)) + ',' + sizes + '}';
  };
  const std::string radius = "\"radius\":" + number(shape.radius);
  switch (shape.kind) {
    case ShapeKind::sphere: return with(radius);
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: return with(radius + ",\"half_length\":" + number(shape.half_length));
    case ShapeKind::box: return with("\"half_extents\":" + array(shape.half_extents));
    case ShapeKind::ellipsoid: return with("\"radii\":" + array(shape.radii));
    case ShapeKind::hull:
      return with("\"vertices\":" +
                  array(shape.hull->vertices, [](const Vec3d& v) { return array(v); }));
    case ShapeKind::halfspace: break;
  }
  return with("\"normal\":" + array(shape.normal) + ",\"offset\":" + number(shape.offset));
}

std::string body_text(const touchstone::Shape& shape, const Pose& pose) {
  const Vec3 &x = pose.x_axis, &y = pose.y_axis, &z = pose.z_axis, &t = pose.translation;
  const std::array rows = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  return "{\"shape\":" + shape_text(shape) +
         ",\"translation\":" + array(std::array{t.x, t.y, t.z}, number) +
         ",\"rotation\":" + array(rows, number) + '}';
}

std::string root_text(const oracle::SignedRoot& root) {
  return "{\"sign\":" + std::to_string(root.sign) +
         ",\"numerator\":" + in_quotes(root.numerator.str()) +
         ",\"denominator\":" + in_quotes(root.denominator.str()) + '}';
}

std::string hexadecimal(long double x) {
  std::array<char, 64> text;
  const int size = std::snprintf(text.data(), text.size(), "%La", x);
  return in_quotes({text.data(), static_cast<std::size_t>(size)});
}
std::string generator_text(const oracle::Generator& generator) {
  if (generator.vertex >= 0) return std::to_string(generator.vertex);
  return array(generator.point, hexadecimal);
}
std::string point_text(const oracle::DifferencePoint& point) {
  return std::to_string(point.a) + ',' + std::to_string(point.b);
}

std::string text_of(const Certificate& proof) {
  const auto index = [](std::uint32_t i) { return std::to_string(i); };
  return "\"answer\":" + in_quotes(to_string(proof.answer)) +
         ",\"lower\":" + root_text(proof.lower) + ",\"upper\":" + root_text(proof.upper) +
         ",\"direction\":" +
         array(proof.direction, [](const auto& integer) { return in_quotes(integer.str()); }) +
         ",\"generators_a\":" + array(proof.a, generator_text) +
         ",\"generators_b\":" + array(proof.b, generator_text) + ",\"closest\":" +
         array(proof.closest,
               [](const Certificate::Term& term) {
                 return '[' + point_text(term.point) + ',' + in_quotes(term.weight.str()) + ']';
               }) +
         ",\"surface\":{\"points\":" +
         array(proof.surface.points,
               [](const auto& point) { return '[' + point_text(point) + ']'; }) +
         ",\"triangles\":" +
         array(proof.surface.triangles, [&](const auto& three) { return array(three, index); }) +
         '}';
}

}  // namespace

std::string certificate(const Body& a, const Body& b) {
  check_pose(a.pose);
  check_pose(b.pose);
  const touchstone::Shape &shape_a = data_of(a.shape).shape, &shape_b = data_of(b.shape).shape;
  const oracle::Solid solid_a(shape_a), solid_b(shape_b);
  std::array<touchstone::Pose, 2> poses;
  write_inner(a.pose, poses[0]);
  write_inner(b.pose, poses[1]);
  oracle::Oracle oracle;
  Certificate proof;
  oracle.prove({solid_a, poses[0]}, {solid_b, poses[1]}, proof);
  return "{\"id\":\"pair\",\"encoding\":\"matrix64\",\"a\":" + body_text(shape_a, a.pose) +
         ",\"b\":" + body_text(shape_b, b.pose) + ',' + text_of(proof) + '}';
}

}  // namespace touchstone::v1
