// Wide BVH: the nearest of eight boxes at once, and the side of a surface by exact signs.
// Paper:   Wald, Benthin, Boulos, "Getting rid of packets", RT 2008 (wide nodes); Ericson, "Real-time
//          collision detection", 2005, 5.1 (closest points); Edelsbrunner, Muecke, "Simulation of
//          simplicity", TOG 9, 1990; Shewchuk, DCG 18, 1997.
// Steps:   1. `bind` builds the tree that wide-bvh casts rays with (kernels/rays).
//          2. `closest` walks the nodes from near to far while a box is nearer than the best point, and
//             takes the nearest of a triangle's interior and its three edges.
//          3. `side` walks the triangles above the point, and counts those that turn up less those that
//             turn down, by signs that are filtered in doubles and exact where that decides nothing.
// Fails:   the distance is that of a rounded point, off by up to 4e-15 of the coordinates' size. The
//          status of `side` is `degenerate` where numbers beyond 2^-120 or 2^120 are in doubt.
// Cost:    O(log n) a point near the surface; more where much of it is equally far.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "algorithms/kernels/rays/ray_walk.h"
#include "algorithms/kernels/rays/winding_query.h"
#include "algorithms/point_query.h"

namespace touchstone {
namespace {

using ray_tree::RayMesh;

// The point of the triangle's plane that is nearest to p is a + v ab + w ac.
struct Weights {
  double v, w;

  bool inside() const { return v > 0 && w > 0 && v + w < 1; }
};
// `to` is p - a; the normal is ab x ac, and its square is not zero.
Weights weights_of(const Vec3d& to, const Vec3d& ab, const Vec3d& ac, const Vec3d& normal,
                   double square) {
  return {to.cross(ac).dot(normal) / square, ab.cross(to).dot(normal) / square};
}

// The nearest point of the plane, if it is in the triangle. The normal of a thin triangle is off by a
// part of itself, about the rounding over the sine of its angle at a, and the weights with it. What is
// left of p - a gives their correction, which is off by the same part of itself.
std::optional<Vec3d> closest_inside(const Vec3d& p, const Vec3d& a, const Vec3d& ab,
                                    const Vec3d& ac, bool& thin) {
  const Vec3d normal = ab.cross(ac);
  const double square = normal.squaredNorm();
  thin = !(square > 0.01 * ab.squaredNorm() * ac.squaredNorm());
  if (!(square > 0)) return std::nullopt;
  Weights weights = weights_of(p - a, ab, ac, normal, square);
  constexpr int most_corrections = 8;
  for (int i = 0; thin && i < most_corrections; ++i) {
    const Vec3d left = p - (a + weights.v * ab + weights.w * ac);
    const auto [v, w] = weights_of(left, ab, ac, normal, square);
    weights = {weights.v + v, weights.w + w};
    if (std::abs(v) + std::abs(w) < 0x1p-52) break;
  }
  if (!weights.inside()) return std::nullopt;
  return a + weights.v * ab + weights.w * ac;
}

// Every point that it considers is one of the triangle, but for rounding. Of a triangle so thin that its
// normal is nothing but rounding, the point inside may be any, and an edge's is near enough.
Vec3d closest_of(const Vec3d& p, const RayMesh::Corners& corners) {
  const auto& [a, b, c] = corners;
  bool thin = false;
  const std::optional<Vec3d> inside = closest_inside(p, a, b - a, c - a, thin);
  if (inside && !thin) return *inside;
  Vec3d best = inside.value_or(a);
  double least = (p - best).squaredNorm();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &from = corners[k], &end = corners[(k + 1) % 3];
    const Vec3d edge = end - from;
    const double length = edge.squaredNorm();
    if (!(length > 0)) continue;
    const double s = std::clamp((p - from).dot(edge) / length, 0.0, 1.0);
    const Vec3d at = s < 1 ? Vec3d(from + s * edge) : end;
    const double away = (p - at).squaredNorm();
    if (away < least) {
      least = away;
      best = at;
    }
  }
  return best;
}

class WideBvhPoints final : public PointQuery {
 public:
  void bind(const TriangleMesh& mesh) override { mesh_.emplace(mesh, Precision::float64); }

