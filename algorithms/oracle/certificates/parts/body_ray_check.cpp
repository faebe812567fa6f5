// Walks over the cover of the parts, and looks at the one that is hit.
#include "algorithms/oracle/certificates/parts/body_ray_check.h"

#include <cmath>

#include "algorithms/oracle/certificates/parts/ray_at_parts.h"

namespace touchstone::oracle {
namespace {

using RayStep = BodyRayCertificate::Step::Kind;

mpq_class time_of(const TimeFraction& fraction) {
  require(fraction.denominator > 0, "the denominator of a time is not positive");
  return oracle::rational(fraction.numerator) / oracle::rational(fraction.denominator);
}

class CheckedCover {
 public:
  CheckedCover(const BodyRayCertificate& certificate, const PlacedParts& parts, const RaySpan& span)
      : cover_(certificate.cover),
        parts_(parts),
        tree_(certificate.order, parts.boxes()),
        span_(span) {}

  void require_free() {
    if (parts_.size() > 0) walk(tree_.root());
    require(next_ == cover_.size(), "the cover is too long");
  }

 private:
  void walk(const PartNode& node) {
    require(next_ < cover_.size(), "the cover is too short");
    const BodyRayCertificate::Step& step = cover_[next_++];
    if (step.kind == RayStep::halve) {
      require(!node.is_leaf(), "a single part is halved");
      walk(node.first_half());
      return walk(node.second_half());
    }
    if (step.kind == RayStep::plane && !node.is_leaf()) {
      const RationalVector n = rational_vector(step.direction);
      require(tree_.box(node).has_value(), "a plane does not part an unbounded group");
      const mpq_class reach = parts_.support(mpq_class(-1) * n, *tree_.box(node));
      require(span_.is_parted(n, reach, parts_.greatest_radius()),
              "a plane does not part the ray from a group");
      return;
    }
    require(node.is_leaf(), "that step is for one part");
    const std::uint32_t part = tree_.part(node);
    if (step.kind == RayStep::triangle) {
      const auto triangle = triangle_of(parts_, part);
      require(triangle.has_value(), "the part is no triangle");
      require(span_.passes(*triangle), "the ray meets a triangle before");
      return;
    }
    const RationalCore core = parts_.core(part);
    RationalVector n = rational_vector(step.direction);
    if (step.kind == RayStep::own_plane) {
      require(core.is_halfspace() && !is_zero(core.normal()), "the part is no half-space");
      n = mpq_class(-1) * core.normal();
    } else {
      require(step.kind == RayStep::plane, "that is no step");
    }
    const auto reach = core.support(mpq_class(-1) * n);
    require(reach && span_.is_parted(n, *reach, parts_.radius(part)),
            "a plane does not part the ray from a part");
  }

  const std::vector<BodyRayCertificate::Step>& cover_;
  const PlacedParts& parts_;
  PartTree tree_;
  const RaySpan& span_;
  std::size_t next_ = 0;
};

bool is_zero_time(const TimeFraction& time) { return time.numerator == 0 && time.denominator == 1; }

}  // namespace

CheckedBody::CheckedBody(const PlacedBody& body) {
  try {
    parts_.emplace(body.body, body.pose);
    require(!parts_->is_rounded(), "the places of parts are rounded, so that nothing is proven");
  } catch (const Fault& found) {
    invalid_ = found.what();
  }
}

std::string CheckedBody::fault(const BodyRayCertificate& certificate) const {
  if (!invalid_.empty()) return invalid_;
  try {
    require_proven(certificate);
  } catch (const Fault& found) {
    return found.what();
  }
  return {};
}

void CheckedBody::require_proven(const BodyRayCertificate& certificate) const {
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
    require(certificate.part < parts_->size(), "the hit is at no part");
    require(has_point(*parts_, certificate.part, span.at(upper), certificate.generators,
                      certificate.surface),
            "the part does not have the point of the upper bound");
  } else {
    require(is_zero_time(certificate.upper) && certificate.part == 0 &&
                certificate.generators.empty() && certificate.surface.points.empty() &&
                certificate.surface.triangles.empty(),
            "what is no hit names a part or a time of it");
  }
  span.end = is_miss ? t_max : lower;
  span.is_closed = is_miss;
  const bool is_empty = span.end && (is_miss ? *span.end < 0 : *span.end == 0);
  if (is_empty) {
    require(certificate.cover.empty() && certificate.order.empty(),
            "a cover is there without need");
    return;
  }
  CheckedCover(certificate, *parts_, span).require_free();
}

}  // namespace touchstone::oracle
