// Converts a case exactly to each encoding, and finds exact answers when they are first asked for.
#include "harness/grade/true_case.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "algorithms/core/nearest_float.h"

namespace touchstone::grade {
namespace {

double rounded(double x) { return nearest_float(x); }
Vec3d rounded(const Vec3d& v) { return nearest_float(v); }
Mat3d rounded(const Mat3d& m) {
  Mat3d out;
  for (int k = 0; k < 3; ++k) out.col(k) = rounded(Vec3d(m.col(k)));
  return out;
}

// Moves the shape by -centre; a hull's vertices become relative to the centre.
Shape centred(const Shape& shape, const Vec3d& centre) {
  Shape out = shape;
  if (shape.kind == ShapeKind::hull) {
    auto hull = std::make_shared<Hull>();
    for (const Vec3d& v : shape.hull->vertices) hull->vertices.push_back(v - centre);
    out.hull = std::move(hull);
  }
  return out;
}

Shape rounded(const Shape& shape) {
  Shape out = shape;
  out.radius = rounded(shape.radius);
  out.half_length = rounded(shape.half_length);
  out.half_extents = rounded(shape.half_extents);
  out.radii = rounded(shape.radii);
  if (shape.kind == ShapeKind::halfspace) {
    const UnitHalfspace unit(shape);
    out.normal = rounded(unit.normal);
    out.offset = rounded(unit.offset);
  }
  if (shape.kind == ShapeKind::hull) {
    auto hull = std::make_shared<Hull>();
    for (const Vec3d& v : shape.hull->vertices) hull->vertices.push_back(rounded(v));
    out.hull = std::move(hull);
  }
  return out;
}

Pose rounded(const Pose& pose) { return {rounded(pose.rotation), rounded(pose.translation)}; }

template <class Scalar>
std::array<double, 4> quaternion_of(const Mat3d& rotation) {
  const Eigen::Quaternion<Scalar> q = to_quaternion<Scalar>(rotation.cast<Scalar>());
  return {static_cast<double>(q.w()), static_cast<double>(q.x()), static_cast<double>(q.y()),
          static_cast<double>(q.z())};
}

oracle::Body make_body(const oracle::Solid& solid, const Pose& pose,
                       const std::optional<std::array<double, 4>>& quaternion) {
  return quaternion ? oracle::Body(solid, *quaternion, pose.translation)
                    : oracle::Body(solid, pose);
}

bool is_finite(const oracle::Body& body) {
  const oracle::Solid& solid = *body.solid;
  const auto finite = [](double x) { return std::isfinite(x); };
  return body.matrix.allFinite() && body.translation.allFinite() && finite(solid.radius) &&
         solid.extents.allFinite() && solid.normal.allFinite() && finite(solid.offset) &&
         std::ranges::all_of(solid.vertices, [](const Vec3d& v) { return v.allFinite(); }) &&
         (!body.quaternion || std::ranges::all_of(*body.quaternion, finite));
}

}  // namespace

files::Case rounded_to_floats(files::Case c) {
  for (Shape* shape : {&c.shape_a, &c.shape_b}) *shape = rounded(*shape);
  for (Pose* pose : {&c.pose_a, &c.pose_b}) *pose = rounded(*pose);
  return c;
}

struct EncodedPair::Parts {
  Shape shape_a, shape_b;
  Pose pose_a, pose_b;
  std::optional<std::array<double, 4>> quaternion_a, quaternion_b;

  Parts(const files::Case& c, Encoding encoding)
      : shape_a(c.shape_a), shape_b(c.shape_b), pose_a(c.pose_a), pose_b(c.pose_b) {
    switch (encoding) {
      case Encoding::as_given: break;
      case Encoding::float32:
      case Encoding::quaternion_float32:
        shape_a = rounded(shape_a);
        shape_b = rounded(shape_b);
        pose_a = rounded(pose_a);
        pose_b = rounded(pose_b);
        break;
      case Encoding::relative:
      case Encoding::float32_relative: {
        const Vec3d centre_a = encoding_centre(shape_a);
        const Vec3d centre_b = encoding_centre(shape_b);
        Vec3d origin;
        pose_b.translation = offset_between(c.pose_a, centre_a, c.pose_b, centre_b, origin);
        pose_a.translation.setZero();
        shape_a = centred(shape_a, centre_a);
        shape_b = centred(shape_b, centre_b);
        if (encoding == Encoding::relative) break;
        shape_a = rounded(shape_a);
        shape_b = rounded(shape_b);
        pose_a = rounded(pose_a);
        pose_b = rounded(pose_b);
        break;
      }
      case Encoding::quaternion: break;
    }
    if (encoding == Encoding::quaternion) {
      quaternion_a = quaternion_of<double>(pose_a.rotation);
      quaternion_b = quaternion_of<double>(pose_b.rotation);
    } else if (encoding == Encoding::quaternion_float32) {
      quaternion_a = quaternion_of<float>(pose_a.rotation);
      quaternion_b = quaternion_of<float>(pose_b.rotation);
    }
  }
};

EncodedPair::EncodedPair(const files::Case& c, Encoding encoding)
    : EncodedPair(Parts(c, encoding)) {}

EncodedPair::EncodedPair(const Parts& parts)
    : solid_a_(parts.shape_a),
      solid_b_(parts.shape_b),
      a_(make_body(solid_a_, parts.pose_a, parts.quaternion_a)),
      b_(make_body(solid_b_, parts.pose_b, parts.quaternion_b)),
      finite_(touchstone::grade::is_finite(a_) && touchstone::grade::is_finite(b_)) {}

TrueCase::Truth::Truth(const files::Case& c, Encoding encoding, oracle::Oracle& oracle)
    : pair(c, encoding) {
  if (pair.is_finite()) {
    measure = oracle.measure(pair.a(), pair.b());
  } else {
    measure.lower = -std::numeric_limits<double>::infinity();
    measure.upper = std::numeric_limits<double>::infinity();
  }
}

TrueCase::TrueCase(files::Case c, std::uint64_t index, oracle::Oracle& oracle)
    : case_(std::move(c)), index_(index), oracle_(&oracle) {}

const TrueCase::Truth& TrueCase::truth(Encoding encoding) {
  auto& slot = truths_[static_cast<std::size_t>(encoding)];
  if (!slot) slot = std::make_unique<Truth>(case_, encoding, *oracle_);
  return *slot;
}

}  // namespace touchstone::grade
