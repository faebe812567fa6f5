// Collects, changes and rounds the numbers of a case.
#include "harness/grade/failures/case_numbers.h"

#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include "algorithms/hull/convex_hull.h"

namespace touchstone::grade {
namespace {

void collect(Shape& shape, std::vector<Vec3d>& vertices, std::vector<double*>& all) {
  const auto add = [&](Vec3d& v) {
    for (double& x : v) all.push_back(&x);
  };
  switch (shape.kind) {
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: all.push_back(&shape.half_length); [[fallthrough]];
    case ShapeKind::sphere: all.push_back(&shape.radius); break;
    case ShapeKind::box: add(shape.half_extents); break;
    case ShapeKind::ellipsoid: add(shape.radii); break;
    case ShapeKind::hull:
      vertices = shape.hull->vertices;
      for (Vec3d& v : vertices) add(v);
      break;
    case ShapeKind::halfspace:
      add(shape.normal);
      all.push_back(&shape.offset);
      break;
  }
}

// All lengths and coordinates of a case, in an order that depends only on its shapes. Those of
// hulls are in `vertices`, from which the hulls must be rebuilt.
struct Numbers {
  std::array<std::vector<Vec3d>, 2> vertices;
  std::vector<double*> all;

  explicit Numbers(files::Case& c) {
    collect(c.shape_a, vertices[0], all);
    collect(c.shape_b, vertices[1], all);
    for (Pose* pose : {&c.pose_a, &c.pose_b}) {
      for (double& x : pose->translation) all.push_back(&x);
    }
  }
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;
};

}  // namespace

std::vector<double> numbers_of(files::Case c) {
  std::vector<double> values;
  for (const double* x : Numbers(c).all) values.push_back(*x);
  return values;
}

bool change_numbers(files::Case& c, const NumberChange& change) {
  Numbers numbers(c);
  bool differs = false;
  for (std::size_t i = 0; i < numbers.all.size(); ++i) {
    const double before = *numbers.all[i];
    *numbers.all[i] = change(i, before);
    differs = differs || *numbers.all[i] != before;
  }
  for (std::size_t body = 0; body < 2; ++body) {
    Shape& shape = body == 0 ? c.shape_a : c.shape_b;
    if (shape.kind == ShapeKind::hull && shape.hull->vertices != numbers.vertices[body]) {
      shape = hull_of(std::move(numbers.vertices[body]));
    }
  }
  return differs;
}

double rounded(double x, int digits) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), x,
                                          std::chars_format::scientific, digits - 1);
  double result = x;
  if (error == std::errc()) std::from_chars(text.data(), end, result);
  return result;
}

int digits_of(double x) {
  if (x == 0) return 0;
  std::array<char, 40> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific);
  int digits = 0;
  for (const char* at = text.data(); at != end && *at != 'e'; ++at)
    digits += *at >= '0' && *at <= '9';
  return digits;
}

}  // namespace touchstone::grade
