// Bullet's narrow phases: GJK with EPA, box-box SAT, polyhedral SAT, MPR.
// Paper:   none; Bullet 3.24. GJK: G. van den Bergen, JGT 1999, and EPA (N. Presson), in
//          btGjkPairDetector. Box-box: R. Smith's ODE, btBoxBoxDetector. SAT: P. Terdiman's, in
//          btPolyhedralContactClipping. MPR: G. Snethen, Game Programming Gems 7, by way of
//          libccd, btMprPenetration.h.
// Departs: no margins beyond the shape: 0 for hull, box, cylinder, cone and ellipsoid (Bullet's
//          default of 0.04 rounds them); a sphere's and a capsule's margin is their radius, by
//          Bullet's design. Ellipsoids, which Bullet does not have, are a btConvexInternalShape
//          with a support function of its own. The two poses are given relative to the first body's
//          centre, subtracted in double before they become floats, and hulls are centred on the
//          mean of their vertices, as MPR needs an interior point at the origin.
//          Bullet has no boolean GJK: intersect asks for the distance with a cut-off at touch.
//          SAT's depth is measured with btConvexPolyhedron::project along the axis found, since
//          findSeparatingAxis keeps it to itself. MPR's boolean stops after the refined portal.
//          Half-spaces are not offered: Bullet's plane has no support function, and its own
//          algorithm for it is one support call of the other body, none of these four. Tolerances,
//          and iteration caps but MPR's, are compiled into Bullet and stay its own.
// Fails:   all thresholds are absolute lengths, 1e-2 to 1e-6: GJK tells bodies of millimetres that
//          overlap apart, and takes gaps of 1e-5 between larger ones for overlaps.
//          EPA takes its first tetrahedron for the answer where the horizon degenerates. Box-box
//          takes the depth at its deepest contact. SAT works on vertices that its hull computer
//          has put on a grid. MPR's depth is along the portal, an upper bound, and its points are
//          one in the overlap and that point moved, so they are not on the surfaces.
// Cost:    GJK, MPR: support calls linear in the vertices; box-box constant; SAT O(E^2 V).
#include "algorithms/narrow_phase.h"
#if TOUCHSTONE_BUILT
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btConvexPolyhedron.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btMprPenetration.h>
#include <BulletCollision/NarrowPhaseCollision/btPolyhedralContactClipping.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

static_assert(sizeof(btScalar) == sizeof(float), "the scalars offered below are Bullet's");

btVector3 to_bullet(const Vec3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
btMatrix3x3 to_matrix(const Mat3d& m) {
  const auto entry = [&](int i, int j) { return static_cast<btScalar>(m(i, j)); };
  return {entry(0, 0), entry(0, 1), entry(0, 2),  //
          entry(1, 0), entry(1, 1), entry(1, 2),  //
          entry(2, 0), entry(2, 1), entry(2, 2)};
}
Vec3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

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

// What is bound for a shape.
struct Body {
  std::unique_ptr<btConvexShape> shape;            // null where the algorithm has no such shape
  Vec3d centre = Vec3d::Zero();                    // of the Bullet shape, in body coordinates
  const btConvexPolyhedron* polyhedron = nullptr;  // SAT's; null where there is none
};

// setMargin recomputes the dimensions from sums, which rounds; so they are set again.
template <class BulletShape>
std::unique_ptr<btConvexShape> without_margin(std::unique_ptr<BulletShape> shape,
                                              const btVector3& dimensions) {
  shape->setMargin(0);
  shape->setImplicitShapeDimensions(dimensions);
  return shape;
}

Body make_body(const Shape& shape) {
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
      const std::vector<Vec3d>& vertices = shape.hull->vertices;
      for (const Vec3d& v : vertices) body.centre += v / static_cast<double>(vertices.size());
      auto hull = std::make_unique<btConvexHullShape>();
      for (const Vec3d& v : vertices) hull->addPoint(to_bullet(v - body.centre), false);
      hull->setMargin(0);
      hull->recalcLocalAabb();
      body.shape = std::move(hull);
      break;
    }
    case ShapeKind::halfspace: break;
  }
  return body;
}

// One query. The transforms are relative to `origin`, the world position of a's centre.
struct Query {
  Task task;
  const Body& a;
  const Body& b;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;  // transforms, and a cut-off
  Vec3d origin;
};

