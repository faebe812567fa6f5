// ODE's colliders of spheres, capsules, boxes and planes.
// Paper:   none; ODE 0.16: dBoxBox (separating axes, then the faces clipped against each other) and
//          the closed forms that dCollide looks up for the other kinds, by R. Smith.
// Departs: the adapter asks dBoxBox for as many contacts as there can be, eight, because a choice
//          among them takes longer; "contacts unimportant" would be faster still but misses every
//          sixth overlap. The depth of two boxes is dBoxBox's own and not that of a contact.
//          dCollide returns one contact, the deepest. dBoxBox takes boxes without geoms; the
//          others have two geoms a shape, as a geom never collides with itself. A half-space is a
//          plane, below which is solid; the pose's matrix turns its normal. Witness points are not
//          reported: ODE gives one contact point, with another meaning for each kind pair.
// Fails:   dBoxBox prefers the axes of faces by a twentieth of the depth and returns the depth of
//          the axis that it chose: up to 5 % too great. It reports no contact for some overlapping
//          boxes of the same orientation. A capsule whose segment meets the box is never deeper
//          than its radius. No query reports a failure.
// Cost:    O(1).
#include "algorithms/narrow_phase.h"
#ifdef TOUCHSTONE_HAS_ODE
#include <cmath>
#include <type_traits>

#include "algorithms/peers/ode_library.h"

namespace touchstone {
namespace {

using ode::scalar;

Vec3d to_vector(const dVector3 v) { return {v[0], v[1], v[2]}; }

void report(bool contact, const Vec3d& normal, dReal depth, Task task, Outcome& outcome) {
  outcome.status = Status::not_reported;
  outcome.iterations = outcome.support_calls = -1;
  outcome.answer = contact ? Answer::overlapping : Answer::separated;
  if (!contact || task != Task::penetration) return;
  clear_numbers(outcome);
  outcome.distance = 0 - static_cast<double>(depth);
  outcome.normal = normal;
}

class OdeNarrowPhase final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override {
    shapes_ = shapes;
    sides_.clear();
    for (auto& geoms : geoms_) geoms.clear();
    const auto lock = ode::enter();
    for (const Shape& shape : shapes) {
      const Vec3d side = 2 * shape.half_extents;
      sides_.push_back({static_cast<dReal>(side.x()), static_cast<dReal>(side.y()),
                        static_cast<dReal>(side.z()), 0});
      for (auto& geoms : geoms_) geoms.push_back(ode::make_geom(shape));
    }
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    const bool boxes = batch.kind_a == ShapeKind::box && batch.kind_b == ShapeKind::box;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
      const std::uint32_t a = batch.pairs.shape_of[first], b = batch.pairs.shape_of[second];
      const Pose &pose_a = batch.pairs.poses[first], &pose_b = batch.pairs.poses[second];
      std::array<dContactGeom, 8> contacts;
      if (boxes) {
        const ode::Placement at_a(pose_a), at_b(pose_b);
        dVector3 normal;
        dReal depth = 0;
        int code = 0;  // unchanged if there is no contact
        const int count =
            dBoxBox(at_a.position, at_a.rotation, sides_[a].data(), at_b.position, at_b.rotation,
                    sides_[b].data(), normal, &depth, &code, static_cast<int>(contacts.size()),
                    contacts.data(), sizeof contacts[0]);
        report(count > 0, to_vector(normal), depth, task, outcomes[i]);
      } else {
        const dGeomID geom_a = geoms_[0][a].get(), geom_b = geoms_[1][b].get();
        ode::place(geom_a, shapes_[a], pose_a);
        ode::place(geom_b, shapes_[b], pose_b);
        const int count = dCollide(geom_a, geom_b, 1, contacts.data(), sizeof contacts[0]);
        // A contact's normal points from b into a.
        report(count > 0, -to_vector(contacts[0].normal), contacts[0].depth, task, outcomes[i]);
      }
    }
  }

 private:
  std::span<const Shape> shapes_;
  std::vector<std::array<dReal, 4>> sides_;
  std::array<std::vector<ode::Geom>, 2> geoms_;  // indexed by side of a pair, then by shape
};

Encoding encoding(ShapeKind, ShapeKind, Task, Precision) {
  return scalar == Precision::float64 ? Encoding::as_given : Encoding::float32;
}

bool supports(ShapeKind a, ShapeKind b, Task) {
  return a <= ShapeKind::box && (b <= ShapeKind::box || b == ShapeKind::halfspace);
}

std::unique_ptr<NarrowPhase> make_ode(const NarrowPhaseSettings&) {
  return std::make_unique<OdeNarrowPhase>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_ode_narrow_phase() {
  return {{.info = {.name = "ode",
                    .citation = "ODE 0.16, dBoxBox, dCollide",
                    .origin = Origin::peer,
                    .known_defect = "depth of boxes up to 5 % too great; no contact for some boxes "
                                    "of the same orientation; depth of capsule and box is at most "
                                    "the radius"},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = {scalar},
           .supports = supports,
           .traits = {.depth_is_bound = true},
           .encoding = encoding,
           .make = make_ode}};
}

}  // namespace touchstone::entries
