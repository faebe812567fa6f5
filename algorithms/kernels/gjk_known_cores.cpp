#include "algorithms/kernels/gjk_known_cores.h"

#include "algorithms/kernels/gjk_known_cores_parts.h"

namespace touchstone {

template <class Scalar>
ApproachTable<Scalar> approaches_of_known_cores() {
  ApproachTable<Scalar> table{};
  add_points(table);
  add_segments_and_hulls(table);
  add_boxes_and_ellipsoids(table);
  add_cylinders_and_cones(table);
  return table;
}

template ApproachTable<float> approaches_of_known_cores();
template ApproachTable<double> approaches_of_known_cores();

}  // namespace touchstone