// What Bullet says of a pair: the normal points from b to a, and distance < 0 is the depth.
struct Contact {
  btVector3 normal_on_b, point_on_b;
  btScalar distance;
};

// The deepest, or else nearest, contact that is reported.
struct Deepest final : btDiscreteCollisionDetectorInterface::Result {
  std::optional<Contact> contact;

  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal_on_b, const btVector3& point_on_b,
                       btScalar distance) override {
    if (!contact || distance < contact->distance) contact = {normal_on_b, point_on_b, distance};
  }
};

Answer sign_of(btScalar distance) {
  if (distance > 0) return Answer::separated;
  if (distance < 0) return Answer::overlapping;
  return distance == 0 ? Answer::touching : Answer::unknown;
}

void report(const Contact& contact, const Query& query, Outcome& outcome) {
  outcome.answer = sign_of(contact.distance);
  if (outcome.answer == Answer::unknown) outcome.status = Status::degenerate;
  const bool asked = (query.task == Task::distance && contact.distance >= 0) ||
                     (query.task == Task::penetration && contact.distance <= 0);
  if (!asked) return;
  const Vec3d normal = -from_bullet(contact.normal_on_b);
  outcome.distance = contact.distance;
  outcome.normal = normal;
  outcome.witness_b = query.origin + from_bullet(contact.point_on_b);
  outcome.witness_a = outcome.witness_b - outcome.distance * normal;
  // MPR has no direction where the surfaces touch.
  if (normal.isZero()) outcome.normal.setConstant(Outcome::none);
}

struct GjkEpa {
  static void prepare(Body&) {}

  void answer(Query& query, Outcome& outcome) {
    const btConvexShape* a = query.a.shape.get();
    const btConvexShape* b = query.b.shape.get();
    btGjkPairDetector detector(a, b, &simplex_, &epa_);
    if (query.task != Task::distance) {
      // Bullet compares the cores, without margins, with this. Touching bodies are kept.
      const btScalar margins = a->getMargin() + b->getMargin();
      query.input.m_maximumDistanceSquared =
          margins * margins + std::numeric_limits<btScalar>::min();
    }
    Deepest deepest;
    detector.getClosestPoints(query.input, deepest, nullptr);
    outcome.iterations = detector.m_curIter;
    outcome.status = Status::not_reported;
    if (deepest.contact) {
      report(*deepest.contact, query, outcome);
    } else if (query.task != Task::distance && found_distance(detector.m_lastUsedMethod)) {
      outcome.answer = Answer::separated;  // beyond the cut-off
    } else {
      // GJK came to its cap of 1000, or EPA found nothing where GJK says that they overlap.
      constexpr int cap = 1000;
      outcome.answer = Answer::unknown;
      outcome.status = detector.m_curIter > cap ? Status::not_converged : Status::degenerate;
    }
  }

 private:
  // btGjkPairDetector's numbers: GJK's distance stands (1, 5, 8), or that of EPA's own GJK (6).
  static bool found_distance(int method) {
    return method == 1 || method == 5 || method == 6 || method == 8;
  }

  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver epa_;
};

struct BoxBox {
  static void prepare(Body&) {}

  static void answer(Query& query, Outcome& outcome) {
    btBoxBoxDetector detector(static_cast<const btBoxShape*>(query.a.shape.get()),
                              static_cast<const btBoxShape*>(query.b.shape.get()));
    Deepest deepest;
    detector.getClosestPoints(query.input, deepest, nullptr);
    if (deepest.contact) {
      outcome.status = Status::ok;
      report(*deepest.contact, query, outcome);
    } else {
      // No contact may also mean that clipping the faces left nothing of an overlap.
      outcome.status = Status::not_reported;
      outcome.answer = Answer::separated;
    }
  }
};

