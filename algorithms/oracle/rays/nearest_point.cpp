// The least of the distances of the vertices, the edges and the plane that the point is over.
#include "algorithms/oracle/rays/nearest_point.h"

#include <optional>

namespace touchstone::oracle {

NearestInTriangle nearest_of(const SeenTriangle& seen) {
  std::optional<NearestInTriangle> best;
  const auto is_nearer = [&](const Integer& top, const Integer& bottom) {
    return !best || top * best->bottom < best->top * bottom;
  };
  const IntegerVector normal = cross(seen[1] - seen[0], seen[2] - seen[0]);
  bool is_over = !is_zero(normal);
  for (std::size_t k = 0; k < 3; ++k) {
    const IntegerVector &a = seen[k], &b = seen[(k + 1) % 3];
    const Integer square = dot(a, a);
    if (is_nearer(square, 1)) best = NearestInTriangle{square, 1, a, 1};
    const IntegerVector edge = b - a, volume = cross(a, b);
    const Integer along = -dot(a, edge);
    if (along > 0 && dot(b, edge) > 0) {
      const Integer top = dot(volume, volume), length = dot(edge, edge);
      if (is_nearer(top, length))
        best = NearestInTriangle{top, length, length * a + along * edge, length};
    }
    is_over = is_over && dot(normal, volume) >= 0;
  }
  if (is_over) {
    const Integer height = dot(normal, seen[0]), area = dot(normal, normal);
    if (is_nearer(height * height, area)) {
      best = NearestInTriangle{height * height, area, height * normal, area};
    }
  }
  return *best;
}

}  // namespace touchstone::oracle
