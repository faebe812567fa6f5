#include "algorithms/encoding.h"

namespace touchstone {

UnitHalfspace::UnitHalfspace(const Shape& shape) {
  const double length = shape.normal.stableNorm();
  normal = shape.normal / length;
  offset = shape.offset / length;
}

}  // namespace touchstone
