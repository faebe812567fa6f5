// Builds shapes of given proportions, vertex counts and flatness.
#include "harness/kinds/pair/axes/axis_draws.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/reproducible_math.h"
#include "harness/kinds/pair/regimes/check_shapes.h"

namespace touchstone::kinds {
namespace {

Vec3d in_no_order(std::array<double, 3> half, base::Random& random) {
  for (std::size_t i = 2; i > 0; --i) std::swap(half[i], half[random.below(i + 1)]);
  return {half[0], half[1], half[2]};
}

// Stretches one of the pool's hulls of unit size to these half extents about its middle.
Shape stretched_hull(const Vec3d& half, std::uint64_t seed, base::Random& random) {
  const std::shared_ptr<const Hull> hull = pooled_hull(seed, random.below(160), {});
  std::vector<Vec3d> points = hull->vertices;
  Vec3d low = points.front(), high = low;
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3d middle = (low + high) / 2, factor = half.cwiseQuotient((high - low) / 2);
  for (Vec3d& p : points) p = factor.cwiseProduct(p - middle);
  return hull_of(std::move(points));
}

// --- hulls of many vertices ---------------------------------------------------------------------

struct Rings {
  std::size_t count, points;  // number of rings, and points of each
};

Rings rings_of(std::size_t vertices) {
  // Half a step along a ring is shorter than the way from ring to ring. So no face has an obtuse
  // angle at its tip, and each face is one of the hull's.
  constexpr std::array<std::pair<std::size_t, Rings>, 5> known = {
      {{10, {2, 5}}, {100, {5, 20}}, {1000, {25, 40}}, {10'000, {80, 125}}, {100'000, {250, 400}}}};
  for (const auto& [count, rings] : known) {
    if (count == vertices) return rings;
  }
  throw std::logic_error("no rings for so many vertices");
}

std::uint32_t number(std::size_t i) { return static_cast<std::uint32_t>(i); }

// Adds a face with the plane through the first three of the loop.
void add_face(Hull& hull, std::vector<std::uint32_t> loop) {
  const Vec3d &p = hull.vertices[loop[0]], &q = hull.vertices[loop[1]], &r = hull.vertices[loop[2]];
  const Vec3d n = base::outer(q - p, r - p);
  hull.faces.push_back({std::move(loop), n / base::length(n)});
}

void add_faces_and_edges(Hull& hull, const Rings& rings) {
  const std::size_t m = rings.points;
  const auto at = [&](std::size_t ring, std::size_t i) { return number(ring * m + i % m); };
  std::vector<std::uint32_t> bottom(m), top(m);
  for (std::size_t i = 0; i < m; ++i) {
    bottom[i] = at(0, m - i);
    top[i] = at(rings.count - 1, i);
  }
  // Faces 0 and 1 are the ends. In band r, face 2 + 2 m r + i stands on edge i of the ring below;
  // the face m further hangs from edge i of the ring above.
  add_face(hull, std::move(bottom));
  add_face(hull, std::move(top));
  const auto standing = [&](std::size_t r, std::size_t i) { return number(2 + 2 * m * r + i % m); };
  const auto hanging = [&](std::size_t r, std::size_t i) { return standing(r, i) + number(m); };
  for (std::size_t r = 0; r + 1 < rings.count; ++r) {
    // Point i of an odd ring is half a step further than that of an even one.
    const std::size_t shift = r % 2;
    for (std::size_t i = 0; i < m; ++i) {
      add_face(hull, {at(r, i), at(r, i + 1), at(r + 1, i + shift)});
    }
    for (std::size_t i = 0; i < m; ++i) {
      add_face(hull, {at(r + 1, i + 1), at(r + 1, i), at(r, i + 1 - shift)});
    }
    for (std::size_t i = 0; i < m; ++i) {
      // The edges run from point i up to the tip of its standing face, and from the next point to
      // that tip.
      hull.edges.push_back(
          {at(r, i), at(r + 1, i + shift), hanging(r, i + shift + m - 1), standing(r, i)});
      hull.edges.push_back(
          {at(r, i + 1), at(r + 1, i + shift), standing(r, i), hanging(r, i + shift)});
    }
  }
  for (std::size_t r = 0; r < rings.count; ++r) {
    for (std::size_t i = 0; i < m; ++i) {
      const std::uint32_t above = r + 1 < rings.count ? standing(r, i) : 1;
      const std::uint32_t below = r > 0 ? hanging(r - 1, i) : 0;
      hull.edges.push_back({at(r, i), at(r, i + 1), above, below});
    }
  }
  hull.neighbours.resize(hull.vertices.size());
  for (const Hull::Edge& edge : hull.edges) {
    hull.neighbours[edge.tail].push_back(edge.head);
    hull.neighbours[edge.head].push_back(edge.tail);
  }
}

}  // namespace

Vec3d compact_half(double size, base::Random& random) {
  const double longest = size / 2;
  const double second = longest * random.uniform(0.25, 1);
  return in_no_order({longest, second, longest * random.uniform(0.25, 1)}, random);
}

Vec3d slender_half(double size, double aspect, base::Random& random) {
  const double longest = size / 2, shortest = longest / aspect;
  return in_no_order({longest, random.below(2) == 0 ? longest : shortest, shortest}, random);
}

Shape shape_of_extents(ShapeKind kind, const Vec3d& half, std::uint64_t seed,
                       base::Random& random) {
  Shape shape;
  shape.kind = kind;
  std::array<double, 3> sorted = {half.x(), half.y(), half.z()};
  std::ranges::sort(sorted);
  const auto& [least, middle, greatest] = sorted;
  switch (kind) {
    case ShapeKind::sphere: shape.radius = greatest; break;
    case ShapeKind::capsule:
      shape.radius = least;
      shape.half_length = greatest - least;
      break;
    case ShapeKind::box: shape.half_extents = half; break;
    case ShapeKind::ellipsoid: shape.radii = half; break;
    case ShapeKind::hull: return stretched_hull(half, seed, random);
    case ShapeKind::halfspace: return random_shape(kind, {.size = greatest}, seed, random);
    default: {  // cylinder, cone
      const bool is_compact = greatest <= 4 * least;
      const double other = is_compact ? middle : least;
      const bool is_high = random.below(2) == 0;
      shape.half_length = is_high ? greatest : other;
      shape.radius = is_high ? other : greatest;
      break;
    }
  }
  return shape;
}

std::shared_ptr<const Hull> ringed_hull(std::size_t vertices, const Vec3d& radii) {
  const auto hull = std::make_shared<Hull>();
  if (vertices == 4) {
    const double s = 1 / std::sqrt(3.0);
    std::vector<Vec3d> corners;
    for (const Vec3d& v : {Vec3d(s, s, s), Vec3d(s, -s, -s), Vec3d(-s, s, -s), Vec3d(-s, -s, s)}) {
      corners.push_back(radii.cwiseProduct(v));
    }
    return make_hull(std::move(corners));
  }
  const Rings rings = rings_of(vertices);
  const auto m = static_cast<double>(rings.points);
  for (std::size_t r = 0; r < rings.count; ++r) {
    const double step = (static_cast<double>(r) + 0.5) / static_cast<double>(rings.count);
    const base::SinCos latitude = base::sin_cos_turns(step / 2 - 0.25);
    for (std::size_t i = 0; i < rings.points; ++i) {
      const double half_steps = 2 * static_cast<double>(i) + (r % 2 == 0 ? 0 : 1);
      const base::SinCos longitude = base::sin_cos_turns(half_steps / (2 * m));
      hull->vertices.push_back(radii.cwiseProduct(
          Vec3d(latitude.cos * longitude.cos, latitude.cos * longitude.sin, latitude.sin)));
    }
  }
  add_faces_and_edges(*hull, rings);
  return hull;
}

Shape capped_prism(int sides, double bulge) {
  std::vector<Vec3d> points;
  for (int i = 0; i < sides; ++i) {
    const base::SinCos corner = base::sin_cos_turns(static_cast<double>(i) / sides);
    points.emplace_back(corner.cos / 2, corner.sin / 2, -0.5);
    points.emplace_back(corner.cos / 2, corner.sin / 2, 0);
    // The points lie on a paraboloid, so that no two facets of the cap are in one plane.
    points.emplace_back(corner.cos / 4, corner.sin / 4, 0.75 * bulge);
  }
  points.emplace_back(0, 0, bulge);
  return hull_of(std::move(points));
}

}  // namespace touchstone::kinds
