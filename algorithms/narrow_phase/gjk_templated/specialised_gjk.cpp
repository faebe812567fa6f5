// Part of gjk-templated: collects the table from the files that compile its parts.
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.h"

#include "algorithms/narrow_phase/gjk_templated/specialised_parts.h"

namespace touchstone {

template <class Scalar>
CoreTable<Scalar> walks_of_known_cores() {
  CoreTable<Scalar> table{};
  add_points(table);
  add_segments_and_hulls(table);
  add_boxes_and_ellipsoids(table);
  add_cylinders_and_cones(table);
  return table;
}

template CoreTable<float> walks_of_known_cores();
template CoreTable<double> walks_of_known_cores();

}  // namespace touchstone
