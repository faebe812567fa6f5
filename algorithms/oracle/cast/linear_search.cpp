// The search for the time of impact in integers.
#include "algorithms/oracle/cast/linear_search.h"

#include <algorithm>

#include "algorithms/oracle/numbers/square_root.h"

namespace touchstone::oracle {

std::vector<DifferencePoint> LinearSearch::feature() const {
  std::vector<DifferencePoint> points;
  for (const IntegerVector& point : simplex_) {
    const IntegerVector at_start = point + time_ * cores_.velocity();
    const auto known = std::ranges::find(known_, at_start, &MovingCores::Point::difference);
    if (known != known_.end()) points.push_back(known->of);
  }
  return points;
}

void LinearSearch::go_to(const Integer& time) {
  const IntegerVector moved = (time - time_) * cores_.velocity();
  for (IntegerVector& point : simplex_) point = point - moved;
  time_ = time;
  find_nearest();
}

bool LinearSearch::in_contact() const {
  const Integer reach = radius_ * nearest_.denominator;
  return dot(nearest_.numerator, nearest_.numerator) <= reach * reach;
}

bool LinearSearch::is_free(const Integer& steps) const {
  const IntegerVector& z = nearest_.numerator;
  const Integer square = dot(z, z);
  const Integer gap = square - steps * dot(z, cores_.velocity()) * nearest_.denominator;
  const Integer reach = radius_ * nearest_.denominator;
  return gap > 0 && gap * gap > reach * reach * square;
}

Integer LinearSearch::steps() const {
  const IntegerVector& z = nearest_.numerator;
  const Integer square = dot(z, z);
  const Integer root = root_below(square) + 1;
  const Integer gap = square - radius_ * nearest_.denominator * root;
  return gap / (dot(z, cores_.velocity()) * nearest_.denominator) - 1;
}

bool LinearSearch::was_free() const {
  return dot(nearest_.numerator, cores_.velocity()) >= 0 || is_free(-1);
}

void LinearSearch::find_nearest() {
  if (simplex_.empty()) add({1, 0, 0});
  for (;;) {
    ++iterations_;
    nearest_ = reduce_to_nearest(simplex_);
    const IntegerVector& z = nearest_.numerator;
    if (is_zero(z)) return;
    add(z);
    if (dot(z, simplex_.back()) * nearest_.denominator < dot(z, z)) continue;
    simplex_.pop_back();
    known_.pop_back();
    return;
  }
}

void LinearSearch::add(const IntegerVector& n) {
  MovingCores::Point point = cores_.least(n);
  point.difference = scale_ * point.difference;
  simplex_.push_back(point.difference - time_ * cores_.velocity());
  known_.push_back(std::move(point));
}

LinearImpact find_impact(LinearSearch& search) {
  constexpr int most_times = 4000;
  const Integer end = Integer(1) << MovingCores::time_bits;
  LinearImpact impact;
  search.go_to(0);
  if (search.in_contact()) {
    impact.answer = CastAnswer::hit;
    if (!is_zero(search.nearest().numerator)) impact.plane = search.nearest().numerator;
    return impact;
  }
  for (int k = 0; k < most_times; ++k) {
    // The bodies are apart at the search's time, and were before.
    const Integer left = end - search.time();
    const IntegerVector z = search.nearest().numerator;
    if (search.is_free(left)) {
      impact.answer = CastAnswer::miss;
      impact.parted.push_back({z, end});
      return impact;
    }
    impact.plane = z;
    Integer steps = search.steps();
    if (steps < 1) steps = 1;
    const bool proven = search.is_free(steps);
    const Integer before = search.time();
    search.go_to(before + (steps < left ? steps : left));
    if (search.in_contact()) {
      // With a proof up to that time this cannot be, so that the step was one.
      if (proven) return impact;
      impact.answer = CastAnswer::hit;
      impact.lower = before;
      impact.upper = search.time();
      return impact;
    }
    if (!proven && !search.was_free()) return impact;
    // Without a proof by the plane before the step, the one behind it is.
    impact.parted.push_back({proven ? z : search.nearest().numerator, search.time()});
  }
  return impact;
}

}  // namespace touchstone::oracle
