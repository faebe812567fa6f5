// Part of the oracle, used by the checks of certificates: rays and points against one triangle in rationals.
#pragma once

#include <optional>

#include "algorithms/oracle/certificates/parts/rational_mesh.h"

namespace touchstone::oracle {

// The first t >= 0 at which origin + t * direction is in the closed triangle, which may be a segment or a
// point. The direction is not zero.
std::optional<mpq_class> first_time(const RationalVector& origin, const RationalVector& direction,
                                    const RationalTriangle& triangle);

// The squared distance of the point from the closed triangle, which may be a segment or a point.
mpq_class squared_distance(const RationalVector& point, const RationalTriangle& triangle);

}  // namespace touchstone::oracle
