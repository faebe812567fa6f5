// The functions that draw the cases of each axis, for axes.cpp. regime.parameter is the value:
#pragma once

#include "harness/check/regimes/regimes.h"

namespace touchstone::check {

RegimeCase draw_at_scale(RegimeDraw& draw);       // longest side of both bodies, metres
RegimeCase draw_at_aspect(RegimeDraw& draw);      // longest side over shortest
RegimeCase draw_at_distance(RegimeDraw& draw);    // distance of a from the origin, metres
RegimeCase draw_at_ratio(RegimeDraw& draw);       // size of one body over that of the other
RegimeCase draw_at_gap(RegimeDraw& draw);         // part of the pair's size
RegimeCase draw_at_depth(RegimeDraw& draw);       // part of the pair's size
RegimeCase draw_with_vertices(RegimeDraw& draw);  // vertices of one hull, or of both

// Draws a cap of many facets that bulges out of its rim's plane by the value, or two boxes side by
// side whose faces miss one plane by it; the value is a part of the size.
RegimeCase draw_near_coplanar(RegimeDraw& draw);
// Draws two edges, sides or faces in contact at the angle, radians.
RegimeCase draw_near_parallel(RegimeDraw& draw);

}  // namespace touchstone::check
