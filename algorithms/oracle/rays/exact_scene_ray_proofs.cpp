// The exact cast says which part is hit, and about when. Brackets around that are tried, the narrowest first.
#include "algorithms/oracle/rays/exact_scene_ray_proofs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/oracle/certificates/parts/body_box.h"
#include "algorithms/oracle/rays/ray_planes.h"
#include "algorithms/scene_ray_cast.h"

namespace touchstone::entries {
std::vector<SceneRayCastEntry> oracle_exact_scene_ray_cast();
}  // namespace touchstone::entries

namespace touchstone::oracle {
namespace {

using StepKind = SceneRayCertificate::Step::Kind;

std::vector<std::optional<RationalBox>> boxes_of(const std::vector<PlacedBody>& bodies) {
  std::vector<std::optional<RationalBox>> boxes;
  boxes.reserve(bodies.size());
  for (const PlacedBody& placed : bodies) boxes.push_back(world_box(placed.body, placed.pose));
  return boxes;
}

}  // namespace

struct SceneRayProver::Solver {
  std::vector<SceneBody> bodies;
  std::unique_ptr<SceneRayCast> cast = entries::oracle_exact_scene_ray_cast().front().make();
};

SceneRayProver::SceneRayProver(std::vector<PlacedBody> bodies)
    : bodies_(std::move(bodies)),
      boxes_(boxes_of(bodies_)),
      order_(spatial_order(boxes_)),
      tree_(order_, boxes_),
      at_(bodies_.size()),
      solver_(std::make_unique<Solver>()) {
  for (const auto& box : boxes_) {
    if (box) reach_ = std::max(reach_, reach_of(*box));
  }
  for (const PlacedBody& placed : bodies_) {
    solver_->bodies.push_back({placed.body, placed.pose});
    has_rounded_ = has_rounded_ || has_rounded_places(placed.body);
  }
  solver_->cast->bind(solver_->bodies);
}

SceneRayProver::~SceneRayProver() = default;

BodyAtRays& SceneRayProver::at(std::uint32_t body) {
  std::unique_ptr<BodyAtRays>& made = at_[body];
  if (!made) made = std::make_unique<BodyAtRays>(bodies_[body].body, bodies_[body].pose);
  return *made;
}

std::optional<SceneRayCertificate> SceneRayProver::prove(const Vec3d& origin,
                                                         const Vec3d& direction, double t_max,
                                                         bool is_first) {
  if (has_rounded_) return {};
  const Ray ray = {origin, direction, t_max};
  SceneRayHit hit;
  solver_->cast->cast(is_first ? RayTask::closest : RayTask::any, {&ray, 1}, {&hit, 1});
  if (hit.status == Status::degenerate) return {};
  SceneRayCertificate certificate;
  certificate.origin = origin;
  certificate.direction = direction;
  certificate.t_max = t_max;
  certificate.is_first = is_first;
  RaySpan span{rational_vector(origin), rational_vector(direction), {}};
  if (hit.hit) {
    certificate.part = hit.part;
    const bool has_upper = at(hit.body).write_upper(span, hit.t, certificate);
    certificate.body = has_upper ? hit.body : 0;
    if (!has_upper) certificate.part = 0;
    certificate.answer = has_upper ? CastAnswer::hit : CastAnswer::unknown;
    if (is_first || !has_upper) write_lower(span, hit.t, has_upper, certificate);
    return certificate;
  }
  if (hit.status != Status::ok) return certificate;
  certificate.answer = CastAnswer::miss;
  if (std::isfinite(t_max)) span.end = rational(t_max);
  if (span.end && *span.end < 0) return certificate;
  if (!write_cover(span, nullptr, certificate)) certificate.answer = CastAnswer::unknown;
  return certificate;
}

void SceneRayProver::write_lower(const RaySpan& ray, double t, bool has_upper,
                                 SceneRayCertificate& certificate) {
  const mpq_class about = rational(t);
  std::vector<mpq_class> times;
  if (has_upper) {
    times.push_back(rational(certificate.upper.numerator) /
                    rational(certificate.upper.denominator));
  }
  for (const int bits : bits_of_brackets) {
    times.push_back(about - about / mpq_class(mpz_class(1) << static_cast<mp_bitcnt_t>(bits)));
  }
  // With the others free until the upper bound; or else no order is claimed.
  for (const bool is_ordered : {true, false}) {
    certificate.is_ordered = is_ordered || !has_upper;
    if (is_ordered && !has_upper) continue;
    for (const mpq_class& time : times) {
      const RaySpan span = ray.until(is_ordered ? times.front() : time);
      const PartUntil hit{certificate.body, certificate.part, time};
      if (*span.end > 0 && !write_cover(span, is_ordered ? &hit : nullptr, certificate)) continue;
      certificate.lower = time_fraction(time);
      return;
    }
  }
}

bool SceneRayProver::write_cover(const RaySpan& span, const PartUntil* hit,
                                 SceneRayCertificate& certificate) {
  certificate.cover = {order_, {}};
  certificate.of_bodies.clear();
  if (bodies_.empty() || walk(span, hit, tree_.root(), certificate)) return true;
  certificate.cover = {};
  certificate.of_bodies.clear();
  return false;
}

bool SceneRayProver::walk(const RaySpan& span, const PartUntil* hit, const PartNode& node,
                          SceneRayCertificate& certificate) {
  std::vector<SceneRayCertificate::Step>& steps = certificate.cover.steps;
  if (const auto& box = tree_.box(node)) {
    const auto parted = plane_off(span, way_of(span, reach_), RoundedGroup(*box, Pose{}), 0,
                                  [&](const RationalVector& n) {
                                    return span.is_parted(n, support(mpq_class(-1) * n, *box), 0);
                                  });
    if (parted) {
      steps.push_back({StepKind::plane, *parted});
      return true;
    }
  }
  if (node.is_leaf()) {
    steps.push_back({StepKind::body, {}});
    // Covers are in the order of the steps, and none is written within another.
    SceneRayCertificate::Cover& cover = certificate.of_bodies.emplace_back();
    const std::uint32_t body = tree_.part(node);
    return at(body).write_cover(span, hit != nullptr && hit->body == body ? hit : nullptr, cover);
  }
  steps.push_back({StepKind::halve, {}});
  return walk(span, hit, node.first_half(), certificate) &&
         walk(span, hit, node.second_half(), certificate);
}

}  // namespace touchstone::oracle
