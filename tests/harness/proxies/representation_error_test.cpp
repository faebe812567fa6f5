// Errors of representations against what is known of them, and against plain sampling.
#include <gtest/gtest.h>

#include <numbers>

#include "harness/base/error.h"
#include "tests/harness/proxies/bodies.h"

namespace touchstone {
namespace {

constexpr double pi = std::numbers::pi;

proxies::RepresentationError error_of(const Shape& shape, const std::string& form) {
  return proxies::representation_error(
      shape, nullptr, proxies::represent(shape, nullptr, proxies::parse_representation(form)));
}

Shape ball(double radius) { return round_shape(ShapeKind::sphere, radius, 0, Vec3d::Zero()); }
Shape box(const Vec3d& half) { return round_shape(ShapeKind::box, 0, 0, half); }

TEST(RepresentationError, IsKnownForABall) {
  const proxies::RepresentationError outer = error_of(ball(2), "box");
  EXPECT_NEAR(outer.added, 6 / pi - 1, 1e-12);
  EXPECT_EQ(outer.lost, 0);
  EXPECT_NEAR(outer.hausdorff, 2 * (std::sqrt(3) - 1), 1e-12);
  EXPECT_NEAR(outer.size, 4, 1e-12);
  EXPECT_EQ(outer.volume_deviation, 0);
  const proxies::RepresentationError inner = error_of(ball(2), "box inner");
  EXPECT_EQ(inner.added, 0);
  EXPECT_NEAR(inner.lost, 1 - 2 / (std::sqrt(3) * pi), 1e-9);
  EXPECT_NEAR(inner.hausdorff, 2 - 2 / std::sqrt(3), 1e-9);
  for (const char* exact : {"sphere", "sphere inner", "capsule", "as-given", "hull", "parts"}) {
    EXPECT_NEAR(error_of(ball(2), exact).volume_error(), 0, 1e-12) << exact;
    EXPECT_NEAR(error_of(ball(2), exact).hausdorff, 0, 1e-12) << exact;
  }
}

TEST(RepresentationError, FallsWithTheLevelOfAnIcosphere) {
  double before[3] = {1e9, 1e9, 1e9};
  for (int level = 0; level <= 5; ++level) {
    for (proxies::Side side :
         {proxies::Side::outer, proxies::Side::inner, proxies::Side::nearest}) {
      const proxies::Representation r{proxies::Form::icosphere, side, level};
      const proxies::RepresentationError e = proxies::representation_error(
          ball(0.5), nullptr, proxies::represent(ball(0.5), nullptr, r));
      double& last = before[static_cast<int>(side)];
      EXPECT_LT(e.volume_error(), last) << level;
      last = e.volume_error();
      if (side == proxies::Side::outer) {
        EXPECT_EQ(e.lost, 0);
      }
      if (side == proxies::Side::inner) {
        EXPECT_EQ(e.added, 0);
      }
      if (side == proxies::Side::nearest) {
        EXPECT_NEAR(e.added, e.lost, 6 * e.volume_deviation + 1e-12);
      }
    }
  }
  EXPECT_LT(before[2], before[0]);
  EXPECT_LT(before[2], before[1]);
  EXPECT_LT(before[0], 2e-3);
}

TEST(RepresentationError, IsExactBetweenPolytopesThatCross) {
  proxies::Part turned;
  turned.shape = box(Vec3d::Constant(0.5));
  const double c = std::sqrt(0.5);
  turned.pose.rotation << c, -c, 0, c, c, 0, 0, 0, 1;
  const proxies::RepresentationError e =
      proxies::representation_error(box(Vec3d::Constant(0.5)), nullptr, {turned});
  EXPECT_NEAR(e.lost, 1 - 2 * (std::sqrt(2) - 1), 1e-12);
  EXPECT_NEAR(e.added, e.lost, 1e-12);
  EXPECT_NEAR(e.hausdorff, (std::sqrt(2) - 1) / 2, 1e-12);
  // Two halves make the same body; lines through it tell.
  proxies::Part half[2];
  for (int i : {0, 1}) {
    half[i].shape = box({0.25, 0.5, 0.5});
    half[i].pose.translation.x() = i == 0 ? -0.25 : 0.25;
  }
  const proxies::RepresentationError halves =
      proxies::representation_error(box(Vec3d::Constant(0.5)), nullptr, {half[0], half[1]});
  EXPECT_NEAR(halves.volume_error(), 0, 1e-9);
  EXPECT_LE(halves.hausdorff, halves.hausdorff_deviation);
  const proxies::RepresentationError one =
      proxies::representation_error(box(Vec3d::Constant(0.5)), nullptr, {half[0]});
  EXPECT_NEAR(one.lost, 0.5, 1e-12);
  EXPECT_NEAR(one.hausdorff, 0.5, 1e-12);
}

// What two balls have in common, with their centres d apart and neither inside the other.
double common_volume(double a, double b, double d) {
  if (d >= a + b) return 0;
  const double rest = a + b - d;
  return pi * rest * rest * (d * d + 2 * d * (a + b) - 3 * (a - b) * (a - b)) / (12 * d);
}

// The mean of eight numbers is off by its standard error times a variable of Student's distribution
// with seven degrees of freedom, whose mean square is 7/5.
TEST(RepresentationError, IsOffByItsStandardError) {
  base::Random random(4);
  const auto part_at = [](double radius, const Vec3d& centre) {
    proxies::Part part;
    part.shape = ball(radius);
    part.pose.translation = centre;
    return part;
  };
  constexpr int draws = 40;
  double one = 0, two = 0;
  for (int i = 0; i < draws; ++i) {
    // A ball that crosses the body.
    const double a = random.uniform(0.5, 1), b = random.uniform(0.5, 1);
    const double d = random.uniform(std::abs(a - b) + 0.05, a + b - 0.05);
    const double whole = 4.0 / 3 * pi * a * a * a, other = 4.0 / 3 * pi * b * b * b;
    const proxies::RepresentationError e =
        proxies::representation_error(ball(a), nullptr, {part_at(b, d * random.on_sphere())});
    ASSERT_GT(e.volume_deviation, 0);
    ASSERT_LT(e.volume_deviation, 0.01);
    EXPECT_NEAR(e.added - e.lost, other / whole - 1, 1e-9);
    const double off = e.volume_error() - (whole + other - 2 * common_volume(a, b, d)) / whole;
    one += off * off / (e.volume_deviation * e.volume_deviation);
    // Two that cross each other inside it, one as large as the other.
    const Vec3d from = random.uniform(0.1, 0.35) * random.on_sphere();
    const double r = random.uniform(0.4, 0.6);
    const proxies::RepresentationError f =
        proxies::representation_error(ball(1), nullptr, {part_at(r, from), part_at(r, -from)});
    ASSERT_GT(f.volume_deviation, 0);
    EXPECT_EQ(f.added, 0);
    const double lost = 1 - 2 * r * r * r + common_volume(r, r, 2 * from.norm()) / (4.0 / 3 * pi);
    two += (f.lost - lost) * (f.lost - lost) / (f.volume_deviation * f.volume_deviation);
  }
  for (double squares : {one, two}) {
    EXPECT_GT(std::sqrt(squares / draws), 0.85);
    EXPECT_LT(std::sqrt(squares / draws), 1.6);
  }
}

double support(const Shape& s, const Pose& pose, const Vec3d& direction) {
  const Vec3d n = pose.rotation.transpose() * direction;
  const double disc = s.radius * std::hypot(n.x(), n.y()), along = s.half_length * n.z();
  double far = -1e300;
  switch (s.kind) {
    case ShapeKind::sphere: far = s.radius; break;
    case ShapeKind::capsule: far = std::abs(along) + s.radius; break;
    case ShapeKind::cylinder: far = std::abs(along) + disc; break;
    case ShapeKind::cone: far = std::max(along, disc - along); break;
    case ShapeKind::box: far = s.half_extents.dot(n.cwiseAbs()); break;
    case ShapeKind::ellipsoid: far = s.radii.cwiseProduct(n).norm(); break;
    default:
      for (const Vec3d& v : s.hull->vertices) far = std::max(far, n.dot(v));
  }
  return far + direction.dot(pose.translation);
}

bool is_in(const Shape& s, const Pose& pose, const Vec3d& point) {
  const Vec3d x = pose.rotation.transpose() * (point - pose.translation);
  const double beside = std::hypot(x.x(), x.y()), z = std::abs(x.z());
  switch (s.kind) {
    case ShapeKind::sphere: return x.norm() <= s.radius;
    case ShapeKind::capsule:
      return std::hypot(beside, std::max(0.0, z - s.half_length)) <= s.radius;
    case ShapeKind::cylinder: return beside <= s.radius && z <= s.half_length;
    case ShapeKind::cone:
      return z <= s.half_length && beside * 2 * s.half_length <= s.radius * (s.half_length - x.z());
    case ShapeKind::box: return (x.cwiseAbs().array() <= s.half_extents.array()).all();
    case ShapeKind::ellipsoid: return x.cwiseQuotient(s.radii).norm() <= 1;
    default: break;
  }
  return std::all_of(s.hull->faces.begin(), s.hull->faces.end(), [&](const Hull::Face& f) {
    return f.normal.dot(x - s.hull->vertices[f.loop[0]]) <= 0;
  });
}

// The Hausdorff distance of convex bodies is the greatest difference of their supports; volumes by
// points at random.
TEST(RepresentationError, AgreesWithPlainSampling) {
  base::Random random(11);
  std::vector<NamedShape> bodies;
  for (NamedShape& b : round_shapes()) {
    if (b.name.find(' ') == std::string::npos) bodies.push_back(std::move(b));
  }
  bodies.push_back({"hull", hull_shape(random_points(random, 25, {1, 0.6, 0.4}, {0.2, 0, 0}))});
  int crossing = 0;
  for (const NamedShape& body : bodies) {
    for (const char* form : {"sphere nearest", "box nearest", "capsule nearest", "dop-14 nearest",
                             "hull-8 nearest", "sphere inner", "oriented-box", "capsule"}) {
      const auto parts =
          proxies::represent(body.shape, nullptr, proxies::parse_representation(form));
      const proxies::RepresentationError e =
          proxies::representation_error(body.shape, nullptr, parts);
      SCOPED_TRACE(body.name + ", " + form);
      double far = 0;
      for (int i = 0; i < 3000; ++i) {
        const Vec3d n = random.on_sphere();
        far = std::max(
            far, std::abs(support(body.shape, {}, n) - support(parts[0].shape, parts[0].pose, n)));
      }
      EXPECT_LE(far, e.hausdorff + 1e-9);
      EXPECT_GE(far, 0.9 * e.hausdorff - 0.002);
      int inside = 0, lost = 0, added = 0;
      for (int i = 0; i < 40000; ++i) {
        const Vec3d x =
            2.5 * Vec3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const bool a = is_in(body.shape, {}, x);
        const bool b = is_in(parts[0].shape, parts[0].pose, x);
        inside += a;
        lost += a && !b;
        added += b && !a;
      }
      ASSERT_GT(inside, 30);
      const double room = 4 * std::sqrt(inside);
      EXPECT_NEAR(lost, e.lost * inside, room + 3 * std::sqrt(lost));
      EXPECT_NEAR(added, e.added * inside, room * (1 + e.added) + 3 * std::sqrt(added));
      crossing += e.lost > 0 && e.added > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(crossing, 20);
}

TEST(RepresentationError, OfBoxesAroundAndInsideHullsIsTheirVolume) {
  for (const NamedShape& body : hulls()) {
    if (body.flat) continue;
    SCOPED_TRACE(body.name);
    const Hull& hull = *body.shape.hull;
    double volume = 0;
    for (const Hull::Face& f : hull.faces) {
      for (std::size_t i = 1; i + 1 < f.loop.size(); ++i) {
        const Vec3d a = hull.vertices[f.loop[0]], o = hull.vertices[0];
        volume +=
            (a - o).dot((hull.vertices[f.loop[i]] - o).cross(hull.vertices[f.loop[i + 1]] - o)) / 6;
      }
    }
    for (const char* form : {"box", "oriented-box", "box inner"}) {
      const auto parts =
          proxies::represent(body.shape, nullptr, proxies::parse_representation(form));
      const double part = 8 * parts[0].shape.half_extents.prod();
      const proxies::RepresentationError e =
          proxies::representation_error(body.shape, nullptr, parts);
      EXPECT_NEAR(e.added - e.lost, part / volume - 1, 1e-6 * (1 + part / volume)) << form;
      EXPECT_TRUE(e.added == 0 || e.lost == 0) << form;
    }
  }
}

TEST(RepresentationError, OfAFlatBodyIsInfinite) {
  const Shape flat = hull_shape({{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}});
  EXPECT_TRUE(std::isinf(error_of(flat, "sphere").added));
  EXPECT_EQ(error_of(flat, "hull").volume_error(), 0);
  EXPECT_THROW(error_of(flat, "sphere nearest"), base::InputError);
}

TEST(Representation, NamesAreReadBack) {
  for (const char* text : {"as-given", "sphere", "box inner", "oriented-box nearest", "dop-14",
                           "dop-18 inner", "dop-26", "capsule", "hull-16 inner", "hull", "parts",
                           "parts-12 inner", "mesh", "icosphere-0", "icosphere-5 nearest"}) {
    EXPECT_EQ(to_string(proxies::parse_representation(text)), text);
  }
  for (const char* text :
       {"", "ball", "hull-7", "hull-", "hull-9x", "icosphere-6", "icosphere", "parts-0",
        "sphere outside", "mesh inner", "as-given nearest", "dop-16"}) {
    EXPECT_THROW(proxies::parse_representation(text), base::InputError) << text;
  }
}

TEST(Representation, RefusesWhatThereIsNot) {
  Shape halfspace;
  halfspace.kind = ShapeKind::halfspace;
  EXPECT_EQ(proxies::represent(halfspace, nullptr, {}).size(), 1u);
  EXPECT_THROW(proxies::represent(halfspace, nullptr, {proxies::Form::sphere}), base::InputError);
  EXPECT_THROW(proxies::represent(ball(1), nullptr, {proxies::Form::mesh}), base::InputError);
}

}  // namespace
}  // namespace touchstone
