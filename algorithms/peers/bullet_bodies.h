// Used by Bullet's narrow phases and contact manifolds: Bullet's shapes for ours, the transforms of
// a query, and the conversion of a contact into an outcome.
//
// Shapes have no margin beyond their surface: 0 for hull, box, cylinder, cone and ellipsoid
// (Bullet's default of 0.04 rounds them); a sphere's and a capsule's margin is their radius, by
// Bullet's design. Bullet has no ellipsoid: ours is a btConvexInternalShape with its own support
// function. The two poses are relative to the first body's centre, subtracted in double before the
// conversion to Bullet's scalars. Hulls are centred on the mean of their vertices, because MPR
// needs an interior point at the origin.
// Half-spaces are not supported: Bullet's plane has no support function, and its own algorithm for
// it is one support call of the other body, not GJK, SAT or MPR. Tolerances and iteration caps
// (except MPR's) are compiled into Bullet and stay as they are; each algorithm states them.
//
// Bullet's scalar depends on how Bullet was built, so this file is compiled a second time, in
// double, into a module (bullet_double.h).
#pragma once

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btConvexPolyhedron.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btDiscreteCollisionDetectorInterface.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "algorithms/narrow_phase.h"
#include "algorithms/peers/bullet_double/bullet_double.h"

namespace touchstone::bullet {

// The bits that Bullet gets, for NarrowPhaseEntry::encoding.
inline Encoding encoding(ShapeKind, ShapeKind, Task, Precision scalar) {
  return scalar == Precision::float32 ? Encoding::float32_relative : Encoding::relative;
}

inline btVector3 to_bullet(const Vec3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
inline btMatrix3x3 to_matrix(const Mat3d& m) {
  const auto entry = [&](int i, int j) { return static_cast<btScalar>(m(i, j)); };
  return {entry(0, 0), entry(0, 1), entry(0, 2),  //
          entry(1, 0), entry(1, 1), entry(1, 2),  //
          entry(2, 0), entry(2, 1), entry(2, 2)};
}
inline Vec3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

class Ellipsoid final : public btConvexInternalShape {
 public:
  explicit Ellipsoid(const btVector3& radii) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    m_implicitShapeDimensions = radii;
  }
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const btVector3 scaled = m_implicitShapeDimensions * direction;
    const btScalar length = scaled.length();
    if (!(length > 0)) return {0, 0, 0};
    return m_implicitShapeDimensions * scaled / length;
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions,
                                                         btVector3* vertices,
                                                         int count) const override {
    std::transform(directions, directions + count, vertices,
                   [&](const btVector3& d) { return localGetSupportingVertexWithoutMargin(d); });
  }
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "Ellipsoid"; }
};

// The Bullet object for a bound shape.
struct Body {
  std::unique_ptr<btConvexShape> shape;  // null if the algorithm does not support the shape
  Vec3d centre = Vec3d::Zero();          // centre of the Bullet shape, in body coordinates
  const btConvexPolyhedron* polyhedron =
      nullptr;  // used by SAT and clipping; null if there is none
};

// setMargin recomputes the dimensions from rounded sums; this restores the given ones.
template <class BulletShape>
std::unique_ptr<btConvexShape> without_margin(std::unique_ptr<BulletShape> shape,
                                              const btVector3& dimensions) {
  shape->setMargin(0);
  shape->setImplicitShapeDimensions(dimensions);
  return shape;
}

inline Body make_body(const Shape& shape) {
  const auto radius = static_cast<btScalar>(shape.radius);
  const auto height = static_cast<btScalar>(2 * shape.half_length);
  Body body;
  switch (shape.kind) {
    case ShapeKind::sphere: body.shape = std::make_unique<btSphereShape>(radius); break;
    case ShapeKind::capsule: body.shape = std::make_unique<btCapsuleShapeZ>(radius, height); break;
    case ShapeKind::box: {
      const btVector3 half = to_bullet(shape.half_extents);
      body.shape = without_margin(std::make_unique<btBoxShape>(half), half);
      break;
    }
    case ShapeKind::cylinder: {
      const btVector3 half(radius, radius, static_cast<btScalar>(shape.half_length));
      body.shape = without_margin(std::make_unique<btCylinderShapeZ>(half), half);
      break;
    }
    case ShapeKind::cone:  // Bullet's origin is at half of the height too, the tip at +z
      body.shape = std::make_unique<btConeShapeZ>(radius, height);
      body.shape->setMargin(0);
      break;
    case ShapeKind::ellipsoid:
      body.shape = std::make_unique<Ellipsoid>(to_bullet(shape.radii));
      body.shape->setMargin(0);
      break;
    case ShapeKind::hull: {
      body.centre = encoding_centre(shape);
      auto hull = std::make_unique<btConvexHullShape>();
      for (const Vec3d& v : shape.hull->vertices) hull->addPoint(to_bullet(v - body.centre), false);
      hull->setMargin(0);
      hull->recalcLocalAabb();
      body.shape = std::move(hull);
      break;
    }
    case ShapeKind::halfspace: break;
  }
  return body;
}