struct PolyhedralSat {
  static void prepare(Body& body) {
    if (!body.shape || !body.shape->isPolyhedral()) return;
    auto& shape = static_cast<btPolyhedralConvexShape&>(*body.shape);
    constexpr int most_vertices = 32767;  // Bullet numbers them with short integers
    const int count = shape.getNumVertices();
    if (count > most_vertices) return;
    // Bullet reads what it has not set where its hull has less than a tetrahedron's faces: so its
    // hull is looked at first.
    std::vector<btVector3> vertices(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) shape.getVertex(i, vertices[static_cast<std::size_t>(i)]);
    btConvexHullComputer hull;
    hull.compute(&vertices[0].getX(), sizeof(btVector3), count, 0, 0);
    if (hull.faces.size() < 4 || !shape.initializePolyhedralFeatures()) return;
    const btConvexPolyhedron* features = shape.getConvexPolyhedron();
    if (std::isfinite(features->m_localCenter.length2())) body.polyhedron = features;
  }

  void answer(Query& query, Outcome& outcome) {
    if (query.a.polyhedron == nullptr || query.b.polyhedron == nullptr) {
      outcome.answer = Answer::unknown;
      outcome.status = Status::degenerate;
      return;
    }
    const btConvexPolyhedron& hull_a = *query.a.polyhedron;
    const btConvexPolyhedron& hull_b = *query.b.polyhedron;
    const btTransform& at_a = query.input.m_transformA;
    const btTransform& at_b = query.input.m_transformB;
    outcome.status = Status::ok;
    Deepest deepest;  // given the point of two edges here, those of faces by the clipping
    btVector3 axis;   // from b to a
    if (!btPolyhedralContactClipping::findSeparatingAxis(hull_a, hull_b, at_a, at_b, axis,
                                                         deepest)) {
      outcome.answer = Answer::separated;
      return;
    }
    if (query.task == Task::intersect) {
      outcome.answer = Answer::overlapping;
      return;
    }
    axis.normalize();
    btScalar low_a, high_a, low_b, high_b;
    btVector3 lowest, highest, unused;
    hull_a.project(at_a, axis, low_a, high_a, lowest, unused);
    hull_b.project(at_b, axis, low_b, high_b, unused, highest);
    const btScalar depth = high_b - low_a;
    if (!deepest.contact) {
      const btScalar all = BT_LARGE_FLOAT;
      btPolyhedralContactClipping::clipHullAgainstHull(axis, hull_a, hull_b, at_a, at_b, -all, 0,
                                                       polygon_, clipped_, deepest);
    }
    const btVector3 point = deepest.contact ? deepest.contact->point_on_b : highest;
    report({axis, point, -depth}, query, outcome);
    if (outcome.answer == Answer::separated) outcome.answer = Answer::touching;  // rounding
  }

 private:
  btVertexArray polygon_, clipped_;
};

class Mpr {
 public:
  explicit Mpr(const NarrowPhaseSettings& settings)
      : cap_(settings.max_iterations.value_or(default_cap)) {}
  static void prepare(Body&) {}

  void answer(Query& query, Outcome& outcome) {
    int calls = 0;
    const View view_a{*query.a.shape, query.input.m_transformA, calls, cap_};
    const View view_b{*query.b.shape, query.input.m_transformB, calls, cap_};
    const btMprCollisionDescription description;
    btMprDistanceInfo found{};
    bool hit = false;
    outcome.status = Status::not_reported;
    try {
      if (query.task == Task::intersect) {
        btMprSimplex_t portal;
        const int portal_found = btDiscoverPortal(view_a, view_b, description, &portal);
        hit = portal_found > 0 ||
              (portal_found == 0 && btRefinePortal(view_a, view_b, description, &portal) == 0);
      } else {
        hit = btComputeMprPenetration(view_a, view_b, description, &found) == 0;
      }
      outcome.answer = hit ? Answer::overlapping : Answer::separated;
    } catch (const TooMany&) {
      outcome.answer = Answer::unknown;
      outcome.status = Status::not_converged;
    }
    outcome.support_calls = calls;
    outcome.iterations = calls / 2;
    if (hit && query.task == Task::penetration) {
      report({found.m_normalBtoA, found.m_pointOnB, found.m_distance}, query, outcome);
    }
  }

 private:
  // The loop that looks for a portal has no cap in Bullet, so the support function has one: it is
  // called for both bodies in each step of every loop. Refining has 1000 steps in Bullet, and so
  // has finding the depth.
  struct TooMany {};
  static constexpr int default_cap = 3000;

  struct View {
    const btConvexShape& shape;
    const btTransform& transform;
    int& calls;
    int cap;

