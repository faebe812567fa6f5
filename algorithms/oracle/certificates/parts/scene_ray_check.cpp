// Walks over the covers of bodies and of their parts, and looks at the part that is hit.
#include "algorithms/oracle/certificates/parts/scene_ray_check.h"

#include <cmath>
#include <utility>

#include "algorithms/oracle/certificates/parts/body_box.h"

namespace touchstone::oracle {
namespace {

using RayStep = SceneRayCertificate::Step;
using StepKind = RayStep::Kind;

mpq_class time_of(const TimeFraction& fraction) {
  require(fraction.denominator > 0, "the denominator of a time is not positive");
  return oracle::rational(fraction.numerator) / oracle::rational(fraction.denominator);
}

bool is_zero_time(const TimeFraction& time) { return time.numerator == 0 && time.denominator == 1; }

// A walk over a tree that ends where the steps do. `is_parted` says whether a plane parts the ray from a box, and
// `at_leaf` sees to any step at one body or part but to halve it.
template <class IsParted, class AtLeaf>
class CoverWalk {
 public:
  CoverWalk(const std::vector<RayStep>& steps, const PartTree& tree, const IsParted& is_parted,
            const AtLeaf& at_leaf)
      : steps_(steps), tree_(tree), is_parted_(is_parted), at_leaf_(at_leaf) {}

  void run() {
    from(tree_.root());
    require(next_ == steps_.size(), "the cover is too long");
  }

 private:
  void from(const PartNode& node) {
    require(next_ < steps_.size(), "the cover is too short");
    const RayStep& step = steps_[next_++];
    if (step.kind == StepKind::halve) {
      require(!node.is_leaf(), "what is single is halved");
      from(node.first_half());
      return from(node.second_half());
    }
    if (node.is_leaf()) return at_leaf_(step, tree_.part(node));
    require(step.kind == StepKind::plane, "that step is not for a group");
    require(tree_.box(node).has_value(), "a plane does not part an unbounded group");
    require(is_parted_(rational_vector(step.direction), *tree_.box(node)),
            "a plane does not part the ray from a group");
  }

