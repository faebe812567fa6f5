// Part of the oracle: the first time within a distance, by algebraic numbers.
#include "algorithms/oracle/ccd/first_within.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algorithms/oracle/ccd/separation_polynomials.h"

namespace touchstone::oracle::ccd {
namespace {

bool are_within(const PartPolynomials& part, WithinTime& time) {
  const auto has_sign = [&](const Sextic& p) { return time.sign_of(p) >= 0; };
  return std::ranges::all_of(part.spans, [&](const Sextic& p) { return time.sign_of(p) > 0; }) &&
         has_sign(part.within) && std::ranges::all_of(part.inside, has_sign);
}

// A time at which two parts may come within the distance.
struct Candidate {
  WithinTime time;
  const PartPolynomials* part;
};

// The distance is continuous, so at the first time after 0 it is the separation, between two parts of
// which `within` is 0 then. If that is 0 at all times, what begins is that the nearest points lie in the
// parts: one of `inside` has a root.
std::vector<Candidate> candidates(const std::vector<PartPolynomials>& parts) {
  std::vector<Candidate> all;
  for (const PartPolynomials& part : parts) {
    const auto add = [&](const Sextic& p) {
      if (p.degree < 1) return;
      for (WithinTime& time : roots_of(p)) all.push_back({std::move(time), &part});
    };
    if (part.within.is_zero()) {
      std::ranges::for_each(part.inside, add);
    } else {
      add(part.within);
    }
  }
  sort_by_time(all, [](Candidate& candidate) -> WithinTime& { return candidate.time; });
  return all;
}

}  // namespace

std::optional<WithinTime> first_within(const MovingFeatures& features, double separation) {
  const std::vector<PartPolynomials> parts = separation_polynomials(features, separation);
  WithinTime start(Cell{0, 0, true});
  for (const PartPolynomials& part : parts) {
    if (are_within(part, start)) return start;
  }
  for (Candidate& candidate : candidates(parts)) {
    if (are_within(*candidate.part, candidate.time)) return std::move(candidate.time);
  }
  return {};
}

Impact impact_within(const MovingFeatures& features, double separation) {
  if (are_apart_along_an_axis(features, separation)) return {};
  std::optional<WithinTime> time = first_within(features, separation);
  if (!time) return {};
  const TimeBounds bounds = time->bounds();
  return {true, bounds.low, bounds.high};
}

}  // namespace touchstone::oracle::ccd
