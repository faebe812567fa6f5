// Exact: points against a triangle mesh in integers, behind the contract of point queries.
// Paper:   none; textbook geometry in integers without a bound on their length.
// Steps:   1. `closest`: leave out the triangles that are too far for certain (box_tree). Of the others, the
//             squared distance to each vertex, to each edge's line where the point is beside the edge, and to
//             each plane where the point is over the triangle; the least of these fractions.
//          2. `side`: cast a ray whose direction is drawn at those that it may meet, and count the triangles
//             that it leaves through less those that it enters through. If it meets an edge, draw another.
// Departs: it shares no code with the algorithms that it judges.
// Fails:   never; the distance and the point are rounded.
// Cost:    O(log n) a point where triangles are small, and some microseconds for each that is asked.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "algorithms/oracle/numbers/dyadic.h"
#include "algorithms/oracle/rays/box_tree.h"
#include "algorithms/oracle/rays/nearest_point.h"
#include "algorithms/oracle/rays/on_grid.h"
#include "algorithms/oracle/rays/ray_triangle.h"
#include "algorithms/point_query.h"

namespace touchstone {
namespace {

using oracle::cross;
using oracle::dot;
using oracle::Integer;
using oracle::is_zero;
using oracle::least_exponent;
using oracle::nearest_of;
using oracle::NearestInTriangle;
using oracle::on_grid;
using oracle::SeenTriangle;
using oracle::operator-;
using oracle::operator+;
using oracle::operator*;
using oracle::IntegerVector;

// The root of top / bottom, whose square may be beyond doubles, times a power of two.
double root_of(const Integer& top, const Integer& bottom, int exponent) {
  if (top.is_zero()) return 0;
  const int half = (static_cast<int>(msb(bottom)) - static_cast<int>(msb(top))) / 2;
  const double square = half >= 0 ? oracle::quotient(top << (2 * half), bottom)
                                  : oracle::quotient(top, bottom << (-2 * half));
  return std::ldexp(std::sqrt(square), exponent - half);
}

// True if the origin is in the closed triangle.
bool has_origin(const SeenTriangle& seen) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto all = [&](int sign) {
      return std::ranges::all_of(seen, [&](const auto& v) { return v[axis].sign() == sign; });
    };
    if (all(1) || all(-1)) return false;
  }
  return nearest_of(seen).top.is_zero();
}

// +1 or -1 if the ray from the origin leaves or enters through the triangle, 0 if it passes by, and
// nothing if it meets its boundary's line of sight.
std::optional<int> crossing(const SeenTriangle& seen, const IntegerVector& direction) {
  int plus = 0, minus = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int sign = dot(direction, cross(seen[k], seen[(k + 1) % 3])).sign();
    plus += sign > 0 ? 1 : 0;
    minus += sign < 0 ? 1 : 0;
  }
  if (plus > 0 && minus > 0) return 0;
  if (plus < 3 && minus < 3) return {};
  const int side = plus == 3 ? 1 : -1;
  return dot(seen[0], cross(seen[1], seen[2])).sign() == side ? side : 0;
}

class ExactPointQuery final : public PointQuery {
 public:
  void bind(const TriangleMesh& mesh) override {
    mesh_ = &mesh;
    tree_.build(mesh.vertices, mesh.triangles);
    mesh_exponent_ = oracle::Dyadic::of_zero;
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t k : triangle) {
        mesh_exponent_ = std::min(mesh_exponent_, least_exponent(mesh.vertices[k]));
      }
    }
  }

  void query(PointTask task, std::span<const Vec3d> points,
             std::span<PointAnswer> answers) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      answers[i] = {};
      answers[i].status = points[i].allFinite() ? Status::ok : Status::degenerate;
      if (!points[i].allFinite()) continue;
      exponent_ = std::min(mesh_exponent_, least_exponent(points[i]));
      if (exponent_ == oracle::Dyadic::of_zero) exponent_ = 0;
      if (task == PointTask::side) {
        answers[i].side = side(points[i]);
      } else {
        find_closest(points[i], answers[i]);
      }
    }
  }

 private:
  SeenTriangle seen(std::uint32_t triangle, const IntegerVector& from) const {
    const auto& [a, b, c] = mesh_->triangles[triangle];
    const auto& vertices = mesh_->vertices;
    return {on_grid(vertices[a], exponent_) - from, on_grid(vertices[b], exponent_) - from,
            on_grid(vertices[c], exponent_) - from};
  }

  void find_closest(const Vec3d& point, PointAnswer& answer) {
    const IntegerVector from = on_grid(point, exponent_);
    tree_.may_be_nearest(point, asked_);
    std::optional<NearestInTriangle> best;
    for (const std::uint32_t triangle : asked_) {
      NearestInTriangle nearest = nearest_of(seen(triangle, from));
      if (best && nearest.top * best->bottom >= best->top * nearest.bottom) continue;
      best = std::move(nearest);
      answer.triangle = triangle;
    }
    if (!best) return;
    answer.distance = root_of(best->top, best->bottom, exponent_);
    for (std::size_t k = 0; k < 3; ++k) {
      answer.closest[static_cast<Eigen::Index>(k)] =
          coordinate(best->scale * from[k] + best->at[k], best->scale);
    }
  }

  // top / bottom on the grid, in metres.
  double coordinate(const Integer& top, const Integer& bottom) const {
    return exponent_ >= 0 ? oracle::quotient(top << exponent_, bottom)
                          : oracle::quotient(top, bottom << -exponent_);
  }

  PointSide side(const Vec3d& point) {
    const IntegerVector from = on_grid(point, exponent_);
    tree_.may_be_nearest(point, asked_);
    for (const std::uint32_t triangle : asked_) {
      if (has_origin(seen(triangle, from))) return PointSide::surface;
    }
    std::mt19937 random(1);
    for (;;) {
      const auto drawn = [&] { return static_cast<int>(random() % 2000001) - 1000000; };
      const int x = drawn(), y = drawn(), z = drawn();
      if (x == 0 && y == 0 && z == 0) continue;
      const IntegerVector direction = {Integer(x), Integer(y), Integer(z)};
      tree_.meet_ray(point, Vec3d(x, y, z), asked_);
      int winding = 0;
      bool is_clear = true;
      for (const std::uint32_t triangle : asked_) {
        const SeenTriangle corners = seen(triangle, from);
        if (is_zero(cross(corners[1] - corners[0], corners[2] - corners[0]))) continue;
        const std::optional<int> crossed = crossing(corners, direction);
        is_clear = is_clear && crossed;
        winding += crossed.value_or(0);
      }
      if (is_clear) return winding != 0 ? PointSide::inside : PointSide::outside;
    }
  }

  const TriangleMesh* mesh_ = nullptr;
  int mesh_exponent_ = 0,
      exponent_ = 0;  // of the grid of the mesh, and of that of the point with it
  oracle::BoxTree tree_;
  std::vector<std::uint32_t> asked_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<PointQueryEntry> oracle_exact_point_query() {
  return {{.info = {.name = "exact",
                    .citation = "Touchstone's oracle: points and triangles in integers",
                    .origin = Origin::oracle},
           .tasks = {PointTask::closest, PointTask::side},
           .make = [] { return std::make_unique<ExactPointQuery>(); }}};
}

}  // namespace touchstone::entries