  const std::vector<RayStep>& steps_;
  const PartTree& tree_;
  const IsParted& is_parted_;
  const AtLeaf& at_leaf_;
  std::size_t next_ = 0;
};

void require_part_is_free(const RayStep& step, const PlacedParts& parts, std::uint32_t part,
                          const RaySpan& span) {
  if (step.kind == StepKind::triangle) {
    const auto triangle = triangle_of(parts, part);
    require(triangle.has_value(), "the part is no triangle");
    return require(span.passes(*triangle), "the ray meets a triangle before");
  }
  const RationalCore core = parts.core(part);
  RationalVector n = rational_vector(step.direction);
  if (step.kind == StepKind::own_plane) {
    require(core.is_halfspace(), "the part is no half-space");
    n = mpq_class(-1) * core.normal();
  } else {
    require(step.kind == StepKind::plane, "that is no step for a part");
  }
  const auto reach = core.support(mpq_class(-1) * n);
  require(reach && span.is_parted(n, *reach, parts.radius(part)),
          "a plane does not part the ray from a part");
}

void require_parts_are_free(const SceneRayCertificate::Cover& cover, const PlacedParts& parts,
                            const RaySpan& span, const PartUntil* hit) {
  const PartTree tree(cover.order, parts.boxes());
  if (parts.size() == 0) return require(cover.steps.empty(), "the cover is too long");
  CoverWalk(
      cover.steps, tree,
      [&](const RationalVector& n, const RationalBox& box) {
        return span.is_parted(n, parts.support(mpq_class(-1) * n, box), parts.greatest_radius());
      },
      [&](const RayStep& step, std::uint32_t part) {
        const bool is_hit = hit != nullptr && hit->part == part;
        require_part_is_free(step, parts, part, is_hit ? span.until(hit->end) : span);
      })
      .run();
}

}  // namespace

CheckedScene::CheckedScene(std::vector<PlacedBody> bodies)
    : bodies_(std::move(bodies)), parts_(bodies_.size()) {
  try {
    for (const PlacedBody& placed : bodies_) {
      boxes_.push_back(world_box(placed.body, placed.pose));
      require(!has_rounded_places(placed.body),
              "the places of parts are rounded, so that nothing is proven");
    }
  } catch (const Fault& found) {
    invalid_ = found.what();
  }
}

std::string CheckedScene::fault(const SceneRayCertificate& certificate) {
  if (!invalid_.empty()) return invalid_;
  try {
    require_proven(certificate);
  } catch (const Fault& found) {
    return found.what();
  }
  return {};
}

const PlacedParts& CheckedScene::parts_of(std::uint32_t body) {
  std::unique_ptr<PlacedParts>& parts = parts_[body];
  if (!parts) parts = std::make_unique<PlacedParts>(bodies_[body].body, bodies_[body].pose);
  return *parts;
}

void CheckedScene::require_proven(const SceneRayCertificate& certificate) {
  RaySpan span{rational_vector(certificate.origin), rational_vector(certificate.direction), {}};
  require(!is_zero(span.direction), "the direction of the ray is zero");
  require(!std::isnan(certificate.t_max) && certificate.t_max > -HUGE_VAL,
          "the end of the ray is no number");
  std::optional<mpq_class> t_max;
  if (std::isfinite(certificate.t_max)) t_max = rational(certificate.t_max);
  const bool is_miss = certificate.answer == CastAnswer::miss;
  const bool is_hit = certificate.answer == CastAnswer::hit;
  require(is_miss || is_hit || certificate.answer == CastAnswer::unknown, "that is no answer");
  const mpq_class lower = time_of(certificate.lower), upper = time_of(certificate.upper);
  require(lower >= 0, "the lower bound is no time of the ray");
  require(!is_miss || is_zero_time(certificate.lower), "a miss has no time");
  if (is_hit) {
    require(lower <= upper && (!t_max || upper <= *t_max),
            "the upper bound is no time of the ray behind the lower one");
    require(certificate.is_first || lower == 0, "any hit has no lower bound");
    require(certificate.body < bodies_.size(), "the hit is at no body");
    const PlacedParts& parts = parts_of(certificate.body);
    require(certificate.part < parts.size(), "the hit is at no part");
    require(has_point(parts, certificate.part, span.at(upper), certificate.generators,
                      certificate.surface),
            "the part does not have the point of the upper bound");
  } else {
    require(is_zero_time(certificate.upper) && certificate.body == 0 && certificate.part == 0 &&
                certificate.generators.empty() && certificate.surface.points.empty() &&
                certificate.surface.triangles.empty(),
            "what is no hit names a part or a time of it");
  }
  require(certificate.is_ordered || (is_hit && certificate.is_first),
          "only a first hit may be without order");
  span.end = is_miss ? t_max : lower;
  span.is_closed = is_miss;
  std::optional<PartUntil> hit;
  if (is_hit && certificate.is_first && certificate.is_ordered) {
    span.end = upper;
    hit = {certificate.body, certificate.part, lower};
  }
  const bool is_empty = span.end && (is_miss ? *span.end < 0 : *span.end == 0);
  if (is_empty) {
    return require(certificate.cover.order.empty() && certificate.cover.steps.empty() &&
                       certificate.of_bodies.empty(),
                   "a cover is there without need");
  }
  require_free(certificate, span, hit ? &*hit : nullptr);
}

void CheckedScene::require_free(const SceneRayCertificate& certificate, const RaySpan& span,
                                const PartUntil* hit) {
  const PartTree tree(certificate.cover.order, boxes_);
  const auto is_parted = [&](const RationalVector& n, const RationalBox& box) {
    return span.is_parted(n, support(mpq_class(-1) * n, box), 0);
  };
  std::size_t seen = 0;
  const auto at_body = [&](const RayStep& step, std::uint32_t body) {
    if (step.kind == StepKind::plane) {
      require(boxes_[body].has_value(), "a plane does not part an unbounded body");
      return require(is_parted(rational_vector(step.direction), *boxes_[body]),
                     "a plane does not part the ray from a body");
    }
    require(step.kind == StepKind::body, "that is no step for a body");
    require(seen < certificate.of_bodies.size(), "a body has no cover");
    require_parts_are_free(certificate.of_bodies[seen++], parts_of(body), span,
                           hit != nullptr && hit->body == body ? hit : nullptr);
  };
  if (bodies_.empty()) {
    require(certificate.cover.steps.empty(), "the cover is too long");
  } else {
    CoverWalk(certificate.cover.steps, tree, is_parted, at_body).run();
  }
  require(seen == certificate.of_bodies.size(), "there are covers of no body");
}

}  // namespace touchstone::oracle
