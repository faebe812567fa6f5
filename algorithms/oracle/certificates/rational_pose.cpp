// Poses from matrices and quaternions, and their products.
#include "algorithms/oracle/certificates/rational_pose.h"

namespace touchstone::oracle {

RationalVector RationalPose::operator()(const RationalVector& x) const {
  return RationalVector{dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)} + translation;
}

RationalPose rational_pose(const Pose& pose) {
  RationalPose exact;
  for (int i = 0; i < 3; ++i) exact.rows[i] = rational_vector(Vec3d(pose.rotation.row(i)));
  exact.translation = rational_vector(pose.translation);
  return exact;
}

RationalPose rational_pose(const Body& body) {
  if (!body.quaternion) return rational_pose(Pose{body.matrix, body.translation});
  const auto& q = *body.quaternion;
  const mpq_class w = rational(q[0]);
  const RationalVector v = {rational(q[1]), rational(q[2]), rational(q[3])};
  const mpq_class square = w * w + dot(v, v);
  require(square != 0, "a quaternion is zero");
  RationalPose exact;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    exact.rows[i][i] = (w * w + v[i] * v[i] - v[j] * v[j] - v[k] * v[k]) / square;
    exact.rows[i][j] = 2 * (v[i] * v[j] - w * v[k]) / square;
    exact.rows[i][k] = 2 * (v[i] * v[k] + w * v[j]) / square;
  }
  exact.translation = rational_vector(body.translation);
  return exact;
}

RationalPose composed(const RationalPose& outer, const RationalPose& inner) {
  RationalPose product;
  for (int i = 0; i < 3; ++i) {
    const RationalVector& row = outer.rows[i];
    product.rows[i] = row[0] * inner.rows[0] + row[1] * inner.rows[1] + row[2] * inner.rows[2];
  }
  product.translation = outer(inner.translation);
  return product;
}

}  // namespace touchstone::oracle
