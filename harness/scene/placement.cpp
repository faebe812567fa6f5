// Reads rotations and translations.
#include "harness/scene/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/reproducible_math.h"

namespace touchstone::scene {
namespace {

// Reads a row-major matrix. It is used as given if it is a rotation to a thousandth.
Mat3d read_matrix(files::TomlTable& table) {
  const std::vector<double> m = table.numbers("rotation", 9, files::any_number);
  Mat3d rotation;
  rotation << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
  const double error = (rotation.transpose() * rotation - Mat3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= 1e-3) || rotation.determinant() < 0) {
    table.fail("rotation", fmt::format("the columns are not orthonormal or not right-handed (off "
                                       "by {:.3g}); expected a rotation matrix, row by row",
                                       error));
  }
  return rotation;
}

Mat3d read_rotation(files::TomlTable& table) {
  if (table.has("rotation")) {
    if (table.contains("quaternion_wxyz")) {
      table.fail("quaternion_wxyz", "given beside rotation; expected one of the two");
    }
    return read_matrix(table);
  }
  if (!table.has("quaternion_wxyz")) return Mat3d::Identity();
  const std::vector<double> q = table.numbers("quaternion_wxyz", 4, files::any_number);
  // The numbers are scaled first, so that no square overflows or underflows.
  const double size = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
  if (!(size > 0)) {
    table.fail("quaternion_wxyz", "found [0, 0, 0, 0]; expected a quaternion that is not zero");
  }
  return base::rotation_of({q[0] / size, q[1] / size, q[2] / size, q[3] / size});
}

}  // namespace

Pose read_pose(files::TomlTable& table) {
  Pose pose;
  pose.rotation = read_rotation(table);
  pose.translation = table.vector("translation", files::any_number, Vec3d::Zero());
  return pose;
}

}  // namespace touchstone::scene
