// The integer GJK of exact_gjk.h.
#include "algorithms/oracle/exact_gjk.h"

namespace touchstone::oracle {
namespace {

constexpr int curved_iterations = 300;

}  // namespace

ExactSearch search_exactly(GridPair& pair, const Hint& hint, const Filters& filters, bool decide) {
  pair.place_exactly();
  ExactSearch search;
  ExactSimplex& simplex = search.simplex;
  for (int i = 0; i < hint.size; ++i) simplex.add(pair, hint.points[i]);
  if (simplex.size == 0) {
    simplex.add(pair, pair.exact_support(make_direction({1, 0, 0}), filters.support));
  }
  for (int iteration = 0;; ++iteration) {
    search.plane = reduce(simplex);
    const NearestPlane& plane = search.plane;
    if (plane.contains_origin) return search;
    const Direction direction = make_direction(-plane.normal);
    const DifferencePoint point = pair.exact_support(direction, filters.support);
    const Integer along = dot(plane.normal, pair.exact(point));
    if (pair.is_curved()) {
      if (decide && along > 0 &&
          pair.support_above(direction, GridPair::root_shift, filters.support) < 0) {
        search.decided = true;
        return search;
      }
      const Integer progress = plane.offset - along;
      if (progress <= 0 || pair.rounded_length(progress, plane.normal) < pair.curved_rounding ||
          iteration == curved_iterations) {
        return search;
      }
    } else {
      if (decide && along > 0) {
        search.decided = true;
        return search;
      }
      if (along >= plane.offset) return search;
    }
    simplex.add(pair, point);
  }
}

}  // namespace touchstone::oracle
