// Bullet: a tree of all parts' boxes, whose overlapping pairs its dispatcher asks.
// Paper:   none; Bullet 3.24: btDbvtBroadphase by N. Presson, btCollisionDispatcher, btCompoundShape with its tree, as
//          MoveIt and Tesseract ask them: each part is a btCollisionObject, a mesh is a compound of triangles, and a
//          filter leaves out pairs that may touch.
// Departs: shapes have no margins, as in bullet-mesh. The boxes of the parts of links are moved in each configuration,
//          and the pairs of boxes are kept, each with its algorithm. Only the build in float is used.
// Fails:   two triangles, and all convex shapes, are those of Bullet's GJK and EPA: it misses touches, and all lengths
//          are compared with absolute thresholds.
// Cost:    a shape and a child of the compound for each triangle; allocates in each pair of boxes that is new.
#include "algorithms/configuration_query.h"

#include "algorithms/core/mesh/sole_shape.h"
#include "algorithms/peers/not_built.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {
namespace {

// Whether two objects share a point.
struct TouchResult final : btManifoldResult {
  bool touches = false;

  TouchResult(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b)
      : btManifoldResult(a, b) {}
  void addContactPoint(const btVector3&, const btVector3&, btScalar distance) override {
    touches = touches || distance <= 0;
  }
};

class BulletConfigurations final : public ConfigurationQuery {
 public:
  explicit BulletConfigurations(const ConfigurationSettings&) : dispatcher_(&configuration_) {}
  ~BulletConfigurations() override { clear(); }

  void bind(const ConfigurationModel& model) override {
    clear();
    model_ = &model;
    filter_.parts = model.parts.size();
    filter_.asked.assign(filter_.parts * filter_.parts, 0);
    for (const auto& [a, b] : model.pairs) {
      filter_.asked[a * filter_.parts + b] = filter_.asked[b * filter_.parts + a] = 1;
    }
    broad_phase_ = std::make_unique<btDbvtBroadphase>();
    broad_phase_->getOverlappingPairCache()->setOverlapFilterCallback(&filter_);
    objects_.resize(model.parts.size());
    for (std::size_t i = 0; i < model.parts.size(); ++i) add(i, model.parts[i]);
  }

  void solve(ConfigurationTask task, const Configurations& configurations,
             std::span<ConfigurationAnswer> answers) override {
    answer_steps(task, configurations, answers,
                 [&](std::span<const Pose> links) { return find(links); });
  }

 private:
  struct PartObject {
    Body body;                                                // of a convex part
    std::vector<std::unique_ptr<btTriangleShape>> triangles;  // of a mesh
    std::unique_ptr<btCompoundShape> compound;
    btCollisionObject object;
  };

  struct Filter final : btOverlapFilterCallback {
    std::vector<char> asked;
    std::size_t parts = 0;

    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      return asked[number_of(a) * parts + number_of(b)] != 0;
    }
  };

  // Asks a pair of boxes, until one pair of parts is in contact.
  struct Asker final : btOverlapCallback {
    BulletConfigurations* self = nullptr;
    ConfigurationAnswer* found = nullptr;

    bool processOverlap(btBroadphasePair& pair) override {
      if (found->answer == Answer::separated) self->ask(pair, *found);
      return false;
    }
  };

