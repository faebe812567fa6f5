// ODE's contacts of two boxes.
// Paper:   none; ODE 0.16, dBoxBox by R. Smith (separating axes, then one face clipped against the
//          other).
// Departs: the adapter asks for four contacts, and ODE chooses among its own. ODE reports one point
//          for each, on the body whose face was clipped, or half way between two edges; the point
//          on the other body is derived: as far from it as the contact is deep, along the normal.
// Fails:   prefers the axes of faces by a twentieth of the depth, so that the normal is not always
//          that of the least penetration. It reports no contact for some overlapping boxes of the
//          same orientation. It never reports a failure.
// Cost:    O(1).
#include "algorithms/contact_manifold.h"
#ifdef TOUCHSTONE_HAS_ODE
#include <algorithm>
#include <type_traits>

#include "algorithms/peers/ode_library.h"

namespace touchstone {
namespace {

using ode::scalar;

class OdeContacts final : public ContactManifold {
 public:
  void bind(std::span<const Shape> shapes) override {
    sides_.clear();
    const auto lock = ode::enter();
    for (const Shape& shape : shapes) {
      const Vec3d side = 2 * shape.half_extents;
      sides_.push_back({static_cast<dReal>(side.x()), static_cast<dReal>(side.y()),
                        static_cast<dReal>(side.z()), 0});
    }
  }

  void solve(const PairBatch& batch, std::span<Manifold> manifolds) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
      const ode::Placement at_a(batch.pairs.poses[first]), at_b(batch.pairs.poses[second]);
      std::array<dContactGeom, Manifold::most_points> contacts;
      dVector3 normal;
      dReal depth = 0;
      int code = 0;
      const int count =
          dBoxBox(at_a.position, at_a.rotation, sides_[batch.pairs.shape_of[first]].data(),
                  at_b.position, at_b.rotation, sides_[batch.pairs.shape_of[second]].data(), normal,
                  &depth, &code, Manifold::most_points, contacts.data(), sizeof contacts[0]);
      Manifold& manifold = manifolds[i];
      manifold = {};
      manifold.status = Status::not_reported;
      manifold.answer = count > 0 ? Answer::overlapping : Answer::separated;
      if (count <= 0) continue;
      manifold.normal = {normal[0], normal[1], normal[2]};
      for (const dContactGeom& contact :
           std::span(contacts).first(static_cast<std::size_t>(count))) {
        add(contact, code, manifold);
      }
    }
  }

 private:
  // `code` numbers the axis: up to 3 it is a's, so b's face was clipped; up to 6 it is b's; beyond
  // 6 it belongs to two edges.
  static void add(const dContactGeom& contact, int code, Manifold& manifold) {
    const double part_of_a = code <= 3 ? 1 : code <= 6 ? 0 : 0.5;
    const Vec3d found(contact.pos[0], contact.pos[1], contact.pos[2]);
    ContactPoint& point = manifold.points[static_cast<std::size_t>(manifold.count++)];
    point.depth = contact.depth;
    point.on_a = found + part_of_a * point.depth * manifold.normal;
    point.on_b = found - (1 - part_of_a) * point.depth * manifold.normal;
  }

  std::vector<std::array<dReal, 4>> sides_;
};

std::unique_ptr<ContactManifold> make_box_contacts(const ManifoldSettings&) {
  return std::make_unique<OdeContacts>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<ManifoldEntry> peers_ode_contacts() {
  return {{.info = {.name = "ode-box-contacts",
                    .citation = "ODE 0.16, dBoxBox",
                    .origin = Origin::peer},
           .scalars = {scalar},
           .supports = [](ShapeKind a,
                          ShapeKind b) { return a == ShapeKind::box && b == ShapeKind::box; },
           .make = make_box_contacts}};
}

}  // namespace touchstone::entries
