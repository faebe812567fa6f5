// The nearest feature of an integer simplex: every feature is tried, and signs are exact.
#include "algorithms/oracle/exact_simplex.h"

#include <utility>

namespace touchstone::oracle {
namespace {

struct Feature {
  int size = 0;
  std::array<int, 4> vertices{};
  std::array<Integer, 4> weights;
  NearestPlane plane;
};

Integer volume(const IntegerVector& x, const IntegerVector& y, const IntegerVector& z) {
  return dot(x, cross(y, z));
}

// Returns true if the origin projects into the feature: all weights are positive.
bool projects_inside(const ExactSimplex& simplex, Feature& f) {
  const auto at = [&](int i) -> const IntegerVector& { return simplex.at[f.vertices[i]]; };
  auto& w = f.weights;
  switch (f.size) {
    case 1:
      w[0] = 1;
      f.plane.normal = at(0);
      break;
    case 2: {
      const IntegerVector edge = at(1) - at(0);
      w[0] = dot(edge, at(1));
      w[1] = -dot(edge, at(0));
      if (w[0] <= 0 || w[1] <= 0) return false;
      f.plane.normal = w[0] * at(0) + w[1] * at(1);
      break;
    }
    case 3: {
      const IntegerVector opposite_0 = cross(at(1), at(2)), opposite_1 = cross(at(2), at(0)),
                          opposite_2 = cross(at(0), at(1));
      f.plane.normal = opposite_0 + opposite_1 + opposite_2;
      w[0] = dot(f.plane.normal, opposite_0);
      if (w[0] <= 0) return false;
      w[1] = dot(f.plane.normal, opposite_1);
      if (w[1] <= 0) return false;
      w[2] = dot(f.plane.normal, opposite_2);
      if (w[2] <= 0) return false;
      break;
    }
    default: {
      w[0] = volume(at(1), at(2), at(3));
      w[1] = -volume(at(0), at(2), at(3));
      w[2] = volume(at(0), at(1), at(3));
      w[3] = -volume(at(0), at(1), at(2));
      if (w[0] < 0) {
        for (Integer& weight : w) weight = -weight;
      }
      if (w[0] <= 0 || w[1] <= 0 || w[2] <= 0 || w[3] <= 0) return false;
      f.plane.contains_origin = true;
      return true;
    }
  }
  f.plane.offset = dot(f.plane.normal, at(0));
  if (f.plane.offset < 0) {
    f.plane.offset = -f.plane.offset;
    f.plane.normal = -f.plane.normal;
  }
  f.plane.contains_origin = f.plane.offset.is_zero();
  return true;
}

// Returns true if no vertex of the simplex is nearer to the origin than the feature's plane.
bool is_nearest(const ExactSimplex& simplex, const Feature& f, unsigned mask) {
  if (f.plane.contains_origin) return true;
  for (int i = 0; i < simplex.size; ++i) {
    if (mask >> i & 1u) continue;
    if (dot(f.plane.normal, simplex.at[i]) < f.plane.offset) return false;
  }
  return true;
}

}  // namespace

NearestPlane reduce(ExactSimplex& simplex) {
  const unsigned newest = 1u << (simplex.size - 1);
  const unsigned all = 2 * newest - 1;
  for (const bool with_newest : {true, false}) {
    for (unsigned mask = all; mask > 0; --mask) {
      if (((mask & newest) != 0) != with_newest) continue;
      Feature f;
      for (int i = 0; i < simplex.size; ++i) {
        if (mask >> i & 1u) f.vertices[f.size++] = i;
      }
      if (!projects_inside(simplex, f) || !is_nearest(simplex, f, mask)) continue;
      ExactSimplex kept;
      kept.size = f.size;
      kept.weight = 0;
      for (int i = 0; i < f.size; ++i) {
        kept.points[i] = simplex.points[f.vertices[i]];
        kept.at[i] = std::move(simplex.at[f.vertices[i]]);
        kept.weight += f.weights[i];
        kept.weights[i] = std::move(f.weights[i]);
      }
      simplex = std::move(kept);
      return std::move(f.plane);
    }
  }
  return {};  // not reached: some feature contains the nearest point
}

}  // namespace touchstone::oracle
