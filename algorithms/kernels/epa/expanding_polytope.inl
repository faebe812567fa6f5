// The loop of EPA and its start, for any difference of two bodies. Included where they are instantiated:
// by expanding_polytope.cpp, and by motion/linear for a difference that is swept along a path.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/epa/expanding_polytope.h"

namespace touchstone {

// A unit vector at a right angle to another.
template <class Scalar>
Vec3<Scalar> perpendicular_to(const Vec3<Scalar>& v) {
  Eigen::Index axis = 0;
  v.cwiseAbs().minCoeff(&axis);
  return v.cross(Vec3<Scalar>::Unit(axis)).normalized();
}

template <class Scalar>
template <class Pair>
Expansion<Scalar> ExpandingPolytope<Scalar>::expand(Pair& pair, const Simplex<Scalar>& simplex,
                                                    const ExpansionGoal<Scalar>& goal) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  const Scalar away = goal.doubtful ? Scalar{0} : goal.away;
  // Faces that are nearer may have the origin outside. Both distances are off by the rounding of
  // the products alone.
  const Scalar certain = away > 0 ? away + SupportPair<Scalar>::rounding / 2 : Scalar{0};
  Expansion<Scalar> result;
  result.lower = -away;
  result.upper = infinity;
  if (simplex.size < 4) {
    Simplex<Scalar> tetrahedron = simplex;
    if (!grow_to_tetrahedron(pair, tetrahedron, result)) return result;
    if (!surface_.start(tetrahedron.points)) return result;
  } else if (!surface_.start(simplex.points)) {
    return result;
  }

  result.has_surface = true;
  std::array<int, 3> best{};  // corners of the last face that lowered the upper bound
  Scalar held = infinity;     // the nearest face that cannot be expanded
  result.end = ExpansionEnd::cap;
  for (int iteration = 1; iteration <= max_iterations_; ++iteration) {
    const auto [nearest, distance] = surface_.nearest_face();
    const Scalar least = std::min({distance, held, result.upper});
    if (least > certain) result.lower = std::max(result.lower, least);
    if (nearest < 0 || distance > result.upper + goal.tolerance) {
      const bool bounded = result.upper - result.lower <= goal.tolerance;
      result.end = bounded ? ExpansionEnd::converged : ExpansionEnd::stuck;
      break;
    }
    if (goal.enough >= 0 && result.lower > goal.enough) {
      result.end = ExpansionEnd::enough;
      break;
    }
    result.iterations = iteration;
    const Vec3<Scalar> normal = surface_.normal(nearest);
    const DifferencePoint<Scalar> point = pair.support(normal);
    const Scalar height = normal.dot(point.difference);
    // This form of the comparison ends the loop for NaN.
    const bool met = !(height - std::min(distance, surface_.distance(nearest)) > goal.tolerance);
    if (met || height < result.upper) {
      result.upper = height;
      result.normal = normal;
      best = surface_.corners(nearest);
    }
    if (height < -SupportPair<Scalar>::rounding) {
      result.end = ExpansionEnd::apart;
      break;
    }
    if (met) {
      const bool bounded = height - std::min(distance, held) <= goal.tolerance;
      result.end = bounded ? ExpansionEnd::converged : ExpansionEnd::stuck;
      break;
    }
    if (goal.enough >= 0 && result.upper <= goal.enough) {
      result.end = ExpansionEnd::enough;
      break;
    }
    if (!surface_.add(point, nearest, result.upper + SupportPair<Scalar>::rounding)) {
      surface_.set_aside(nearest);
      held = std::min(held, distance);
    }
  }
  if (goal.doubtful && !encloses_origin()) {
    result.lower = 0;
    if (result.end != ExpansionEnd::apart) result.end = ExpansionEnd::stuck;
  }
  if (best[0] != best[1]) find_witnesses(best, result);
  return result;
}

// Adds support points away from the simplex until it is a tetrahedron. The origin lies within
// `away` of the simplex, and therefore of the tetrahedron's surface. Returns false if the
// difference has no volume.
template <class Scalar>
template <class Pair>
bool ExpandingPolytope<Scalar>::grow_to_tetrahedron(Pair& pair, Simplex<Scalar>& simplex,
                                                    Expansion<Scalar>& result) {
  constexpr Scalar flat = 4 * SupportPair<Scalar>::rounding;
  for (int i = 0; i < simplex.size; ++i) {
    result.a += simplex.weights[i] * simplex.points[i].a;
    result.b += simplex.weights[i] * simplex.points[i].b;
  }
  while (simplex.size < 4) {
    const Vec3<Scalar>& base = simplex.points[0].difference;
    // Directions that leave the simplex's affine hull.
    std::array<Vec3<Scalar>, 6> directions;
    int count = 0;
    Vec3<Scalar> edge = Vec3<Scalar>::Zero();
    const auto both_ways = [&](const Vec3<Scalar>& direction) {
      directions[count++] = direction;
      directions[count++] = -direction;
    };
    if (simplex.size == 1) {
      for (int axis = 0; axis < 3; ++axis) both_ways(Vec3<Scalar>::Unit(axis));
    } else if (simplex.size == 2) {
      edge = (simplex.points[1].difference - base).normalized();
      const Vec3<Scalar> across = perpendicular_to(edge);
      both_ways(across);
      both_ways(edge.cross(across));
    } else {
      const TrianglePlane<Scalar> plane = triangle_plane<Scalar>(
          {base, simplex.points[1].difference, simplex.points[2].difference});
      if (plane.flat) return false;
      both_ways(plane.normal.normalized());
    }

    Scalar furthest = 0;
    DifferencePoint<Scalar> best = simplex.points[0];
    for (int i = 0; i < count; ++i) {
      const DifferencePoint<Scalar> point = pair.support(directions[i]);
      const Scalar height = directions[i].dot(point.difference);
      if (height < result.upper) {
        result.upper = height;
        result.normal = directions[i];
      }
      const Vec3<Scalar> off = point.difference - base;
      const Scalar distance = simplex.size == 1   ? off.norm()
                              : simplex.size == 2 ? off.cross(edge).norm()
                                                  : std::abs(directions[i].dot(off));
      if (distance > furthest) {
        furthest = distance;
        best = point;
      }
    }
    if (!(furthest > flat)) {
      result.end = ExpansionEnd::flat;
      return false;
    }
    simplex.points[simplex.size++] = best;
    result.upper = std::numeric_limits<Scalar>::infinity();
  }
  return true;
}

}  // namespace touchstone
