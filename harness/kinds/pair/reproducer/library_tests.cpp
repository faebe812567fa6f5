// The beginnings of tests in the language of FCL, Bullet, libccd and ODE.
#include "harness/kinds/pair/reproducer/library_tests.h"

#include <array>

namespace touchstone::kinds {
namespace {

constexpr std::string_view fcl_preamble = R"test(#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace {

using Body = std::shared_ptr<fcl::CollisionGeometryd>;
constexpr fcl::GJKSolverType solver = fcl::GJKSolverType::SOLVER;

Body sphere(double r) { return std::make_shared<fcl::Sphered>(r); }
Body capsule(double r, double h) { return std::make_shared<fcl::Capsuled>(r, 2 * h); }
Body box(double x, double y, double z) { return std::make_shared<fcl::Boxd>(2 * x, 2 * y, 2 * z); }
Body cylinder(double r, double h) { return std::make_shared<fcl::Cylinderd>(r, 2 * h); }
Body cone(double r, double h) { return std::make_shared<fcl::Coned>(r, 2 * h); }
Body ellipsoid(double x, double y, double z) { return std::make_shared<fcl::Ellipsoidd>(x, y, z); }
Body hull(const std::vector<std::array<double, 3>>& vertices, const std::vector<int>& faces) {
  auto points = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto& v : vertices) points->emplace_back(v[0], v[1], v[2]);
  int count = 0;
  for (std::size_t i = 0; i < faces.size(); i += faces[i] + 1) ++count;
  return std::make_shared<fcl::Convexd>(points, count, std::make_shared<std::vector<int>>(faces));
}

struct Pose {
  std::array<double, 9> rows;
  std::array<double, 3> translation;
};
fcl::Transform3d transform(const Pose& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.linear()(i, j) = pose.rows[3 * i + j];
    result.translation()[i] = pose.translation[i];
  }
  return result;
}

struct Expected {
  int side;  // 1 separated, -1 overlapping, 0 either
  double number, tolerance;
  bool has_distance, has_depth;
};

void check(const char* id, const Body& a, const Pose& pose_a, const Body& b,
           const Pose& pose_b, const Expected& expected) {
  SCOPED_TRACE(id);
  const fcl::Transform3d at_a = transform(pose_a), at_b = transform(pose_b);
  fcl::CollisionRequestd request(1, true);
  request.gjk_solver_type = solver;
  fcl::CollisionResultd result;
  const bool contact = fcl::collide(a.get(), at_a, b.get(), at_b, request, result) > 0;
  if (expected.side != 0) EXPECT_EQ(contact, expected.side < 0);
  if (expected.has_depth && contact)
    EXPECT_NEAR(-result.getContact(0).penetration_depth, expected.number, expected.tolerance);
  if (!expected.has_distance) return;
  fcl::DistanceRequestd distance_request(true);
  distance_request.gjk_solver_type = solver;
  fcl::DistanceResultd nearest;
  EXPECT_NEAR(fcl::distance(a.get(), at_a, b.get(), at_b, distance_request, nearest),
              expected.number, expected.tolerance);
}

}  // namespace
)test";

constexpr std::string_view bullet_preamble =
    R"test(#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <vector>

using Body = std::shared_ptr<btConvexShape>;

// No shape has a margin beyond its surface.
template <class Shape>
Body bare(std::shared_ptr<Shape> shape, const btVector3& dimensions) {
  shape->setMargin(0);
  shape->setImplicitShapeDimensions(dimensions);
  return shape;
}
Body sphere(double r) { return std::make_shared<btSphereShape>(btScalar(r)); }
Body capsule(double r, double h) {
  return std::make_shared<btCapsuleShapeZ>(btScalar(r), btScalar(2 * h));
}
Body box(double x, double y, double z) {
  const btVector3 half{btScalar(x), btScalar(y), btScalar(z)};
  return bare(std::make_shared<btBoxShape>(half), half);
}
Body cylinder(double r, double h) {
  const btVector3 half{btScalar(r), btScalar(r), btScalar(h)};
  return bare(std::make_shared<btCylinderShapeZ>(half), half);
}
Body cone(double r, double h) {
  auto shape = std::make_shared<btConeShapeZ>(btScalar(r), btScalar(2 * h));
  shape->setMargin(0);
  return shape;
}
Body hull(const std::vector<std::array<double, 3>>& vertices, const std::vector<int>&) {
  auto shape = std::make_shared<btConvexHullShape>();
  for (const auto& v : vertices)
    shape->addPoint({btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}, false);
  shape->setMargin(0);
  shape->recalcLocalAabb();
  return shape;
}

