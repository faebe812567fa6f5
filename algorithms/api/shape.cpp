// Shapes, poses and names of the interface.
#include <atomic>
#include <memory>
#include <utility>

#include "algorithms/api/conversions.h"
#include "algorithms/hull/convex_hull.h"

namespace touchstone::v1 {

Error::Error(const std::string& message) : std::runtime_error(message) {}
Error::Error(const Error&) noexcept = default;
Error::~Error() = default;

const char* version() noexcept { return TOUCHSTONE_VERSION; }

void refuse_moved_shape() {
  throw Error("this shape was moved from; expected one that has a value");
}
void refuse_moved_solver() {
  throw Error("this solver was moved from; expected one that has a value");
}
void refuse_pose() {
  throw Error("found a pose with a number that is infinite or NaN; expected finite ones");
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

namespace {

void check_size(double size, const char* what) {
  if (std::isfinite(size) && size >= 0) return;
  throw Error("found " + std::to_string(size) + " as " + what +
              "; expected a finite number of metres, at least 0");
}

void check_sizes(const Vec3& sizes, const char* what) {
  for (const double size : {sizes.x, sizes.y, sizes.z}) check_size(size, what);
}

std::shared_ptr<const Shape::Data> kept(touchstone::Shape shape) {
  static std::atomic<std::uint64_t> next = 1;
  return std::make_shared<const Shape::Data>(Shape::Data{next.fetch_add(1), std::move(shape)});
}

std::shared_ptr<const Shape::Data> along_z(ShapeKind kind, double radius, double half_length) {
  check_size(radius, "a radius");
  check_size(half_length, "half a length");
  touchstone::Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  return kept(std::move(shape));
}

}  // namespace

Shape Shape::sphere(double radius) { return Shape(along_z(ShapeKind::sphere, radius, 0)); }
Shape Shape::capsule(double radius, double half_length) {
  return Shape(along_z(ShapeKind::capsule, radius, half_length));
}
Shape Shape::cylinder(double radius, double half_length) {
  return Shape(along_z(ShapeKind::cylinder, radius, half_length));
}
Shape Shape::cone(double radius, double half_length) {
  return Shape(along_z(ShapeKind::cone, radius, half_length));
}

Shape Shape::box(const Vec3& half_extents) {
  check_sizes(half_extents, "half an extent");
  touchstone::Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = inner(half_extents);
  return Shape(kept(std::move(shape)));
}

Shape Shape::ellipsoid(const Vec3& radii) {
  check_sizes(radii, "a radius");
  touchstone::Shape shape;
  shape.kind = ShapeKind::ellipsoid;
  shape.radii = inner(radii);
  return Shape(kept(std::move(shape)));
}

Shape Shape::hull(std::span<const Vec3> points) {
  if (points.empty()) throw Error("found a hull of no points; expected at least one");
  std::vector<Vec3d> vertices;
  vertices.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) {
      throw Error("found a number that is infinite or NaN in point " + std::to_string(i) +
                  " of a hull; expected finite ones");
    }
    vertices.push_back(inner(points[i]));
  }
  return Shape(kept(hull_of(std::move(vertices))));
}

Shape Shape::halfspace(const Vec3& normal, double offset) {
  if (!is_finite(normal) || (normal.x == 0 && normal.y == 0 && normal.z == 0)) {
    throw Error("found a normal that is zero, infinite or NaN; expected a finite one");
  }
  if (!std::isfinite(offset))
    throw Error("found an offset that is infinite or NaN; expected a finite one");
  touchstone::Shape shape;
  shape.kind = ShapeKind::halfspace;
  shape.normal = inner(normal);
  shape.offset = offset;
  return Shape(kept(std::move(shape)));
}

Kind Shape::kind() const {
  switch (data_of(*this).shape.kind) {
    case ShapeKind::sphere: return Kind::sphere;
    case ShapeKind::capsule: return Kind::capsule;
    case ShapeKind::box: return Kind::box;
    case ShapeKind::cylinder: return Kind::cylinder;
    case ShapeKind::cone: return Kind::cone;
    case ShapeKind::ellipsoid: return Kind::ellipsoid;
    case ShapeKind::hull: return Kind::hull;
    case ShapeKind::halfspace: break;
  }
  return Kind::halfspace;
}

std::vector<double> Shape::numbers() const {
  const touchstone::Shape& shape = data_of(*this).shape;
  const auto of = [](const Vec3d& v) { return std::vector<double>(v.data(), v.data() + 3); };
  switch (shape.kind) {
    case ShapeKind::sphere: return {shape.radius};
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: return {shape.radius, shape.half_length};
    case ShapeKind::box: return of(shape.half_extents);
    case ShapeKind::ellipsoid: return of(shape.radii);
    case ShapeKind::halfspace: break;
    case ShapeKind::hull: {
      std::vector<double> all;
      for (const Vec3d& v : shape.hull->vertices) all.insert(all.end(), v.data(), v.data() + 3);
      return all;
    }
  }
  std::vector<double> all = of(shape.normal);
  all.push_back(shape.offset);
  return all;
}

Pose Pose::from_quaternion(double w, double x, double y, double z, const Vec3& translation) {
  Eigen::Quaterniond turn(w, x, y, z);
  // The greatest part first, so that no square overflows.
  const double greatest = turn.coeffs().cwiseAbs().maxCoeff();
  if (!std::isfinite(w) || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) ||
      greatest == 0) {
    throw Error("found a quaternion that is zero, infinite or NaN; expected a finite one");
  }
  turn.coeffs() /= greatest;
  turn.normalize();
  const Mat3d matrix = turn.toRotationMatrix();
  return {outer(matrix.col(0)), outer(matrix.col(1)), outer(matrix.col(2)), translation};
}

std::vector<std::string> algorithm_names(std::string_view kind) {
  std::vector<std::string> names;
  const auto add = [&]<class Entry>() {
    for (const Entry& entry : registry::entries<Entry>()) names.push_back(entry.info.name);
  };
  if (kind == "pair") {
    add.operator()<NarrowPhaseEntry>();
  } else if (kind == "cast") {
    add.operator()<CastEntry>();
  } else if (kind == "box") {
    add.operator()<BroadPhaseEntry>();
  } else {
    throw Error("found '" + std::string(kind) +
                "'; expected a kind of algorithm: pair, cast or box");
  }
  return names;
}

}  // namespace touchstone::v1
