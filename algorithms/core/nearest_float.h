// Doubles rounded to floats and back.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// The nearest float. It goes through memory, because GCC 12 drops the two conversions where it puts
// several of them in one vector (-O2 and up).
inline double nearest_float(double x) {
  const volatile float rounded = static_cast<float>(x);
  return static_cast<double>(rounded);
}
inline Vec3d nearest_float(const Vec3d& v) {
  return {nearest_float(v[0]), nearest_float(v[1]), nearest_float(v[2])};
}

}  // namespace touchstone