struct Pose {
  std::array<double, 9> rows;
  std::array<double, 3> translation;
};
btTransform transform(const Pose& pose) {
  const auto& r = pose.rows;
  const auto& t = pose.translation;
  const auto own = [](double x) { return btScalar(x); };
  return btTransform(btMatrix3x3(own(r[0]), own(r[1]), own(r[2]), own(r[3]), own(r[4]), own(r[5]),
                                 own(r[6]), own(r[7]), own(r[8])),
                     btVector3(own(t[0]), own(t[1]), own(t[2])));
}

struct Deepest : btDiscreteCollisionDetectorInterface::Result {
  double distance = std::numeric_limits<double>::infinity();
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3&, const btVector3&, btScalar depth) override {
    if (depth < distance) distance = depth;
  }
};

// Negative if they overlap.
double signed_distance(const Body& a, const Pose& pose_a, const Body& b, const Pose& pose_b) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver epa;
  btGjkPairDetector detector(a.get(), b.get(), &simplex, &epa);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = transform(pose_a);
  input.m_transformB = transform(pose_b);
  Deepest deepest;
  detector.getClosestPoints(input, deepest, nullptr);
  return deepest.distance;
}
)test";

constexpr std::string_view libccd_preamble = R"test(#include <ccd/ccd.h>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

using Vector = std::array<double, 3>;

// How far a shape reaches along a direction, without the ball around it: the furthest point, in its own axes.
struct Body {
  enum Kind { point, segment, block, round, tip, egg, points } kind;
  double radius = 0, half = 0;
  Vector extents = {};
  std::vector<Vector> vertices = {};
  Vector centre = {};
};
Body sphere(double r) { return {Body::point, r, 0}; }
Body capsule(double r, double h) { return {Body::segment, r, h}; }
Body box(double x, double y, double z) { return {Body::block, 0, 0, {x, y, z}}; }
Body cylinder(double r, double h) { return {Body::round, r, h}; }
Body cone(double r, double h) { return {Body::tip, r, h}; }
Body ellipsoid(double x, double y, double z) { return {Body::egg, 0, 0, {x, y, z}}; }
Body hull(const std::vector<Vector>& vertices, const std::vector<int>&) {
  Body body{Body::points, 0, 0, {}, vertices};
  for (const Vector& v : vertices) {
    for (int k = 0; k < 3; ++k) body.centre[k] += v[k] / double(vertices.size());
  }
  return body;
}

struct Pose {
  std::array<double, 9> rows;
  Vector translation;
};
struct Placed {
  const Body& body;
  const Pose& pose;
};

Vector furthest(const Body& body, const Vector& d) {
  const double across = std::hypot(d[0], d[1]), end = std::copysign(body.half, d[2]);
  const Vector rim =
      across > 0 ? Vector{body.radius * d[0] / across, body.radius * d[1] / across, 0}
                 : Vector{};
  switch (body.kind) {
    case Body::point: return {};
    case Body::segment: return {0, 0, end};
    case Body::block:
      return {std::copysign(body.extents[0], d[0]), std::copysign(body.extents[1], d[1]),
              std::copysign(body.extents[2], d[2])};
    case Body::round: return {rim[0], rim[1], end};
    case Body::tip:
      return body.half * d[2] > rim[0] * d[0] + rim[1] * d[1] - body.half * d[2]
                 ? Vector{0, 0, body.half}
                 : Vector{rim[0], rim[1], -body.half};
    case Body::egg: {
      const Vector& e = body.extents;
      const Vector s = {e[0] * d[0], e[1] * d[1], e[2] * d[2]};
      const double length = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
      return length > 0 ? Vector{e[0] * s[0] / length, e[1] * s[1] / length,
                                 e[2] * s[2] / length}
                        : Vector{};
    }
    case Body::points: break;
  }
  const auto along = [&](const Vector& v) { return v[0] * d[0] + v[1] * d[1] + v[2] * d[2]; };
  Vector best = body.vertices[0];
  for (const Vector& v : body.vertices) {
    if (along(v) > along(best)) best = v;
  }
  return best;
}

