// Bullet: GImpact for two meshes, and its tree of a static mesh against convex shapes and compounds.
// Paper:   none; Bullet 3.24: btGImpactCollisionAlgorithm by F. Leon (trees of quantised boxes, separating
//          axes of two triangles), btBvhTriangleMeshShape with btConvexConcaveCollisionAlgorithm (GJK of the
//          shape and each triangle whose box it meets), btCompoundShape.
// Departs: the adapter asks for contacts, since Bullet has no yes-or-no question, and takes those whose
//          distance is not above zero. Margins are 0 on meshes, triangles and shapes (Bullet's defaults of
//          0.01 and 0.04 make bodies thicker); spheres and capsules are their margins. Contacts of a mesh are
//          welded by btInternalEdgeUtility, which adjusts the normal and keeps the depth. Poses are relative to
//          the first body's origin, subtracted in double. Only the build in float is used.
// Fails:   GImpact has no axes across two edges: it sees contact where edges pass each other. Both miss
//          touches of degenerate triangles, and all lengths are compared with absolute thresholds.
// Cost:    memory is allocated for each query.
#include "algorithms/concave_phase.h"

#include "algorithms/peers/not_built.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/CollisionShapes/btTriangleInfoMap.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "algorithms/peers/bullet_bodies.h"
#include "algorithms/peers/concave/bullet_touching_parts.h"

namespace touchstone::bullet {
namespace {

// A body as Bullet has it. The shapes that make it up are kept with it.
struct MeshBody {
  std::vector<btScalar> vertices;
  std::vector<int> corners;
  std::unique_ptr<btTriangleIndexVertexArray> arrays;
  std::unique_ptr<btTriangleInfoMap> edges;  // for contacts that are welded
  std::vector<Body> parts;
  std::unique_ptr<btCollisionShape> whole;  // null if the body is one convex part, or none
  Pose of_part;                             // of that one part
  bool numbered = false;

  btCollisionShape* shape() const {
    if (whole) return whole.get();
    return parts.empty() ? nullptr : parts.front().shape.get();
  }
};

std::unique_ptr<btCollisionShape> shape_of(btTriangleIndexVertexArray* arrays, bool gimpact) {
  if (gimpact) {
    auto shape = std::make_unique<btGImpactMeshShape>(arrays);
    shape->setMargin(0);
    shape->updateBound();
    return shape;
  }
  auto shape = std::make_unique<btBvhTriangleMeshShape>(arrays, true);
  shape->setMargin(0);
  return shape;
}

void set_mesh(const TriangleMesh& mesh, bool gimpact, MeshBody& body) {
  for (const Vec3d& v : mesh.vertices) {
    for (const double x : v) body.vertices.push_back(static_cast<btScalar>(x));
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t k : triangle) body.corners.push_back(static_cast<int>(k));
  }
  body.arrays = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(mesh.triangles.size()), body.corners.data(),
      static_cast<int>(3 * sizeof(int)), static_cast<int>(mesh.vertices.size()),
      body.vertices.data(), static_cast<int>(3 * sizeof(btScalar)));
  body.whole = shape_of(body.arrays.get(), gimpact);
  body.numbered = true;
}

// A part's pose, moved to the centre of its Bullet shape.
Pose centred(const ConvexPart& part, const Body& shape) {
  return {part.pose.rotation, part.pose(shape.centre)};
}

void set_parts(const std::vector<ConvexPart>& parts, MeshBody& body) {
  for (const ConvexPart& part : parts) body.parts.push_back(make_body(part.shape));
  if (parts.empty()) return;
  if (parts.size() == 1) {
    body.of_part = centred(parts.front(), body.parts.front());
    return;
  }
  auto compound = std::make_unique<btCompoundShape>(true, static_cast<int>(parts.size()));
  compound->setMargin(0);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Pose pose = centred(parts[k], body.parts[k]);
    compound->addChildShape(btTransform(to_matrix(pose.rotation), to_bullet(pose.translation)),
                            body.parts[k].shape.get());
  }
  body.whole = std::move(compound);
  body.numbered = true;
}

