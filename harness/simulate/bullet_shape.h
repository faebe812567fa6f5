// Bullet's shapes for the shapes of a scene, with their masses. Only for this room, and where Bullet is built.
#pragma once

#include <memory>
#include <vector>

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include "harness/scene/scene.h"

namespace touchstone::simulate {

// A shape around its centre of mass, as Bullet wants it, and what it is made of.
struct BulletShape {
  std::unique_ptr<btCollisionShape> shape;
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::vector<btScalar> vertices;
  std::vector<int> corners;
  std::unique_ptr<btTriangleIndexVertexArray> arrays;
  Vec3d centre = Vec3d::Zero();  // of mass, in the body's coordinates (metres)
  double volume = 0;             // cubic metres; 0 of flat bodies and half-spaces
};

// The shape of bodies that stay, or of bodies that may move.
BulletShape bullet_shape(const scene::Scene& scene, std::uint32_t shape, bool moves);

}  // namespace touchstone::simulate
