// Exact concave: every part of one body against every part of the other, each in exact arithmetic.
// Paper:   README.md states the problem of two convex bodies; a triangle is the hull of its corners.
// Steps:   1. Make a solid of each triangle and each convex part in `bind`.
//          2. Ask the oracle about every pair of parts, one at a time, unless their boxes, rounded
//             outward, are apart.
//          3. Where none share a point and a body is a solid mesh, or has one among its parts, count how
//             often that surface winds around a point of each connected piece or part of the other, in
//             integers (inside, exact_winding).
//          4. distance: the least of all pairs' distances. Boxes, and gaps of triangles in doubles that
//             are rounded down (triangle_gap), exclude most pairs; the pair with the least of these
//             bounds is measured first, and those of which they are not above its distance.
// Departs: -
// Fails:   is quadratic, so it is for bodies of some thousand triangles or some hundred other parts. Curved parts can be unknown, as
//          for `exact`. Poses of parts within turned compounds are rounded; where that hides a
//          verdict the answer is unknown and the status degenerate.
// Cost:    1 to 100 us a pair of parts that is not excluded, some ns for others.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/oracle/answer.h"
#include "algorithms/oracle/concave/inside.h"
#include "algorithms/oracle/concave/triangle_gap.h"

namespace touchstone {
namespace {

using oracle::Body;
using oracle::Measure;
using oracle::Solid;

constexpr double none_found = std::numeric_limits<double>::infinity();

Shape shape_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  Hull hull;
  for (const std::uint32_t corner : mesh.triangles[triangle]) {
    hull.vertices.push_back(mesh.vertices[corner]);
  }
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::make_shared<const Hull>(std::move(hull));
  return shape;
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
  std::vector<Shape> shapes;
  std::vector<Solid> solids;
  std::vector<double> reaches;  // of convex parts, in their own coordinates
  std::vector<oracle::Piece> pieces;
};

// A part in its place, which may be off by `rounding` metres. The box holds it wherever it is.
struct ExactPart {
  Body body;
  double rounding;
  Aabb box;
  std::optional<oracle::RoundedTriangle> triangle = {};
};

Aabb grown(Aabb box, double by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = round_down(double{box.min[axis]} - by);
    box.max[axis] = round_up(double{box.max[axis]} + by);
  }
  return box;
}

// At most the distance of any two points of the boxes.
double gap(const Aabb& a, const Aabb& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double apart = std::max({0.0, double{a.min[axis]} - double{b.max[axis]},
                                   double{b.min[axis]} - double{a.max[axis]}});
    sum += apart * apart;
  }
  return std::sqrt(sum) * (1 - 0x1p-40);
}

