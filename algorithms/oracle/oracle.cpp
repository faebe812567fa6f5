// Runs the oracle's parts in order: the hint in doubles, GJK in integers, EPA in integers.
#include "algorithms/oracle/oracle.h"

#include <utility>

#include "algorithms/oracle/exact_gjk.h"
#include "algorithms/oracle/expander.h"
#include "algorithms/oracle/grid_pair.h"
#include "algorithms/oracle/half_space.h"
#include "algorithms/oracle/hint.h"

namespace touchstone::oracle {
namespace {

Answer answer_of(std::strong_ordering lower, std::strong_ordering upper) {
  if (lower > 0) return Answer::separated;
  if (upper < 0) return Answer::overlapping;
  return lower == 0 && upper == 0 ? Answer::touching : Answer::unknown;
}

// Collects and renumbers the generators that a certificate uses.
class Generators {
 public:
  Generators(const GridCore& core, std::vector<Generator>& list) : core_(core), list_(list) {}
  std::uint32_t number(std::uint32_t generator) {
    if (generator >= numbers_.size()) numbers_.resize(generator + 1, unknown);
    if (numbers_[generator] == unknown) {
      numbers_[generator] = static_cast<std::uint32_t>(list_.size());
      list_.push_back(core_.generator(generator));
    }
    return numbers_[generator];
  }

 private:
  static constexpr std::uint32_t unknown = ~std::uint32_t{0};
  const GridCore& core_;
  std::vector<Generator>& list_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace

struct Oracle::Workspace {
  explicit Workspace(const Filters& f) : filters(f), expander(f) {}

  Filters filters;
  GridPair pair;
  Expander expander;