// Makes the faces and edges of boxes and hulls that Bullet's SAT and clipping need.
inline void make_polyhedron(Body& body) {
  if (!body.shape || !body.shape->isPolyhedral()) return;
  auto& shape = static_cast<btPolyhedralConvexShape&>(*body.shape);
  constexpr int most_vertices = 32767;  // Bullet's vertex indices are short integers
  const int count = shape.getNumVertices();
  if (count > most_vertices) return;
  // Bullet reads uninitialised memory if its hull has fewer faces than a tetrahedron. This computes
  // the hull once more to exclude that.
  std::vector<btVector3> vertices(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) shape.getVertex(i, vertices[static_cast<std::size_t>(i)]);
  btConvexHullComputer hull;
  hull.compute(&vertices[0].getX(), sizeof(btVector3), count, 0, 0);
  if (hull.faces.size() < 4 || !shape.initializePolyhedralFeatures()) return;
  const btConvexPolyhedron* features = shape.getConvexPolyhedron();
  if (std::isfinite(features->m_localCenter.length2())) body.polyhedron = features;
}

// One query. The transforms are relative to `origin`, the world position of a's centre (metres).
struct Query {
  Task task;
  const Body& a;
  const Body& b;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;  // transforms and a cut-off
                                                                  // distance
  Vec3d origin;
};

// A contact as Bullet reports it: the normal points from b to a, and distance < 0 is the depth.
struct Contact {
  btVector3 normal_on_b, point_on_b;
  btScalar distance;
};

// Collects the deepest contact, or the nearest if none is deep.
struct Deepest final : btDiscreteCollisionDetectorInterface::Result {
  std::optional<Contact> contact;

  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal_on_b, const btVector3& point_on_b,
                       btScalar distance) override {
    if (!contact || distance < contact->distance) contact = {normal_on_b, point_on_b, distance};
  }
};

inline Answer sign_of(btScalar distance) {
  if (distance > 0) return Answer::separated;
  if (distance < 0) return Answer::overlapping;
  return distance == 0 ? Answer::touching : Answer::unknown;
}

inline void report(const Contact& contact, const Query& query, Outcome& outcome) {
  outcome.answer = sign_of(contact.distance);
  if (outcome.answer == Answer::unknown) outcome.status = Status::degenerate;
  const bool asked = asks_for_number(query.task, outcome.answer);
  const bool takes_side =
      outcome.answer == Answer::separated || outcome.answer == Answer::overlapping;
  if (!asked && takes_side) return;
  clear_numbers(outcome);
  if (!asked || outcome.answer == Answer::unknown) return;
  const Vec3d normal = -from_bullet(contact.normal_on_b);
  outcome.distance = contact.distance;
  outcome.normal = normal;
  outcome.witness_b = query.origin + from_bullet(contact.point_on_b);
  outcome.witness_a = outcome.witness_b - outcome.distance * normal;
  // MPR reports a zero direction if the surfaces touch.
  if (normal.isZero()) outcome.normal.setConstant(Outcome::none);
}

// The contract around one of Bullet's algorithms, which provides prepare(Body&), called once for
// each shape, and answer(Query&, Outcome&).
template <class Algorithm>
class BulletNarrowPhase final : public NarrowPhase {
 public:
  explicit BulletNarrowPhase(const NarrowPhaseSettings& settings)
      : algorithm_(make_algorithm(settings)) {}

  void bind(std::span<const Shape> shapes) override {
    bodies_.clear();
    bodies_.reserve(shapes.size());
    for (const Shape& shape : shapes) {
      bodies_.push_back(make_body(shape));
      Algorithm::prepare(bodies_.back());
    }
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
      const Pose& at_a = batch.pairs.poses[first];
      const Pose& at_b = batch.pairs.poses[second];
      Query query{task,
                  bodies_[batch.pairs.shape_of[first]],
                  bodies_[batch.pairs.shape_of[second]],
                  {},
                  Vec3d::Zero()};
      const Vec3d offset = offset_between(at_a, query.a.centre, at_b, query.b.centre, query.origin);
      query.input.m_transformA = btTransform(to_matrix(at_a.rotation), btVector3(0, 0, 0));
      query.input.m_transformB = btTransform(to_matrix(at_b.rotation), to_bullet(offset));
      outcomes[i].iterations = outcomes[i].support_calls = -1;
      algorithm_.answer(query, outcomes[i]);
    }
  }

 private:
  static Algorithm make_algorithm(const NarrowPhaseSettings& settings) {
    if constexpr (std::is_constructible_v<Algorithm, const NarrowPhaseSettings&>) {
      return Algorithm(settings);
    } else {
      return Algorithm();
    }
  }

  Algorithm algorithm_;
  std::vector<Body> bodies_;
};

// Makes the algorithm named `name`, for NarrowPhaseEntry::make.
template <class Algorithm>
std::unique_ptr<NarrowPhase> make(const char* name, const NarrowPhaseSettings& settings) {
  if constexpr (std::is_same_v<btScalar, float>) {
    if (settings.scalar == Precision::float64 && has_double) {
      return make_double<NarrowPhase>(name, settings);
    }
  }
  return std::make_unique<BulletNarrowPhase<Algorithm>>(settings);
}

}  // namespace touchstone::bullet