class BulletMeshes final : public ConcavePhase {
 public:
  BulletMeshes(bool gimpact, bool welds)
      : gimpact_(gimpact), welds_(welds), dispatcher_(&configuration_) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
  }

  void bind(std::span<const ConcaveBody> bodies) override {
    kept_.reset();
    bodies_.clear();
    bodies_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!bodies[i].mesh) {
        set_parts(bodies[i].parts, bodies_[i]);
      } else if (!bodies[i].mesh->triangles.empty()) {
        set_mesh(*bodies[i].mesh, gimpact_, bodies_[i]);
        if (welds_ && !gimpact_) find_edges(bodies_[i]);
      }
    }
  }

  void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    pairs.clear();
    outcome.status = Status::not_reported;
    outcome.answer = Answer::separated;
    const MeshBody &body_a = bodies_[a.body], &body_b = bodies_[b.body];
    if (body_a.shape() == nullptr || body_b.shape() == nullptr) return;
    collide(a, b, pairs, is_measured_ && task == ConcaveTask::contacts);
    if (!pairs.empty()) outcome.answer = Answer::overlapping;
    if (task != ConcaveTask::contacts) {
      pairs.clear();
      return;
    }
    // A pair of parts has several contact points.
    std::ranges::sort(pairs);
    const auto repeated = std::ranges::unique(pairs);
    pairs.erase(repeated.begin(), repeated.end());
  }

  // Of a pair's contacts the deepest. One collision gives the pairs and these, so `solve` keeps them from the first
  // call on.
  bool measure(const PlacedConcave& a, const PlacedConcave& b, std::span<const IndexPair> pairs,
               std::vector<PartContact>& contacts) override {
    if (gimpact_) return false;
    contacts.clear();
    const MeshBody &body_a = bodies_[a.body], &body_b = bodies_[b.body];
    if (body_a.shape() == nullptr || body_b.shape() == nullptr) return true;
    is_measured_ = true;
    if (!are_kept_of(a, b)) {
      std::vector<IndexPair> touching;
      collide(a, b, touching, true);
    }
    std::ranges::stable_sort(found_, [](const PartContact& x, const PartContact& y) {
      return x.parts != y.parts ? x.parts < y.parts : x.depth > y.depth;
    });
    for (const IndexPair& pair : pairs) {
      const auto at = std::ranges::lower_bound(found_, pair, {}, &PartContact::parts);
      PartContact& contact = contacts.emplace_back();
      contact.parts = pair;
      contact.status = Status::not_reported;
      if (at == found_.end() || at->parts != pair) continue;
      contact = *at;
      if (body_b.arrays != nullptr) contact.normal = -contact.normal;
      contact.point += a.pose.translation;
    }
    return true;
  }

 private:
  bool are_kept_of(const PlacedConcave& a, const PlacedConcave& b) const {
    const auto is_same = [](const PlacedConcave& x, const PlacedConcave& y) {
      return x.body == y.body && x.pose.rotation == y.pose.rotation &&
             x.pose.translation == y.pose.translation;
    };
    return kept_ && is_same(kept_->first, a) && is_same(kept_->second, b);
  }

  static void find_edges(MeshBody& body) {
    body.edges = std::make_unique<btTriangleInfoMap>();
    btGenerateInternalEdgeInfo(static_cast<btBvhTriangleMeshShape*>(body.whole.get()),
                               body.edges.get());
  }

  void place(int side, const MeshBody& body, const Pose& pose, const Vec3d& origin) {
    btCollisionObject& object = objects_[side];
    object.setCollisionShape(body.shape());
    const Vec3d offset = (pose.translation - origin) + pose.rotation * body.of_part.translation;
    object.setWorldTransform(
        btTransform(to_matrix(pose.rotation * body.of_part.rotation), to_bullet(offset)));
  }

  void collide(const PlacedConcave& placed_a, const PlacedConcave& placed_b,
               std::vector<IndexPair>& pairs, bool keeps) {
    found_.clear();
    kept_.reset();
    if (keeps) kept_ = {placed_a, placed_b};
    const MeshBody &a = bodies_[placed_a.body], &b = bodies_[placed_b.body];
    place(0, a, placed_a.pose, placed_a.pose.translation);
    place(1, b, placed_b.pose, placed_a.pose.translation);
    btCollisionObject *first = &objects_[0], *second = &objects_[1];
    const btCollisionObjectWrapper wrap_a(nullptr, first->getCollisionShape(), first,
                                          first->getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wrap_b(nullptr, second->getCollisionShape(), second,
                                          second->getWorldTransform(), -1, -1);
    // BT_CLOSEST_POINT_ALGORITHMS would give an algorithm that finds nothing for GImpact's meshes.
    btCollisionAlgorithm* algorithm =
        dispatcher_.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    TouchingParts result(&wrap_a, &wrap_b, a.numbered, b.numbered, pairs);
    result.contacts = keeps ? &found_ : nullptr;
    result.welds = welds_;
    algorithm->processCollision(&wrap_a, &wrap_b, info_, &result);
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
  }

  bool gimpact_, welds_;
  bool is_measured_ = false;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDispatcherInfo info_;
  std::array<btCollisionObject, 2> objects_;
  std::vector<MeshBody> bodies_;
  std::vector<PartContact> found_;  // of the bodies in kept_, which collided last
  std::optional<std::pair<PlacedConcave, PlacedConcave>> kept_;
};

std::unique_ptr<ConcavePhase> make_gimpact(const ConcaveSettings& settings) {
  return std::make_unique<BulletMeshes>(true, settings.welds);
}
std::unique_ptr<ConcavePhase> make_tree(const ConcaveSettings& settings) {
  return std::make_unique<BulletMeshes>(false, settings.welds);
}

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {
namespace {

bool is_surface(const ConcaveBody& body) { return body.mesh && !body.has_inside(); }
bool is_compound(const ConcaveBody& body) {
  return !body.mesh && !body.has_inside() &&
         std::ranges::none_of(body.parts, [](const ConvexPart& part) {
           return part.shape.kind == ShapeKind::halfspace;
         });
}

}  // namespace

std::vector<ConcaveEntry> peers_bullet_meshes() {
  return {{.info = {.name = "bullet-gimpact",
                    .citation = "Bullet 3.24, btGImpactCollisionAlgorithm",
                    .origin = Origin::peer,
                    .known_defect = "rounds in floats; no axes across two edges"},
           .tasks = {ConcaveTask::intersect, ConcaveTask::contacts},
           .scalars = {Precision::float32},
           .supports = [](const ConcaveBody& a,
                          const ConcaveBody& b) { return is_surface(a) && is_surface(b); },
           .approximate = true,
           .make = bullet::make_gimpact},
          {.info = {.name = "bullet-mesh",
                    .citation = "Bullet 3.24, btBvhTriangleMeshShape and btCompoundShape",
                    .origin = Origin::peer,
                    .known_defect = "rounds in floats; absolute thresholds"},
           .tasks = {ConcaveTask::intersect, ConcaveTask::contacts},
           .scalars = {Precision::float32},
           .supports =
               [](const ConcaveBody& a, const ConcaveBody& b) {
                 return (is_surface(a) && is_compound(b)) || (is_compound(a) && is_surface(b)) ||
                        (is_compound(a) && is_compound(b));
               },
           .measures = true,
           .welds = true,
           .approximate = true,
           .make = bullet::make_tree}};
}

}  // namespace touchstone::entries
