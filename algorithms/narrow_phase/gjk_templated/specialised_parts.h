// Part of gjk-templated: the parts of the table of specialised_gjk.h, seven pairs of cores each,
// named after the first of the two. Each has a file of its own, so that they compile in parallel.
#pragma once

#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.h"

namespace touchstone {

void add_points(CoreTable<float>& table);
void add_points(CoreTable<double>& table);
void add_segments_and_hulls(CoreTable<float>& table);
void add_segments_and_hulls(CoreTable<double>& table);
void add_boxes_and_ellipsoids(CoreTable<float>& table);
void add_boxes_and_ellipsoids(CoreTable<double>& table);
void add_cylinders_and_cones(CoreTable<float>& table);
void add_cylinders_and_cones(CoreTable<double>& table);

}  // namespace touchstone
