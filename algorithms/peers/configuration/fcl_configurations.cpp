// FCL: a tree of the robot's parts and one of the obstacles, with trees of oriented boxes and swept spheres over meshes.
// Paper:   Pan, Chitta, Manocha, "FCL: A general purpose library for collision and proximity queries", ICRA 2012. The
//          library is FCL 0.7: two DynamicAABBTreeCollisionManager, fcl::collide and fcl::distance of
//          BVHModel<OBBRSS> and shapes, as MoveIt asks them: without contact points, and a callback that leaves out
//          pairs that may touch.
// Departs: the robot's objects and its tree are kept and updated, where MoveIt makes them anew for each query. Obstacles
//          are asked first, one part of the robot after the other, and then the robot itself, as MoveIt does. Objects
//          are registered one by one: registerObjects of several, one of them a half-space, is a segmentation fault.
// Fails:   a mesh is a surface. Pairs with a convex shape are those of FCL's narrow phase (fcl-libccd), with its
//          tolerance of 1e-6. A tree's box around a turned part is that of a ball.
// Cost:    548 bytes a triangle; allocates in each pair that is asked.
#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "algorithms/configuration_query.h"
#include "algorithms/core/mesh/sole_shape.h"

#ifdef TOUCHSTONE_HAS_FCL
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "algorithms/peers/fcl_mesh.h"
#include "algorithms/peers/fcl_shapes.h"

namespace touchstone {
namespace {

using Object = fcl::CollisionObject<double>;
using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;

Geometry geometry_of(const ConcaveBody& body) {
  if (!body.mesh) return fcl_shapes::make_fcl_shape<double>(*sole_shape(body));
  return fcl_shapes::make_fcl_mesh<fcl::OBBRSS<double>>(*body.mesh);
}

class FclConfigurations final : public ConfigurationQuery {
 public:
  explicit FclConfigurations(const ConfigurationSettings&) {}

  void bind(const ConfigurationModel& model) override {
    model_ = &model;
    objects_.clear();
    has_halfspace_ = std::ranges::any_of(model.parts, [](const ModelPart& part) {
      const Shape* const shape = sole_shape(part.body);
      return shape != nullptr && shape->kind == ShapeKind::halfspace;
    });
    robot_ = std::make_unique<fcl::DynamicAABBTreeCollisionManager<double>>();
    world_ = std::make_unique<fcl::DynamicAABBTreeCollisionManager<double>>();
    asked_.assign(model.parts.size() * model.parts.size(), 0);
    for (const auto& [a, b] : model.pairs) {
      asked_[place(a, b)] = asked_[place(b, a)] = 1;
    }
    of_robot_.clear();
    std::vector<std::pair<const void*, Geometry>> made;  // a mesh may be that of several parts
    for (std::uint32_t i = 0; i < model.parts.size(); ++i) {
      const ModelPart& part = model.parts[i];
      if (part.body.part_count() == 0) continue;
      const void* const mesh = part.body.mesh.get();
      const auto known = std::ranges::find_if(
          made, [&](const auto& one) { return mesh != nullptr && one.first == mesh; });
      Geometry geometry = known != made.end() ? known->second : geometry_of(part.body);
      if (known == made.end()) made.emplace_back(mesh, geometry);
      auto object = std::make_unique<Object>(geometry);
      object->setUserData(reinterpret_cast<void*>(std::uintptr_t{i}));
      set(*object, part.pose);
      if (part.link == ModelPart::world) {
        world_->registerObject(object.get());
      } else {
        robot_->registerObject(object.get());
        of_robot_.push_back(object.get());
      }
      objects_.push_back(std::move(object));
    }
    robot_->setup();
    world_->setup();
  }

  void solve(ConfigurationTask task, const Configurations& configurations,
             std::span<ConfigurationAnswer> answers) override {
    // FCL has no distance to a half-space.
    if (task == ConfigurationTask::distance && has_halfspace_) {
      std::ranges::fill(answers, ConfigurationAnswer{});
      return;
    }
    answer_steps(task, configurations, answers, [&](std::span<const Pose> links) {
      return task == ConfigurationTask::distance ? measure(links) : collide(links);
    });
  }

 private:
  struct Asked {
    const FclConfigurations* self;
    ConfigurationAnswer found;
  };

  static void set(Object& object, const Pose& pose) {
    object.setTransform(fcl_shapes::to_fcl<double>(pose));
    object.computeAABB();
  }

  void put(std::span<const Pose> links) {
    for (Object* const object : of_robot_) {
      set(*object, placed(model_->parts[number_of(object)], links));
    }
    robot_->update();
  }

