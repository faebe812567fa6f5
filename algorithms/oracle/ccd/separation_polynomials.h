// Part of the oracle: the polynomials in time whose signs say whether two moving features are within a
// distance of each other. Included by first_within.cpp.
//
// The features are a vertex and a triangle, or two edges. Their nearest points are inside of two parts of
// them: vertices, edges, the triangle. So they are within the distance where two parts are whose lines or
// planes are, and whose points nearest to each other lie in both parts.
//   two vertices          s^2 - |x - y|^2 >= 0
//   a vertex and an edge  s^2 e.e - |w x e|^2 >= 0, and 0 <= w.e <= e.e
//   a vertex and a face   s^2 n.n - (n.w)^2 >= 0, and the vertex is above the face
//   two edges             s^2 n.n - (n.w)^2 >= 0, and so 0 <= a, b <= n.n of the places on both edges
// where e is the edge, n the normal (the cross product of two edges) and w the way between two points.
// Parts that have no length or area at a time say nothing then: e.e or n.n is 0, and smaller parts tell.
// Source: Ericson, Real-Time Collision Detection, 2005, sections 5.1.2, 5.1.5 and 5.1.9.
#pragma once

#include <vector>

#include "algorithms/oracle/ccd/moving_features.h"
#include "algorithms/oracle/ccd/polynomial.h"

namespace touchstone::oracle::ccd {

struct PartPolynomials {
  Sextic within;               // >= 0: their lines or planes are within the distance
  std::vector<Sextic> inside;  // all >= 0: the nearest points of these are in the parts
  std::vector<Sextic> spans;   // > 0: the part is not degenerate; none for two vertices
};

// Those of all pairs of parts. The separation (metres) is finite and >= 0.
std::vector<PartPolynomials> separation_polynomials(const MovingFeatures& features,
                                                    double separation);

}  // namespace touchstone::oracle::ccd
