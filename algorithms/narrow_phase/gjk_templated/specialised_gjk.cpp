// Part of gjk-templated: collects the table from the files that compile its parts.
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.h"

#include "algorithms/narrow_phase/gjk_templated/specialised_parts.h"

namespace touchstone {

template <class Scalar>
CoreTable<Scalar> specialised_functions() {
  CoreTable<Scalar> table{};
  add_points(table);
  add_segments_and_hulls(table);
  add_boxes_and_ellipsoids(table);
  add_cylinders_and_cones(table);
  return table;
}

template CoreTable<float> specialised_functions();
template CoreTable<double> specialised_functions();

}  // namespace touchstone