  std::size_t place(std::uint32_t a, std::uint32_t b) const { return a * model_->parts.size() + b; }
  static std::uint32_t number_of(const Object* object) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
  }
  bool asks(const Object* a, const Object* b) const {
    return asked_[place(number_of(a), number_of(b))] != 0;
  }
  static IndexPair pair_of(const Object* a, const Object* b) {
    const std::uint32_t i = number_of(a), k = number_of(b);
    return {std::min(i, k), std::max(i, k)};
  }

  static bool collide_pair(Object* a, Object* b, void* data) {
    Asked& asked = *static_cast<Asked*>(data);
    if (!asked.self->asks(a, b)) return false;
    const fcl::CollisionRequest<double> request(1, false);
    fcl::CollisionResult<double> result;
    fcl::collide(a, b, request, result);
    if (!result.isCollision()) return false;
    asked.found.answer = Answer::overlapping;
    asked.found.pair = pair_of(a, b);
    return true;
  }

  static bool measure_pair(Object* a, Object* b, void* data, double& least) {
    Asked& asked = *static_cast<Asked*>(data);
    ConfigurationAnswer& found = asked.found;
    least = found.distance;
    if (!asked.self->asks(a, b)) return false;
    const fcl::DistanceRequest<double> request;
    fcl::DistanceResult<double> result;
    // What is farther than this is not looked for.
    result.min_distance = least;
    const double distance = fcl::distance(a, b, request, result);
    if (distance < found.distance) {
      found.distance = least = std::max(distance, 0.0);
      found.pair = pair_of(a, b);
    }
    if (distance <= 0) found.answer = Answer::overlapping;
    return distance <= 0;
  }

  // Moves the robot and asks: `of_object` of each part of it and the world, then `of_robot`.
  template <class OfObject, class OfRobot>
  ConfigurationAnswer ask(std::span<const Pose> links, double distance, const OfObject& of_object,
                          const OfRobot& of_robot) {
    Asked asked{this, {}};
    ConfigurationAnswer& found = asked.found;
    found.answer = Answer::separated;
    found.status = Status::not_reported;
    found.distance = distance;
    try {
      put(links);
      for (Object* const object : of_robot_) {
        of_object(object, &asked);
        if (found.answer == Answer::overlapping) return found;
      }
      of_robot(&asked);
    } catch (...) {
      found.answer = Answer::unknown;
      found.status = Status::degenerate;
    }
    return found;
  }

  ConfigurationAnswer collide(std::span<const Pose> links) {
    return ask(
        links, Outcome::none,
        [&](Object* object, Asked* asked) { world_->collide(object, asked, collide_pair); },
        [&](Asked* asked) { robot_->collide(asked, collide_pair); });
  }

  ConfigurationAnswer measure(std::span<const Pose> links) {
    return ask(
        links, std::numeric_limits<double>::infinity(),
        [&](Object* object, Asked* asked) { world_->distance(object, asked, measure_pair); },
        [&](Asked* asked) { robot_->distance(asked, measure_pair); });
  }

  const ConfigurationModel* model_ = nullptr;
  std::vector<std::unique_ptr<Object>> objects_;  // of the parts that have points
  std::vector<Object*> of_robot_;                 // those of parts of links
  bool has_halfspace_ = false;
  std::vector<char> asked_;  // of two parts, in either order
  std::unique_ptr<fcl::DynamicAABBTreeCollisionManager<double>> robot_, world_;
};

std::unique_ptr<ConfigurationQuery> make_tree(const ConfigurationSettings& settings) {
  return std::make_unique<FclConfigurations>(settings);
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<ConfigurationEntry> peers_fcl_configurations() {
  return {
      {.info = {.name = "fcl-managers",
                .citation = "FCL 0.7: DynamicAABBTreeCollisionManager, BVHModel<OBBRSS>",
                .origin = Origin::peer,
                .known_defect = "a tolerance of 1e-6; gaps are those of fcl-libccd"},
       .tasks = {ConfigurationTask::free, ConfigurationTask::distance, ConfigurationTask::motion},
       .supports =
           [](const ConfigurationModel& model) {
             return std::ranges::all_of(model.parts, [](const ModelPart& part) {
               const bool is_plain = part.body.mesh || part.body.part_count() == 0 ||
                                     sole_shape(part.body) != nullptr;
               return is_plain && !part.body.has_inside();
             });
           },
       .approximate = true,
       .make = make_tree}};
}

}  // namespace touchstone::entries
