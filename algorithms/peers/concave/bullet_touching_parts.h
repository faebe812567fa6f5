// Part of bullet-mesh and bullet-gimpact: what Bullet finds of two bodies with parts.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {

// Collects the pairs of parts of each contact of the first body and the second. Bullet may ask with the
// bodies in either order; numbers are told to the body that they belong to.
struct TouchingParts final : btManifoldResult {
  std::vector<IndexPair>& pairs;
  // With a list, contacts with a triangle are kept too: their normals go from it to the convex body.
  std::vector<PartContact>* contacts = nullptr;
  bool welds = false;
  bool numbered_a, numbered_b;  // false for a body of one part, of which Bullet gives no number

  TouchingParts(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, bool number_a,
                bool number_b, std::vector<IndexPair>& list)
      : btManifoldResult(a, b), pairs(list), numbered_a(number_a), numbered_b(number_b) {
    m_partId0 = m_partId1 = m_index0 = m_index1 = -1;
  }
  void addContactPoint(const btVector3& normal, const btVector3& point,
                       btScalar distance) override {
    if (!(distance <= 0)) return;
    const auto number = [](bool numbered, int index) {
      return numbered ? static_cast<std::uint32_t>(index) : 0;
    };
    pairs.push_back({number(numbered_a, m_index0), number(numbered_b, m_index1)});
    if (contacts != nullptr) keep(normal, point, distance);
  }

 private:
  void keep(const btVector3& normal, const btVector3& point, btScalar distance) {
    const bool first = is_triangle(m_body0Wrap);
    if (!first && !is_triangle(m_body1Wrap)) return;
    const btCollisionObjectWrapper& triangle = first ? *m_body0Wrap : *m_body1Wrap;
    btManifoldPoint at({0, 0, 0}, triangle.getWorldTransform().invXform(point), normal, distance);
    at.m_positionWorldOnB = point;
    at.m_positionWorldOnA = point + distance * normal;
    if (welds) {
      btAdjustInternalEdgeContacts(at, &triangle, first ? m_body1Wrap : m_body0Wrap,
                                   first ? m_partId0 : m_partId1, first ? m_index0 : m_index1);
    }
    PartContact& contact = contacts->emplace_back();
    contact.parts = pairs.back();
    contact.status = Status::not_reported;
    contact.depth = -double{at.getDistance()};
    contact.normal = from_bullet(at.m_normalWorldOnB);
    contact.point = from_bullet((at.m_positionWorldOnA + at.m_positionWorldOnB) / 2);
  }
  static bool is_triangle(const btCollisionObjectWrapper* body) {
    return body->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE;
  }
};

}  // namespace touchstone::bullet
