// How the cases of each axis are drawn: regime.parameter is the axis' value; for axes.cpp.
#pragma once

#include "harness/check/regimes/regimes.h"

namespace touchstone::check {

RegimeCase draw_at_scale(RegimeDraw& draw);       // the longest side of both bodies, metres
RegimeCase draw_at_aspect(RegimeDraw& draw);      // the longest side over the shortest
RegimeCase draw_at_distance(RegimeDraw& draw);    // of the first body's origin, metres
RegimeCase draw_at_ratio(RegimeDraw& draw);       // the size of one body over that of the other
RegimeCase draw_at_gap(RegimeDraw& draw);         // as a part of the pair's size
RegimeCase draw_at_depth(RegimeDraw& draw);       // as a part of the pair's size
RegimeCase draw_with_vertices(RegimeDraw& draw);  // of one hull, or of both

// How far a cap of many facets bulges out of its rim's plane, or how far the faces of two boxes
// side by side are from one plane; as a part of the size.
RegimeCase draw_near_coplanar(RegimeDraw& draw);
// The angle between two edges, sides or faces in contact, radians.
RegimeCase draw_near_parallel(RegimeDraw& draw);

}  // namespace touchstone::check