  static std::size_t number_of(const btBroadphaseProxy* proxy) {
    return static_cast<std::size_t>(
        static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
  }

  void clear() {
    for (const auto& part : objects_) {
      if (part == nullptr || part->object.getBroadphaseHandle() == nullptr) continue;
      broad_phase_->destroyProxy(part->object.getBroadphaseHandle(), &dispatcher_);
    }
    objects_.clear();
    broad_phase_.reset();
  }

  void add(std::size_t number, const ModelPart& given) {
    if (given.body.part_count() == 0) return;
    auto part = std::make_unique<PartObject>();
    if (given.body.mesh) {
      const TriangleMesh& mesh = *given.body.mesh;
      part->compound =
          std::make_unique<btCompoundShape>(true, static_cast<int>(mesh.triangles.size()));
      part->compound->setMargin(0);
      for (const auto& corners : mesh.triangles) {
        auto triangle = std::make_unique<btTriangleShape>(to_bullet(mesh.vertices[corners[0]]),
                                                          to_bullet(mesh.vertices[corners[1]]),
                                                          to_bullet(mesh.vertices[corners[2]]));
        triangle->setMargin(0);
        part->compound->addChildShape(btTransform::getIdentity(), triangle.get());
        part->triangles.push_back(std::move(triangle));
      }
      part->object.setCollisionShape(part->compound.get());
    } else {
      part->body = make_body(*sole_shape(given.body));
      part->object.setCollisionShape(part->body.shape.get());
    }
    part->object.setUserIndex(static_cast<int>(number));
    set(*part, given.pose);
    btVector3 low, high;
    part->object.getCollisionShape()->getAabb(part->object.getWorldTransform(), low, high);
    part->object.setBroadphaseHandle(broad_phase_->createProxy(
        low, high, part->object.getCollisionShape()->getShapeType(), &part->object,
        btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter, &dispatcher_));
    objects_[number] = std::move(part);
  }

  static void set(PartObject& part, const Pose& pose) {
    part.object.setWorldTransform(
        btTransform(to_matrix(pose.rotation), to_bullet(pose(part.body.centre))));
  }

  ConfigurationAnswer find(std::span<const Pose> links) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const ModelPart& given = model_->parts[i];
      if (given.link == ModelPart::world || objects_[i] == nullptr) continue;
      PartObject& part = *objects_[i];
      set(part, placed(given, links));
      btVector3 low, high;
      part.object.getCollisionShape()->getAabb(part.object.getWorldTransform(), low, high);
      broad_phase_->setAabb(part.object.getBroadphaseHandle(), low, high, &dispatcher_);
    }
    broad_phase_->calculateOverlappingPairs(&dispatcher_);
    ConfigurationAnswer found;
    found.answer = Answer::separated;
    found.status = Status::not_reported;
    Asker asker;
    asker.self = this;
    asker.found = &found;
    broad_phase_->getOverlappingPairCache()->processAllOverlappingPairs(&asker, &dispatcher_);
    return found;
  }

  void ask(btBroadphasePair& pair, ConfigurationAnswer& found) {
    const auto *first = static_cast<const btCollisionObject*>(pair.m_pProxy0->m_clientObject),
               *second = static_cast<const btCollisionObject*>(pair.m_pProxy1->m_clientObject);
    const btCollisionObjectWrapper wrap_a(nullptr, first->getCollisionShape(), first,
                                          first->getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wrap_b(nullptr, second->getCollisionShape(), second,
                                          second->getWorldTransform(), -1, -1);
    // The cache of pairs frees it when the boxes part.
    if (pair.m_algorithm == nullptr) {
      pair.m_algorithm =
          dispatcher_.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CLOSEST_POINT_ALGORITHMS);
    }
    if (pair.m_algorithm == nullptr) return;
    TouchResult result(&wrap_a, &wrap_b);
    pair.m_algorithm->processCollision(&wrap_a, &wrap_b, info_, &result);
    if (!result.touches) return;
    const auto a = static_cast<std::uint32_t>(first->getUserIndex()),
               b = static_cast<std::uint32_t>(second->getUserIndex());
    found.answer = Answer::overlapping;
    found.pair = {std::min(a, b), std::max(a, b)};
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDispatcherInfo info_;
  std::unique_ptr<btDbvtBroadphase> broad_phase_;
  Filter filter_;
  const ConfigurationModel* model_ = nullptr;
  std::vector<std::unique_ptr<PartObject>> objects_;  // one a part; null for one without points
};

std::unique_ptr<ConfigurationQuery> make_meshes(const ConfigurationSettings& settings) {
  return std::make_unique<BulletConfigurations>(settings);
}

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {

std::vector<ConfigurationEntry> peers_bullet_configurations() {
  return {
      {.info = {.name = "bullet-world",
                .citation = "Bullet 3.24: btDbvtBroadphase, btCollisionDispatcher, compounds of "
                            "triangles for meshes",
                .origin = Origin::peer,
                .known_defect = "rounds in floats; absolute thresholds"},
       .tasks = {ConfigurationTask::free, ConfigurationTask::motion},
       .supports =
           [](const ConfigurationModel& model) {
             return std::ranges::all_of(model.parts, [](const ModelPart& part) {
               if (part.body.mesh) return !part.body.mesh->solid;
               const Shape* const shape = sole_shape(part.body);
               return part.body.part_count() == 0 ||
                      (shape != nullptr && shape->kind != ShapeKind::halfspace);
             });
           },
       .approximate = true,
       .make = bullet::make_meshes}};
}

}  // namespace touchstone::entries
