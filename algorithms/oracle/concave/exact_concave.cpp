// Exact concave: every part of one body against every part of the other, each in exact arithmetic.
// Paper:   README.md states the problem of two convex bodies; a triangle is the hull of its corners.
// Steps:   1. Make a solid of each triangle and each convex part in `bind`.
//          2. Ask the oracle about every pair of parts, one at a time.
//          3. Where none share a point and a body is a solid mesh, count how often its surface winds
//             around a point of each triangle or part of the other, in integers (exact_winding).
//          4. distance: the least of all pairs' distances.
// Departs: -
// Fails:   is quadratic, so it is for bodies of some hundred parts. Curved parts can be unknown, as
//          for `exact`. Poses of parts within turned compounds are rounded; where that hides a
//          verdict the answer is unknown and the status degenerate.
// Cost:    1 to 100 us a pair of parts.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/oracle/answer.h"
#include "algorithms/oracle/concave/exact_winding.h"

namespace touchstone {
namespace {

using oracle::Body;
using oracle::Measure;
using oracle::Solid;

constexpr double none_found = std::numeric_limits<double>::infinity();

Solid solid_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  Hull hull;
  for (const std::uint32_t corner : mesh.triangles[triangle]) {
    hull.vertices.push_back(mesh.vertices[corner]);
  }
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::make_shared<const Hull>(std::move(hull));
  return Solid(shape);
}

double reach_of_shape(const Shape& shape) {
  const Aabb box = tight_box(shape, Pose{});
  double reach = 0;
  for (const auto& corner : {box.min, box.max}) {
    for (const float x : corner) {
      if (std::isfinite(x)) reach = std::max(reach, double{std::abs(x)});
    }
  }
  return reach;
}

struct ExactBody {
  const ConcaveBody* given;
  std::vector<Solid> solids;
  std::vector<double> reaches;  // of convex parts, in their own coordinates
};

// A part in its place, which may be off by `rounding` metres.
struct ExactPart {
  Body body;
  double rounding;
};

class ExactConcave final : public ConcavePhase {
 public:
  void bind(std::span<const ConcaveBody> bodies) override {
    bodies_.clear();
    for (const ConcaveBody& given : bodies) {
      ExactBody& body = bodies_.emplace_back(ExactBody{&given, {}, {}});
      for (std::uint32_t i = 0; given.mesh && i < given.part_count(); ++i) {
        body.solids.push_back(solid_of(*given.mesh, i));
      }
      for (const ConvexPart& part : given.parts) {
        body.solids.emplace_back(part.shape);
        body.reaches.push_back(reach_of_shape(part.shape));
      }
    }
  }

  void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    outcome.status = Status::ok;
    pairs.clear();
    bool undecided = false;
    Outcome nearest;
    nearest.lower = nearest.upper = none_found;
    const std::vector<ExactPart> parts_a = parts(a), parts_b = parts(b);
    for (std::uint32_t i = 0; i < parts_a.size(); ++i) {
      for (std::uint32_t j = 0; j < parts_b.size(); ++j) {
        const Answer answer = verdict(parts_a[i], parts_b[j]);
        if (answer == Answer::unknown) undecided = true;
        if (answer == Answer::touching || answer == Answer::overlapping) pairs.push_back({i, j});
        if (task != ConcaveTask::contacts && !pairs.empty()) break;
        if (task == ConcaveTask::distance && answer == Answer::separated) {
          consider(parts_a[i], parts_b[j], nearest);
        }
      }
      if (task != ConcaveTask::contacts && !pairs.empty()) break;
    }
    if (!pairs.empty() || is_inside(a, b) || is_inside(b, a)) {
      outcome.answer = Answer::overlapping;
    } else {
      outcome.answer = undecided ? Answer::unknown : Answer::separated;
    }
    const bool matters = task == ConcaveTask::contacts || outcome.answer == Answer::unknown;
    if (undecided && matters) outcome.status = Status::degenerate;
    if (task == ConcaveTask::distance && outcome.answer == Answer::separated &&
        nearest.upper < none_found) {
      outcome = nearest;
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
    }
  }

 private:
  std::vector<ExactPart> parts(const PlacedConcave& placed) const {
    const ExactBody& body = bodies_[placed.body];
    std::vector<ExactPart> all;
    for (std::size_t i = 0; i < body.solids.size(); ++i) {
      if (body.given->mesh) {
        all.push_back({Body(body.solids[i], placed.pose), 0});
        continue;
      }
      const ConvexPart& part = body.given->parts[i];
      const ComposedPose pose = composed(placed.pose, part.pose, body.reaches[i]);
      const double turned = placed.pose.rotation.cwiseAbs().rowwise().sum().maxCoeff();
      all.push_back({Body(body.solids[i], pose.pose), pose.error + 2 * turned * part.rounding});
    }
    return all;
  }

  Answer verdict(const ExactPart& a, const ExactPart& b) {
    const double rounding = a.rounding + b.rounding;
    if (rounding == 0) return oracle_.verdict(a.body, b.body);
    const Measure measure = oracle_.measure(a.body, b.body);
    if (measure.lower > rounding) return Answer::separated;
    return measure.upper < -rounding ? Answer::overlapping : Answer::unknown;
  }

  void consider(const ExactPart& a, const ExactPart& b, Outcome& nearest) {
    Outcome found;
    oracle::answer(oracle_, a.body, b.body, Task::distance, found);
    const double rounding = a.rounding + b.rounding;
    const double lower = std::min(nearest.lower, found.lower - rounding);
    if (found.upper + rounding < nearest.upper) {
      nearest = found;
      nearest.upper = found.upper + rounding;
    }
    nearest.lower = lower;
  }

  // True if a piece of `inner` is inside of `outer`'s surface; they do not meet on it.
  bool is_inside(const PlacedConcave& inner, const PlacedConcave& outer) const {
    const ConcaveBody &body = *bodies_[inner.body].given, &around = *bodies_[outer.body].given;
    if (!around.mesh || !around.mesh->solid) return false;
    const auto winds = [&](const Vec3d& point, const Pose& pose) {
      return oracle::exact_winding(*around.mesh, outer.pose, point, pose) != 0;
    };
    if (body.mesh) {
      return std::ranges::any_of(body.mesh->triangles, [&](const auto& corners) {
        return winds(body.mesh->vertices[corners[0]], inner.pose);
      });
    }
    return std::ranges::any_of(body.parts, [&](const ConvexPart& part) {
      if (part.shape.kind == ShapeKind::halfspace) return false;
      const Vec3d point =
          part.shape.kind == ShapeKind::hull ? part.shape.hull->vertices[0] : Vec3d::Zero();
      return winds(point, composed(inner.pose, part.pose, 0).pose);
    });
  }

  std::vector<ExactBody> bodies_;
  oracle::Oracle oracle_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<ConcaveEntry> oracle_exact_concave() {
  return {{.info = {.name = "exact",
                    .citation = "Touchstone's oracle on every pair of parts; winding numbers in "
                                "integers",
                    .origin = Origin::oracle},
           .tasks = {ConcaveTask::intersect, ConcaveTask::distance, ConcaveTask::contacts},
           .scalars = {Precision::float64},
           .make = [](const ConcaveSettings&) { return std::make_unique<ExactConcave>(); }}};
}

}  // namespace touchstone::entries
