// Pieces, edges and winding numbers of meshes. A ray goes up from the point, and each triangle that it crosses
// counts.
#include "algorithms/oracle/certificates/parts/rational_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace touchstone::oracle {
namespace {

// -1, 0 or 1; GMP's cmp has other numbers too.
int order(const mpq_class& x, const mpq_class& y) {
  const int found = cmp(x, y);
  return (found > 0 ? 1 : 0) - (found < 0 ? 1 : 0);
}

// On which side of the line from u to v the moved point is, as seen from above, 1 or -1; 0 if u is over v.
int side(const RationalVector& u, const RationalVector& v, const RationalVector& point) {
  const mpq_class ux = u[0] - point[0], uy = u[1] - point[1];
  const mpq_class vx = v[0] - point[0], vy = v[1] - point[1];
  if (const int area = sgn(mpq_class(ux * vy - uy * vx)); area != 0) return area;
  // The area's derivatives when the point moves along x and along y.
  if (const int along_x = order(uy, vy); along_x != 0) return along_x;
  return order(vx, ux);
}

}  // namespace

RationalMesh::RationalMesh(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
  vertices_.reserve(mesh.vertices.size());
  for (const Vec3d& vertex : mesh.vertices) vertices_.push_back(rational_vector(vertex));
  for (const auto& corners : triangles_) {
    for (const std::uint32_t corner : corners) {
      require(corner < vertices_.size(), "a triangle of the mesh names no vertex");
    }
  }
}

RationalTriangle RationalMesh::triangle(std::size_t number) const {
  const auto& [a, b, c] = triangles_[number];
  return {vertices_[a], vertices_[b], vertices_[c]};
}

void RationalMesh::require_closed() const {
  std::map<std::pair<RationalVector, RationalVector>, int> balance;
  for (std::size_t i = 0; i < size(); ++i) {
    const RationalTriangle corners = triangle(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const RationalVector &tail = corners[k], &head = corners[(k + 1) % 3];
      if (tail == head) continue;
      const bool forward = tail < head;
      balance[forward ? std::pair(tail, head) : std::pair(head, tail)] += forward ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) require(sum == 0, "the surface is open");
}

std::vector<std::uint32_t> RationalMesh::one_of_each_piece() const {
  std::vector<std::uint32_t> least(vertices_.size());
  std::iota(least.begin(), least.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (least[v] != v) v = least[v] = least[least[v]];
    return v;
  };
  for (const auto& corners : triangles_) {
    for (const std::uint32_t corner : {corners[1], corners[2]}) {
      const auto [low, high] = std::minmax({root(corners[0]), root(corner)});
      least[high] = low;
    }
  }
  std::vector<std::uint32_t> pieces;
  std::vector<bool> is_there(vertices_.size());
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const std::uint32_t piece = root(triangles_[i][0]);
    if (!is_there[piece]) pieces.push_back(i);
    is_there[piece] = true;
  }
  return pieces;
}

RationalMesh RationalMesh::placed(const RationalPose& pose) const {
  RationalMesh moved = *this;
  for (RationalVector& vertex : moved.vertices_) vertex = pose(vertex);
  return moved;
}

int RationalMesh::winding(const RationalVector& point) const {
  int turns = 0;
  for (const auto& [a, b, c] : triangles_) {
    const RationalVector &p = vertices_[a], &q = vertices_[b], &r = vertices_[c];
    // The ray passes triangles that are left or right of it, or below the point.
    const auto all = [&](std::size_t axis, int sign) {
      return order(p[axis], point[axis]) == sign && order(q[axis], point[axis]) == sign &&
             order(r[axis], point[axis]) == sign;
    };
    if (all(0, -1) || all(0, 1) || all(1, -1) || all(1, 1) || all(2, -1)) continue;
    const int turn = side(p, q, point);
    if (turn == 0 || turn != side(q, r, point) || turn != side(r, p, point)) continue;
    // The triangle is above the point if the volume has the sign of the turn.
    if (sgn(dot(p - point, cross(q - point, r - point))) == turn) turns += turn;
  }
  return turns;
}

}  // namespace touchstone::oracle