  void query(PointTask task, std::span<const Vec3d> points,
             std::span<PointAnswer> answers) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      answers[i] = {};
      answers[i].status = points[i].allFinite() ? Status::ok : Status::degenerate;
      if (task == PointTask::closest && answers[i].status == Status::ok && mesh_->triangles() > 0) {
        find_closest(points[i], answers[i]);
      }
    }
    if (task == PointTask::side) find_sides(points, answers);
  }

 private:
  // Points that are finite, by the triangles above them, block by block.
  void find_sides(std::span<const Vec3d> points, std::span<PointAnswer> answers) const {
    std::vector<WindingQuery> queries;
    std::vector<PointAnswer*> asked;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (answers[i].status == Status::ok) {
        queries.emplace_back(points[i]);
        asked.push_back(&answers[i]);
      }
      if (queries.size() == ray_tree::RayBlock::most ||
          (i + 1 == points.size() && !queries.empty())) {
        if (mesh_->triangles() > 0) ray_tree::wind_each(*mesh_, queries);
        for (std::size_t k = 0; k < queries.size(); ++k) {
          if (queries[k].is_undecided()) {
            asked[k]->status = Status::degenerate;
          } else {
            asked[k]->side = queries[k].is_on_surface()  ? PointSide::surface
                             : queries[k].winding() != 0 ? PointSide::inside
                                                         : PointSide::outside;
          }
        }
        queries.clear();
        asked.clear();
      }
    }
  }

  struct Open {
    std::int32_t child;
    float square;  // of the distance to its box, in the tree's frame
  };

  void find_closest(const Vec3d& point, PointAnswer& answer) const {
    const ray_tree::Frame& frame = mesh_->frame();
    const Vec3d local = (point - frame.centre) * frame.scale;
    const std::array<float, 3> at = {static_cast<float>(local[0]), static_cast<float>(local[1]),
                                     static_cast<float>(local[2])};
    // Distances to boxes are off by the roundings of the point, of a corner and of a difference, squares by three
    // more: 2^-20 of what is compared is more than all.
    const double reach = 1 + local.cwiseAbs().maxCoeff();
    double best = std::numeric_limits<double>::infinity();  // square, in the mesh's units
    float limit = std::numeric_limits<float>::infinity();
    std::array<Open, WideBvh::most_open> stack;
    std::size_t open = 0;
    stack[open++] = {0, 0};
    while (open > 0) {
      const Open now = stack[--open];
      if (now.square > limit) continue;
      if (!WideNode::is_leaf(now.child)) {
        push(mesh_->tree().nodes[static_cast<std::size_t>(now.child)], at, limit, stack, open);
        continue;
      }
      const ray_tree::Leaf& leaf = mesh_->leaves()[WideNode::leaf(now.child)];
      const std::array<float, 8> squares = squares_of(leaf, at);
      // The triangle whose box is nearest comes first, since it often leaves the others out.
      std::size_t first = 0;
      for (std::size_t lane = 1; lane < 8; ++lane) {
        if (squares[lane] < squares[first]) first = lane;
      }
      for (std::size_t turn = 0; turn < 8; ++turn) {
        const std::size_t lane = turn == 0 ? first : (turn <= first ? turn - 1 : turn);
        if (!(squares[lane] <= limit)) continue;  // lanes without a triangle have NaN
        const Vec3d found = closest_of(point, mesh_->corners(leaf, lane));
        const double square = (point - found).squaredNorm();
        if (!(square < best) && answer.triangle != PointAnswer::no_triangle) continue;
        best = square;
        answer.triangle = leaf.triangle[lane];
        answer.closest = found;
        const double distance = std::sqrt(square) * frame.scale + reach * 0x1p-20;
        limit = static_cast<float>(distance * distance * (1 + 0x1p-20));
      }
    }
    answer.distance = (point - answer.closest).stableNorm();
  }

  // The squared distances of a leaf's triangles' boxes.
  static std::array<float, 8> squares_of(const ray_tree::Leaf& leaf,
                                         const std::array<float, 3>& at) {
    std::array<float, 8> square{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto &a = leaf.corners[axis], &b = leaf.corners[3 + axis], &c = leaf.corners[6 + axis];
      for (std::size_t lane = 0; lane < 8; ++lane) {
        const float below = std::min(std::min(a[lane], b[lane]), c[lane]) - at[axis];
        const float above = at[axis] - std::max(std::max(a[lane], b[lane]), c[lane]);
        const float away = std::max(std::max(below, above), 0.0F);
        square[lane] += away * away;
      }
    }
    return square;
  }

  // Pushes the children within the limit, the nearest last.
  static void push(const WideNode& node, const std::array<float, 3>& at, float limit,
                   std::array<Open, WideBvh::most_open>& stack, std::size_t& open) {
    std::array<float, WideNode::fan> square{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
        const float below = node.planes[axis][lane] - at[axis];
        const float above = at[axis] - node.planes[axis + 3][lane];
        const float away = std::max(std::max(below, above), 0.0F);
        square[lane] += away * away;
      }
    }
    const std::size_t first = open;
    for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
      if (node.child[lane] == WideNode::no_child) break;
      if (square[lane] > limit) continue;
      std::size_t place = open++;
      for (; place > first && stack[place - 1].square < square[lane]; --place) {
        stack[place] = stack[place - 1];
      }
      stack[place] = {node.child[lane], square[lane]};
    }
  }

  std::optional<RayMesh> mesh_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<PointQueryEntry> point_query_wide_bvh_points() {
  return {{.info = {.name = "wide-bvh",
                    .citation = "Wald, Benthin, Boulos, RT 2008; Ericson 2005; Edelsbrunner, "
                                "Muecke, TOG 9, 1990; exact by Shewchuk's expansions"},
           .tasks = {PointTask::closest, PointTask::side},
           .make = [] { return std::make_unique<WideBvhPoints>(); }}};
}

}  // namespace touchstone::entries
