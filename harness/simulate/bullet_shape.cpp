// Makes Bullet's shapes. Margins, which make contacts steady, are within the body: those of boxes and cylinders by
// Bullet's design, those of hulls by its shrinking; spheres and capsules are their margins. Others have none.
#ifdef TOUCHSTONE_HAS_BULLET_DYNAMICS
#include "harness/simulate/bullet_shape.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "harness/geometry/concave_bodies.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/geometry/polyhedron.h"
#include "harness/simulate/bullet_vectors.h"

namespace touchstone::simulate {
namespace {

constexpr double pi = std::numbers::pi;

// Bullet has no ellipsoid. Its inertia is exact.
class Ellipsoid final : public btConvexInternalShape {
 public:
  explicit Ellipsoid(const btVector3& radii) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    m_implicitShapeDimensions = radii;
    setMargin(0);
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
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override {
    const btVector3 squares = m_implicitShapeDimensions * m_implicitShapeDimensions;
    inertia =
        mass / 5 *
        btVector3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
  }
  const char* getName() const override { return "Ellipsoid"; }
};

struct Mass {
  double volume = 0;
  Vec3d centre = Vec3d::Zero();
};

Mass mass_of(const Hull& hull) {
  if (hull.dimension < 3) return {};
  const std::vector<geometry::Triangle> triangles = geometry::triangles_of(hull);
  geometry::Mesh mesh;
  for (const geometry::Triangle& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {t.a, t.b, t.c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return {geometry::volume_of(triangles), geometry::centre_of_mass(mesh)};
}

Mass mass_of(const Shape& shape) {
  const double r = shape.radius, half = shape.half_length;
  const Vec3d& sides = shape.kind == ShapeKind::ellipsoid ? shape.radii : shape.half_extents;
  const double product = sides.x() * sides.y() * sides.z();
  switch (shape.kind) {
    case ShapeKind::sphere: return {4.0 / 3 * pi * r * r * r, Vec3d::Zero()};
    case ShapeKind::capsule: return {pi * r * r * (4.0 / 3 * r + 2 * half), Vec3d::Zero()};
    case ShapeKind::box: return {8 * product, Vec3d::Zero()};
    case ShapeKind::cylinder: return {pi * r * r * 2 * half, Vec3d::Zero()};
    case ShapeKind::cone: return {pi * r * r * 2 * half / 3, Vec3d(0, 0, -half / 2)};
    case ShapeKind::ellipsoid: return {4.0 / 3 * pi * product, Vec3d::Zero()};
    case ShapeKind::hull: return mass_of(*shape.hull);
    case ShapeKind::halfspace: break;
  }
  return {};
}

// Faces are moved inwards by the margin, at most a tenth of the way to the middle.
std::unique_ptr<btCollisionShape> hull_shape(const Hull& given, std::vector<btVector3> points) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(0);
  if (given.dimension == 3) {
    constexpr btScalar most = 0.04F, share = 0.1F;
    btConvexHullComputer shrunk;
    const btScalar margin = shrunk.compute(&points[0].getX(), int{sizeof(btVector3)},
                                           static_cast<int>(points.size()), most, share);
    if (margin > 0 && shrunk.vertices.size() > 3) {
      points.assign(&shrunk.vertices[0], &shrunk.vertices[0] + shrunk.vertices.size());
      hull->setMargin(margin);
    }
  }
  for (const btVector3& point : points) hull->addPoint(point, false);
  hull->recalcLocalAabb();
  return hull;
}

// `centre` becomes the origin. Of a half-space and of round shapes it has to be 0.
std::unique_ptr<btCollisionShape> convex_shape(const Shape& shape, const Vec3d& centre) {
  const auto radius = static_cast<btScalar>(shape.radius);
  const auto height = static_cast<btScalar>(2 * shape.half_length);
  std::unique_ptr<btCollisionShape> made;
  switch (shape.kind) {
    case ShapeKind::sphere: return std::make_unique<btSphereShape>(radius);
    case ShapeKind::capsule: return std::make_unique<btCapsuleShapeZ>(radius, height);
    case ShapeKind::box: return std::make_unique<btBoxShape>(to_bullet(shape.half_extents));
    case ShapeKind::cylinder:
      return std::make_unique<btCylinderShapeZ>(btVector3(radius, radius, height / 2));
    case ShapeKind::cone: made = std::make_unique<btConeShapeZ>(radius, height); break;
    case ShapeKind::ellipsoid: return std::make_unique<Ellipsoid>(to_bullet(shape.radii));
    case ShapeKind::hull: {
      std::vector<btVector3> points;
      for (const Vec3d& v : shape.hull->vertices) points.push_back(to_bullet(v - centre));
      return hull_shape(*shape.hull, std::move(points));
    }
    case ShapeKind::halfspace: {
      const double length = shape.normal.norm();
      return std::make_unique<btStaticPlaneShape>(to_bullet(shape.normal / length),
                                                  static_cast<btScalar>(shape.offset / length));
    }
  }
  made->setMargin(0);
  return made;
}

void make_compound(std::span<const ConvexPart> parts, BulletShape& body) {
  std::vector<Mass> masses;
  for (const ConvexPart& part : parts) {
    const Mass& mass = masses.emplace_back(mass_of(part.shape));
    body.volume += mass.volume;
    body.centre += mass.volume * part.pose(mass.centre);
  }
  body.centre = body.volume > 0 ? Vec3d(body.centre / body.volume) : Vec3d::Zero();
  auto compound = std::make_unique<btCompoundShape>();
  compound->setMargin(0);
  for (const ConvexPart& part : parts) {
    body.parts.push_back(convex_shape(part.shape, Vec3d::Zero()));
    compound->addChildShape(
        to_bullet(Pose{part.pose.rotation, part.pose.translation - body.centre}),
        body.parts.back().get());
  }
  body.shape = std::move(compound);
}

void make_mesh(const TriangleMesh& mesh, bool moves, BulletShape& body) {
  if (moves) {
    const geometry::Mesh surface{mesh.vertices, mesh.triangles};
    // An open surface weighs what its hull does.
    if (geometry::open_edge(mesh.vertices, mesh.triangles)) {
      body.volume = -1;
    } else {
      body.volume = std::abs(geometry::volume_of(geometry::triangles_of(surface)));
    }
    body.centre = geometry::centre_of_mass(surface);
  }
  for (const Vec3d& v : mesh.vertices) {
    const Vec3d at = v - body.centre;
    for (const double x : at) body.vertices.push_back(static_cast<btScalar>(x));
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) body.corners.push_back(static_cast<int>(corner));
  }
  body.arrays = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(mesh.triangles.size()), body.corners.data(), int{3 * sizeof(int)},
      static_cast<int>(mesh.vertices.size()), body.vertices.data(), int{3 * sizeof(btScalar)});
  if (!moves) {
    body.shape = std::make_unique<btBvhTriangleMeshShape>(body.arrays.get(), true);
    body.shape->setMargin(0);
    return;
  }
  auto shape = std::make_unique<btGImpactMeshShape>(body.arrays.get());
  shape->setMargin(0);
  shape->updateBound();
  body.shape = std::move(shape);
}

}  // namespace

BulletShape bullet_shape(const scene::Scene& scene, std::uint32_t shape, bool moves) {
  BulletShape body;
  const Shape& hull = scene.shapes[shape];
  const ConcaveBody* concave = scene.concave_of(shape);
  if (concave != nullptr && concave->mesh != nullptr) {
    make_mesh(*concave->mesh, moves, body);
    if (body.volume < 0) body.volume = mass_of(hull).volume;
  } else if (concave != nullptr) {
    make_compound(concave->parts, body);
  } else if (hull.kind == ShapeKind::cone && moves) {
    make_compound(std::vector<ConvexPart>{{.shape = hull, .pose = {}}}, body);
  } else {
    const Mass mass = mass_of(hull);
    body.volume = mass.volume;
    if (moves) body.centre = mass.centre;
    body.shape = convex_shape(hull, body.centre);
  }
  return body;
}

}  // namespace touchstone::simulate
#endif