    const btTransform& getWorldTransform() const { return transform; }
    const btVector3& getObjectCenterInWorld() const { return transform.getOrigin(); }
    btVector3 getLocalSupportWithMargin(const btVector3& direction) const {
      if (++calls > 2 * cap) throw TooMany{};
      return shape.localGetSupportVertexNonVirtual(direction);
    }
  };

  int cap_;
};

template <class Algorithm>
class BulletNarrowPhase final : public NarrowPhase {
 public:
  template <class... Settings>
  explicit BulletNarrowPhase(const Settings&... settings) : algorithm_(settings...) {}

  void bind(std::span<const Shape> shapes) override {
    bodies_.clear();
    bodies_.reserve(shapes.size());
    for (const Shape& shape : shapes) {
      bodies_.push_back(make_body(shape));
      Algorithm::prepare(bodies_.back());
    }
  }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.first[i], second = batch.second[i];
      const Pose& at_a = batch.poses[first];
      const Pose& at_b = batch.poses[second];
      Query query{batch.task,
                  bodies_[batch.shape_of[first]],
                  bodies_[batch.shape_of[second]],
                  {},
                  Vec3d::Zero()};
      query.origin = at_a(query.a.centre);
      query.input.m_transformA = btTransform(to_matrix(at_a.rotation), btVector3(0, 0, 0));
      query.input.m_transformB =
          btTransform(to_matrix(at_b.rotation), to_bullet(at_b(query.b.centre) - query.origin));
      algorithm_.answer(query, outcomes[i]);
    }
  }

 private:
  Algorithm algorithm_;
  std::vector<Body> bodies_;
};

}  // namespace
}  // namespace touchstone
#endif

namespace touchstone {
namespace {

bool all_bounded(ShapeKind, ShapeKind b, Task) { return b != ShapeKind::halfspace; }
bool boxes(ShapeKind a, ShapeKind b, Task) { return a == ShapeKind::box && b == ShapeKind::box; }
bool polyhedra(ShapeKind a, ShapeKind b, Task) {
  const auto flat_sided = [](ShapeKind k) { return k == ShapeKind::box || k == ShapeKind::hull; };
  return flat_sided(a) && flat_sided(b);
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  using enum Task;
  const auto info = [](const char* name, const char* called, const char* known_defect = "") {
    return AlgorithmInfo{.name = name,
                         .citation = std::string("Bullet 3.24, ") + called,
                         .origin = Origin::peer,
                         .known_defect = known_defect};
  };
  const std::vector<Precision> floats = {Precision::float32};
  return {
      {.info = info(
           "bullet-gjk-epa", "btGjkPairDetector with btGjkEpaPenetrationDepthSolver",
           "EPA stops at its first tetrahedron where flat faces meet squarely: depth down to 58 %"),
       .tasks = {intersect, distance, penetration},
       .scalars = floats,
       .supports = all_bounded,
       .make = TOUCHSTONE_IF_BUILT([](const NarrowPhaseSettings&) {
         return std::make_unique<BulletNarrowPhase<GjkEpa>>();
       })},
      {.info = info("bullet-box-box", "btBoxBoxDetector",
                    "depth of the deepest contact point, which may be less than the boxes'"),
       .tasks = {intersect, penetration},
       .scalars = floats,
       .supports = boxes,
       .make = TOUCHSTONE_IF_BUILT([](const NarrowPhaseSettings&) {
         return std::make_unique<BulletNarrowPhase<BoxBox>>();
       })},
      {.info = info("bullet-sat", "btPolyhedralContactClipping::findSeparatingAxis"),
       .tasks = {intersect, penetration},
       .scalars = floats,
       .supports = polyhedra,
       .make = TOUCHSTONE_IF_BUILT([](const NarrowPhaseSettings&) {
         return std::make_unique<BulletNarrowPhase<PolyhedralSat>>();
       })},
      {.info =
           info("bullet-mpr", "btComputeMprPenetration",
                "depth along the portal, an upper bound; witness points are not on the surfaces"),
       .tasks = {intersect, penetration},
       .scalars = floats,
       .supports = all_bounded,
       .make = TOUCHSTONE_IF_BUILT([](const NarrowPhaseSettings& settings) {
         return std::make_unique<BulletNarrowPhase<Mpr>>(settings);
       })},
  };
}