  ExactMeasure measure(const Body& a, const Body& b, Certificate* certificate);
  void measure_apart(const ExactSearch& search, ExactMeasure& measure, Certificate* certificate);
  void measure_around(const ExactSimplex& simplex, ExactMeasure& measure, Certificate* certificate);
  SignedRoot lower_along(const Direction& direction);
  void write_closest(const ExactSimplex& simplex, Certificate& certificate);
};

Oracle::Oracle(const Filters& filters) : workspace_(std::make_unique<Workspace>(filters)) {}
Oracle::~Oracle() = default;
Oracle::Oracle(Oracle&&) noexcept = default;

Answer Oracle::verdict(const Body& a, const Body& b) {
  Workspace& work = *workspace_;
  using Core = Solid::Core;
  if (a.solid->core == Core::halfspace || b.solid->core == Core::halfspace) {
    return measure(a, b).answer;
  }
  GridPair& pair = work.pair;
  pair.place(a, b);
  const Hint hint = find_hint(pair, work.filters, true);
  if (hint.answer != Answer::unknown) return hint.answer;
  const bool balls = a.solid->radius > 0 || b.solid->radius > 0;
  const ExactSearch search = search_exactly(pair, hint, work.filters, !balls);
  if (search.plane.contains_origin) {
    if (balls || search.simplex.size == 4) return Answer::overlapping;
    work.expander.expand(pair, search.simplex, ExpansionGoal::verdict);
    if (work.expander.has_volume() && work.expander.inside()) return Answer::overlapping;
    if (!pair.is_curved()) return Answer::touching;
  } else {
    if (search.decided) return Answer::separated;
    if (!pair.is_curved() && !balls) return Answer::separated;
  }
  ExactMeasure measure;
  if (search.plane.contains_origin) {
    work.measure_around(search.simplex, measure, nullptr);
  } else {
    work.measure_apart(search, measure, nullptr);
  }
  return answer_of(compare(measure.core_lower, a.solid->radius, b.solid->radius),
                   compare(measure.core_upper, a.solid->radius, b.solid->radius));
}

void Oracle::Workspace::write_closest(const ExactSimplex& simplex, Certificate& certificate) {
  Generators of_a(pair.a, certificate.a), of_b(pair.b, certificate.b);
  for (int i = 0; i < simplex.size; ++i) {
    const DifferencePoint& p = simplex.points[i];
    certificate.closest.push_back({{of_a.number(p.a), of_b.number(p.b)}, simplex.weights[i]});
  }
}

// The lower bound on the cores' signed distance that the direction proves. Curved supports are
// rounded up.
SignedRoot Oracle::Workspace::lower_along(const Direction& direction) {
  const Integer above = pair.support_above(direction, GridPair::root_shift, filters.support);
  const Integer length = dot(direction.exact, direction.exact) << (2 * GridPair::root_shift);
  return pair.in_metres(-above.sign(), above * above, length);
}

void Oracle::Workspace::measure_apart(const ExactSearch& search, ExactMeasure& measure,
                                      Certificate* certificate) {
  const NearestPlane& plane = search.plane;
  const ExactSimplex& simplex = search.simplex;
  // The sum of the weights is |normal|^2 for a triangle. The normal of an edge or a vertex is the
  // nearest point times that sum.
  const Integer numerator = simplex.size == 3 ? Integer(plane.offset * plane.offset) : plane.offset;
  measure.core_upper = pair.in_metres(1, numerator, simplex.weight);
  measure.core_lower = measure.core_upper;
  const Direction direction = make_direction(-plane.normal);
  if (pair.is_curved()) {
    measure.core_lower = lower_along(direction);
  }
  measure.normal = direction.rounded.normalized();
  if (certificate == nullptr) return;
  certificate->direction = direction.exact;
  write_closest(simplex, *certificate);
}

void Oracle::Workspace::measure_around(const ExactSimplex& simplex, ExactMeasure& measure,
                                       Certificate* certificate) {
  expander.expand(pair, simplex, ExpansionGoal::depth);
  const Direction& least = expander.least();
  measure.normal = least.rounded.normalized();
  const bool inside = expander.has_volume() && expander.inside();
  if (inside) {
    const Integer& offset = expander.nearest_offset();
    const IntegerVector& normal = expander.nearest_normal();
    measure.core_upper = pair.in_metres(-1, offset * offset, dot(normal, normal));
  }
  if (!pair.is_curved()) {
    measure.core_lower = measure.core_upper;
  } else {
    measure.core_lower = lower_along(least);
  }
  if (certificate == nullptr) return;
  certificate->direction = least.exact;
  if (!inside) return write_closest(simplex, *certificate);
  certificate->surface = expander.surface();
  Generators of_a(pair.a, certificate->a), of_b(pair.b, certificate->b);
  for (DifferencePoint& p : certificate->surface.points) p = {of_a.number(p.a), of_b.number(p.b)};
}

ExactMeasure Oracle::Workspace::measure(const Body& a, const Body& b, Certificate* certificate) {
  ExactMeasure measure;
  using Core = Solid::Core;
  if (a.solid->core == Core::halfspace || b.solid->core == Core::halfspace) {
    measure = measure_half_space(a, b, pair, filters, certificate);
  } else {
    pair.place(a, b);
    const Hint hint = find_hint(pair, filters, false);
    const ExactSearch search = search_exactly(pair, hint, filters, false);
    if (search.plane.contains_origin) {
      measure_around(search.simplex, measure, certificate);
    } else {
      measure_apart(search, measure, certificate);
    }
  }
  const double radius_a = a.solid->radius, radius_b = b.solid->radius;
  const auto lower_order = compare(measure.core_lower, radius_a, radius_b);
  const DoubleBounds lower = round_less(measure.core_lower, radius_a, radius_b);
  // Polytopes and half-spaces are exact without a comparison: both bounds are the same fraction.
  // For a singular half-space no bound is known.
  const bool curved = a.solid->is_curved() || b.solid->is_curved();
  const bool known = measure.core_upper.sign < 0 || !measure.core_upper.is_infinite();
  measure.exact = known && (!curved || measure.core_lower == measure.core_upper);
  measure.answer = answer_of(
      lower_order, measure.exact ? lower_order : compare(measure.core_upper, radius_a, radius_b));
  measure.lower = lower.low;
  measure.upper =
      measure.exact ? lower.high : round_less(measure.core_upper, radius_a, radius_b).high;
  if (certificate != nullptr) {
    certificate->answer = measure.answer;
    certificate->lower = measure.core_lower;
    certificate->upper = measure.core_upper;
  }
  return measure;
}

Measure Oracle::measure(const Body& a, const Body& b) { return workspace_->measure(a, b, nullptr); }

ExactMeasure Oracle::measure_exactly(const Body& a, const Body& b) {
  return workspace_->measure(a, b, nullptr);
}

Measure Oracle::prove(const Body& a, const Body& b, Certificate& certificate) {
  certificate = {};
  return workspace_->measure(a, b, &certificate);
}

}  // namespace touchstone::oracle