class ExactConcave final : public ConcavePhase {
 public:
  void bind(std::span<const ConcaveBody> bodies) override {
    bodies_.clear();
    for (const ConcaveBody& given : bodies) {
      ExactBody& body = bodies_.emplace_back(ExactBody{&given, {}, {}, {}, {}});
      for (std::uint32_t i = 0; given.mesh && i < given.part_count(); ++i) {
        body.shapes.push_back(shape_of(*given.mesh, i));
        body.solids.emplace_back(body.shapes.back());
      }
      body.pieces = oracle::pieces_of(given);
      for (const ConvexPart& part : given.parts) {
        body.shapes.push_back(part.shape);
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
    const std::vector<ExactPart> parts_a = parts(a), parts_b = parts(b);
    for (std::uint32_t i = 0; i < parts_a.size(); ++i) {
      for (std::uint32_t j = 0; j < parts_b.size(); ++j) {
        const bool is_placed = parts_a[i].body.is_finite() && parts_b[j].body.is_finite();
        if (is_placed && !overlap(parts_a[i].box, parts_b[j].box)) continue;
        const Answer answer = verdict(parts_a[i], parts_b[j]);
        if (answer == Answer::unknown) undecided = true;
        if (answer == Answer::touching || answer == Answer::overlapping) pairs.push_back({i, j});
        if (task != ConcaveTask::contacts && !pairs.empty()) break;
      }
      if (task != ConcaveTask::contacts && !pairs.empty()) break;
    }
    if (!pairs.empty() || is_inside(a, b, undecided) || is_inside(b, a, undecided)) {
      outcome.answer = Answer::overlapping;
    } else {
      outcome.answer = undecided ? Answer::unknown : Answer::separated;
    }
    const bool matters = task == ConcaveTask::contacts || outcome.answer == Answer::unknown;
    if (undecided && matters) outcome.status = Status::degenerate;
    if (task == ConcaveTask::distance && outcome.answer == Answer::separated && !parts_a.empty() &&
        !parts_b.empty()) {
      outcome = nearest(parts_a, parts_b);
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
        all.push_back(
            {Body(body.solids[i], placed.pose), 0, tight_box(body.shapes[i], placed.pose)});
        all.back().triangle = oracle::rounded_triangle(all.back().body);
        continue;
      }
      const ConvexPart& part = body.given->parts[i];
      const ComposedPose pose = composed(placed.pose, part.pose, body.reaches[i]);
      const double turned = placed.pose.rotation.cwiseAbs().rowwise().sum().maxCoeff();
      const double rounding = pose.error + 2 * turned * part.rounding;
      all.push_back({Body(body.solids[i], pose.pose), rounding,
                     grown(tight_box(part.shape, pose.pose), rounding)});
    }
    return all;
  }

  Answer verdict(const ExactPart& a, const ExactPart& b) {
    // Products of poses may be beyond doubles.
    if (!a.body.is_finite() || !b.body.is_finite()) return Answer::unknown;
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

  // Pairs of parts whose boxes are no further apart than some points of the bodies are.
  struct Near {
    double gap;
    std::uint32_t a, b;
  };
  static std::vector<Near> near_pairs(const std::vector<ExactPart>& parts_a,
                                      const std::vector<ExactPart>& parts_b) {
    double upper = none_found;
    for (const ExactPart& a : parts_a) {
      for (const ExactPart& b : parts_b) {
        if (!a.triangle || !b.triangle) continue;
        const double apart = (a.triangle->corners[0] - b.triangle->corners[0]).norm();
        upper =
            std::min(upper, apart * (1 + 0x1p-40) + 2 * (a.triangle->error + b.triangle->error));
      }
    }
    std::vector<Near> near;
    for (std::uint32_t i = 0; i < parts_a.size(); ++i) {
      for (std::uint32_t j = 0; j < parts_b.size(); ++j) {
        const double apart = gap(parts_a[i].box, parts_b[j].box);
        if (!(apart > upper)) near.push_back({apart, i, j});
      }
    }
    return near;
  }

  // The distance of bodies of which no parts meet.
  Outcome nearest(const std::vector<ExactPart>& parts_a, const std::vector<ExactPart>& parts_b) {
    std::vector<Near> near = near_pairs(parts_a, parts_b);
    Outcome best;
    best.lower = best.upper = none_found;
    // The pair with the least proven distance comes first: it is mostly the one, and if it is not the
    // order is merely slow.
    double least = none_found;
    const Near* first = nullptr;
    for (Near& pair : near) {
      const auto &a = parts_a[pair.a].triangle, &b = parts_b[pair.b].triangle;
      if (!a || !b || pair.gap > least) continue;
      pair.gap = std::max(pair.gap, oracle::proven_distance(*a, *b, least));
      if (!(pair.gap < least)) continue;
      least = pair.gap;
      first = &pair;
    }
    if (first != nullptr) consider(parts_a[first->a], parts_b[first->b], best);
    std::erase_if(near, [&](const Near& pair) { return pair.gap > best.upper; });
    std::ranges::sort(near, std::less{}, &Near::gap);
    for (const Near& pair : near) {
      if (pair.gap > best.upper) break;
      consider(parts_a[pair.a], parts_b[pair.b], best);
    }
    return best;
  }

  bool is_inside(const PlacedConcave& inner, const PlacedConcave& outer, bool only_exact) const {
    const ExactBody& body = bodies_[inner.body];
    return oracle::is_inside(*body.given, body.pieces, inner.pose, *bodies_[outer.body].given,
                             outer.pose, only_exact);
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
