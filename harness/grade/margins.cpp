// The table of margins.
#include "harness/grade/margins.h"

#include <limits>

namespace touchstone::grade {

Margins documented_margins(Precision scalar, bool extreme) {
  if (scalar == Precision::float32) {
    return {.verdict = extreme ? 1e-4 : 1e-5, .length = 1e-4, .resolution = 4e-5};
  }
  return {.verdict = extreme ? 1e-9 : 1e-12, .length = 1e-9, .resolution = 6e-14};
}

double grazing_band(double size, double reach, Precision scalar) {
  const bool single = scalar == Precision::float32;
  const double epsilon =
      single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  return (single ? 1e-4 : 1e-6) * size + 8 * epsilon * reach;
}

}  // namespace touchstone::grade