Vector in_world(const Pose& pose, const Vector& v) {
  Vector result = pose.translation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i] += pose.rows[3 * i + j] * v[j];
  }
  return result;
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const Placed& placed = *static_cast<const Placed*>(object);
  const Vector d = {direction->v[0], direction->v[1], direction->v[2]};
  Vector local = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) local[j] += placed.pose.rows[3 * i + j] * d[i];
  }
  Vector point = in_world(placed.pose, furthest(placed.body, local));
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const bool has_ball = placed.body.kind == Body::point || placed.body.kind == Body::segment;
  for (int k = 0; k < 3 && has_ball && length > 0; ++k)
    point[k] += placed.body.radius * d[k] / length;
  ccdVec3Set(out, point[0], point[1], point[2]);
}
void centre(const void* object, ccd_vec3_t* out) {
  const Placed& placed = *static_cast<const Placed*>(object);
  const Vector point = in_world(placed.pose, placed.body.centre);
  ccdVec3Set(out, point[0], point[1], point[2]);
}

// Negative if they overlap, without a depth -1; libccd has no distance, so that it is then infinite.
double signed_distance(const Body& a, const Pose& pose_a, const Body& b, const Pose& pose_b) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.center1 = ccd.center2 = centre;
  ccd.max_iterations = 1000;
  const Placed placed_a{a, pose_a}, placed_b{b, pose_b};
  ccd_real_t depth = 1;
  ccd_vec3_t direction, position;
  (void)direction, (void)position;
  const bool contact = SOLVER;
  return contact ? -depth : std::numeric_limits<double>::infinity();
}
)test";

constexpr std::string_view ode_preamble = R"test(#include <ode/ode.h>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

const bool is_ready =
    dInitODE2(0) != 0 && dAllocateODEDataForThread(dAllocateMaskAll) != 0;

struct Body {
  dGeomID geom;
  std::array<double, 3> sides;  // of a box, else 0
};
Body sphere(double r) { return {dCreateSphere(nullptr, dReal(r)), {}}; }
Body capsule(double r, double h) { return {dCreateCapsule(nullptr, dReal(r), dReal(2 * h)), {}}; }
Body box(double x, double y, double z) {
  return {dCreateBox(nullptr, dReal(2 * x), dReal(2 * y), dReal(2 * z)), {2 * x, 2 * y, 2 * z}};
}

struct Pose {
  std::array<double, 9> rows;
  std::array<double, 3> translation;
};

// Negative if they overlap; ODE has no distance, so that it is then infinite.
double signed_distance(const Body& a, const Pose& pose_a, const Body& b, const Pose& pose_b) {
  const auto place = [](const Body& body, const Pose& pose) {
    dMatrix3 rotation = {};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rotation[4 * i + j] = dReal(pose.rows[3 * i + j]);
    }
    dGeomSetPosition(body.geom, dReal(pose.translation[0]), dReal(pose.translation[1]),
                     dReal(pose.translation[2]));
    dGeomSetRotation(body.geom, rotation);
  };
  place(a, pose_a);
  place(b, pose_b);
  dContactGeom contacts[8];
  const int count = dCollide(a.geom, b.geom, 8, contacts, sizeof contacts[0]);
  double depth = 0;
  for (int k = 0; k < count; ++k) depth = std::fmax(depth, contacts[k].depth);
  return count > 0 ? -depth : std::numeric_limits<double>::infinity();
}
)test";

constexpr std::string_view fcl_flags =
    "$(pkg-config --cflags --libs fcl) -lccd -lgtest -lgtest_main";
constexpr std::string_view bullet_flags =
    "$(pkg-config --cflags bullet) -lBulletCollision -lLinearMath";

}  // namespace

std::span<const LibraryTest> library_tests() {
  static constexpr std::array<LibraryTest, 7> tests = {
      {{"fcl-libccd", fcl_flags, fcl_preamble, "GST_LIBCCD", false, true},
       {"fcl-indep", fcl_flags, fcl_preamble, "GST_INDEP", false, true},
       {"bullet-gjk-epa", bullet_flags, bullet_preamble, "", true, false},
       {"libccd-gjk", "-lccd", libccd_preamble, "ccdGJKIntersect(&placed_a, &placed_b, &ccd) != 0",
        false, false},
       {"libccd-epa", "-lccd", libccd_preamble,
        "ccdGJKPenetration(&placed_a, &placed_b, &ccd, &depth, &direction, &position) == 0", false,
        false},
       {"libccd-mpr", "-lccd", libccd_preamble,
        "ccdMPRPenetration(&placed_a, &placed_b, &ccd, &depth, &direction, &position) == 0", false,
        false},
       {"ode", "-lode", ode_preamble, "", false, false}}};
  return tests;
}

}  // namespace touchstone::kinds
