// Moeller-Trumbore: the textbook's test of a triangle, on the wide tree.
// Paper:   Moeller, Trumbore, "Fast, minimum storage ray-triangle intersection", JGT 2, 1997.
// Steps:   1. Build a tree of the triangles' boxes.
//          2. Walk it from near to far, one box after the other.
//          3. In a leaf, solve origin + t * direction = (1 - u - v) a + u b + v c by Cramer's rule, and
//             take the hit if u, v and 1 - u - v are not negative.
// Departs: no epsilon is compared with the determinant; zero alone is a miss. All is calculated in the
//          scalar that is asked for, and nothing is done about its rounding.
// Fails:   rays slip through at edges and vertices, and are hit beside open edges, by the rounding.
//          A ray in a triangle's plane, and a triangle without area, are never hit. A ray in the
//          plane of a box's face may pass the box by.
// Cost:    O(log n) a ray where triangles are small; 46 bytes a triangle.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/kernels/bvh/wide_bvh.h"
#include "algorithms/ray_cast.h"

namespace touchstone {
namespace {

template <class Scalar>
class MollerTrumbore final : public RayCast {
 public:
  void bind(const TriangleMesh& mesh) override {
    triangles_ = &mesh.triangles;
    vertices_.clear();
    for (const Vec3d& v : mesh.vertices) vertices_.push_back(v.cast<Scalar>());
    std::vector<Aabb> boxes(mesh.triangles.size(), Aabb::empty());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      for (const std::uint32_t number : mesh.triangles[k]) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto x = static_cast<double>(vertices_[number][static_cast<int>(axis)]);
          boxes[k].min[axis] = std::min(boxes[k].min[axis], round_down(x));
          boxes[k].max[axis] = std::max(boxes[k].max[axis], round_up(x));
        }
      }
    }
    tree_ = build_wide_bvh(boxes);
  }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = answer(task, rays[i]);
  }

 private:
  using Vec = Vec3<Scalar>;
  struct Line {
    Vec origin, direction, inverse;
    Scalar end;  // t_max, then the t of the best hit
  };

  RayHit answer(RayTask task, const Ray& ray) const {
    RayHit best;
    best.status = Status::not_reported;
    Line line{ray.origin.cast<Scalar>(),
              ray.direction.cast<Scalar>(),
              {},
              static_cast<Scalar>(ray.t_max)};
    line.inverse = line.direction.cwiseInverse();
    if (!line.origin.allFinite() || !line.direction.allFinite() || line.direction.isZero(0) ||
        std::isnan(line.end)) {
      best.status = Status::degenerate;
      return best;
    }
    std::array<Open, WideBvh::most_open> open;
    std::size_t count = 0;
    if (!tree_.nodes.empty()) open[count++] = {0, 0};
    while (count > 0) {
      const Open now = open[--count];
      if (now.near > line.end) continue;
      if (!WideNode::is_leaf(now.child)) {
        push_children(tree_.nodes[static_cast<std::size_t>(now.child)], line, open, count);
        continue;
      }
      for (const std::uint32_t number : tree_.leaf(WideNode::leaf(now.child))) {
        if (test(number, line, best) && task == RayTask::any) return best;
      }
    }
    return best;
  }

  struct Open {
    std::int32_t child;
    Scalar near;
  };

  // Pushes the children that the line meets, the nearest last.
  static void push_children(const WideNode& node, const Line& line,
                            std::array<Open, WideBvh::most_open>& open, std::size_t& count) {
    const std::size_t first = count;
    for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
      if (node.child[lane] == WideNode::no_child) break;
      Scalar near = 0, far = line.end;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<int>(axis);
        const Scalar a =
            (static_cast<Scalar>(node.planes[axis][lane]) - line.origin[k]) * line.inverse[k];
        const Scalar b =
            (static_cast<Scalar>(node.planes[axis + 3][lane]) - line.origin[k]) * line.inverse[k];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
      }
      if (!(near <= far)) continue;
      std::size_t at = count++;
      for (; at > first && open[at - 1].near < near; --at) open[at] = open[at - 1];
      open[at] = {node.child[lane], near};
    }
  }

  bool test(std::uint32_t number, Line& line, RayHit& best) const {
    const auto& [i, j, k] = (*triangles_)[number];
    const Vec ab = vertices_[j] - vertices_[i], ac = vertices_[k] - vertices_[i];
    const Vec p = line.direction.cross(ac);
    const Scalar determinant = ab.dot(p);
    if (determinant == 0) return false;
    const Vec to = line.origin - vertices_[i];
    const Scalar u = to.dot(p) / determinant;
    const Vec q = to.cross(ab);
    const Scalar v = line.direction.dot(q) / determinant;
    const Scalar t = ac.dot(q) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= line.end)) return false;
    if (best.hit && t == line.end && number > best.triangle) return false;
    best.hit = true;
    best.triangle = number;
    best.t = static_cast<double>(t);
    best.u = static_cast<double>(u);
    best.v = static_cast<double>(v);
    line.end = t;
    return true;
  }

  const std::vector<std::array<std::uint32_t, 3>>* triangles_ = nullptr;
  std::vector<Vec> vertices_;
  WideBvh tree_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<RayCastEntry> ray_cast_moller_trumbore() {
  return {{.info = {.name = "moller-trumbore",
                    .citation = "Moeller, Trumbore, \"Fast, minimum storage ray-triangle "
                                "intersection\", JGT 2, 1997",
                    .known_defect = "rounding decides at edges and vertices; misses triangles seen "
                                    "edge-on and degenerate ones"},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float32, Precision::float64},
           .make = [](const RayCastSettings& settings) -> std::unique_ptr<RayCast> {
             if (settings.scalar == Precision::float32) {
               return std::make_unique<MollerTrumbore<float>>();
             }
             return std::make_unique<MollerTrumbore<double>>();
           }}};
}

}  // namespace touchstone::entries
