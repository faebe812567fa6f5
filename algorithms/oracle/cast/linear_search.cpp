// The search for the time of impact in integers.
#include "algorithms/oracle/cast/linear_search.h"

#include <algorithm>

#include "algorithms/oracle/numbers/square_root.h"

namespace touchstone::oracle {
namespace {

// Adds points to the simplex until none is nearer to the origin, and returns the nearest point of it.
// `add` adds a least point along a direction, `drop` takes the last one back.
template <class Add, class Drop>
RationalPoint nearest_point(std::vector<IntegerVector>& simplex, int& iterations, const Add& add,
                            const Drop& drop) {
  for (;;) {
    ++iterations;
    RationalPoint nearest = reduce_to_nearest(simplex);
    const IntegerVector& z = nearest.numerator;
    if (is_zero(z)) return nearest;
    add(z);
    if (dot(z, simplex.back()) * nearest.denominator < dot(z, z)) continue;
    drop();
    return nearest;
  }
}

}  // namespace

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
  const Integer square = dot(z, z), speed = dot(z, cores_.velocity()) * nearest_.denominator;
  const auto steps_with = [&](unsigned bits) {
    const Integer root = root_below(square << 2 * bits) + 1;
    const Integer gap = (square << bits) - radius_ * nearest_.denominator * root;
    return Integer(gap / (speed << bits) - 1);
  };
  // Balls that graze each other are nearer than a unit's root tells.
  Integer found = steps_with(0);
  if (found < 64 && !radius_.is_zero()) found = steps_with(MovingCores::time_bits * 2);
  return found;
}

bool LinearSearch::was_free() const {
  return dot(nearest_.numerator, cores_.velocity()) >= 0 || is_free(-1);
}

LinearSearch::Passing LinearSearch::passing() const {
  const IntegerVector& v = cores_.velocity();
  const Integer square = dot(v, v);
  // All is seen along the path, `square` times as large, so that the point stands at the origin.
  const auto seen = [&](const IntegerVector& p) { return square * p - dot(p, v) * v; };
  std::vector<IntegerVector> simplex;
  std::vector<MovingCores::Point> known;
  const auto add = [&](const IntegerVector& n) {
    known.push_back(cores_.least(n));
    simplex.push_back(seen(known.back().difference));
  };
  add(seen({1, 0, 0}));
  RationalPoint nearest = nearest_point(simplex, iterations_, add, [&] { simplex.pop_back(); });
  const IntegerVector& z = nearest.numerator;
  const Integer reach = cores_.radius() * square * nearest.denominator;
  if (dot(z, z) > reach * reach) return {{}, z};
  LinearContact contact;
  Integer sum = 0;
  for (std::size_t i = 0; i < simplex.size(); ++i) {
    const auto point = std::ranges::find_if(
        known, [&](const MovingCores::Point& one) { return seen(one.difference) == simplex[i]; });
    contact.feature.push_back(point->of);
    contact.steps += nearest.weights[i] * dot(point->difference, v);
    sum += nearest.weights[i];
  }
  contact.parts = sum * square;
  contact.weights = std::move(nearest.weights);
  return {std::move(contact), z};
}

void LinearSearch::find_nearest() {
  if (simplex_.empty()) add({1, 0, 0});
  nearest_ = nearest_point(
      simplex_, iterations_, [&](const IntegerVector& n) { add(n); },
      [&] {
        simplex_.pop_back();
        known_.pop_back();
      });
}

void LinearSearch::add(const IntegerVector& n) {
  MovingCores::Point point = cores_.least(n);
  point.difference = scale_ * point.difference;
  simplex_.push_back(point.difference - time_ * cores_.velocity());
  known_.push_back(std::move(point));
}

LinearImpact find_impact(LinearSearch& search, int most_times) {
  const Integer end = Integer(1) << MovingCores::time_bits;
  LinearImpact impact;
  search.go_to(0);
  if (search.in_contact()) {
    impact.answer = CastAnswer::hit;
    impact.contact = search.contact();
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
      impact.contact = search.contact();
      return impact;
    }
    if (!proven && !search.was_free()) {
      // A contact between the two times lasts for less than a step. The times of contact are an interval, so that the
      // one time at which the bodies are nearest tells.
      LinearSearch::Passing passing = search.passing();
      if (!passing.contact) {
        impact.answer = CastAnswer::miss;
        impact.parted.push_back({passing.plane, end});
      } else if (passing.contact->steps > before * passing.contact->parts &&
                 passing.contact->steps < search.time() * passing.contact->parts) {
        impact.answer = CastAnswer::hit;
        impact.lower = before;
        impact.contact = *std::move(passing.contact);
      }
      return impact;
    }
    // Without a proof by the plane before the step, the one behind it is.
    impact.parted.push_back({proven ? z : search.nearest().numerator, search.time()});
  }
  return impact;
}

}  // namespace touchstone::oracle
