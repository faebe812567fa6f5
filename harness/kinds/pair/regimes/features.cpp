// Picks features of shapes, with points and normals in their interiors.
#include "harness/kinds/pair/regimes/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "harness/base/reproducible_math.h"

namespace touchstone::kinds {
namespace {

constexpr std::array<std::string_view, 8> kind_names = {"vertex", "edge", "face", "smooth",
                                                        "side",   "rim",  "tip",  "base"};

// Returns a share of a whole, well inside it.
double inside(base::Random& random) { return random.uniform(0.1, 0.9); }

// --- boxes and hulls ----------------------------------------------------------------------------

Feature pick_box_feature(const Vec3d& half, FeatureKind kind, base::Random& random) {
  Vec3d n;
  for (int i = 0; i < 3; ++i) {
    n[i] = random.uniform(0.2, 1);
    if (random.below(2) == 0) n[i] = -n[i];
  }
  const auto axis = static_cast<int>(random.below(3));
  if (kind == FeatureKind::edge) n[axis] = 0;
  if (kind == FeatureKind::face) {
    const double side = n[axis];
    n = Vec3d::Zero();
    n[axis] = side;
  }
  return box_feature(half, base::unit(n), random);
}

// Picks features of hulls without faces. The vertex is the furthest along a random direction.
// Inside a segment the normal is across it; inside a flat set it is one of the two normals of the
// plane.
Feature pick_degenerate_feature(const Hull& hull, FeatureKind kind, base::Random& random) {
  const std::vector<Vec3d>& v = hull.vertices;
  Feature feature;
  feature.normal = random.on_sphere();
  const auto furthest = [&](const auto& measure) {
    return *std::max_element(v.begin(), v.end(), [&](const Vec3d& p, const Vec3d& q) {
      return measure(p) < measure(q);
    });
  };
  const auto between = [](const Vec3d& p, const Vec3d& q, double share) {
    return base::exactly(p) + base::scaled(DoubleDouble3::difference(q, p), {share, 0});
  };
  const Vec3d start = furthest([&](const Vec3d& p) { return base::inner(feature.normal, p); });
  const Vec3d end = furthest([&](const Vec3d& p) { return base::length(p - start); });
  if (kind == FeatureKind::edge && hull.dimension == 1) {
    feature.kind = FeatureKind::edge;
    feature.direction = base::unit(end - start);
    feature.normal = base::beside(feature.direction, feature.normal);
    feature.point = between(start, end, inside(random));
    return feature;
  }
  if (kind == FeatureKind::face && hull.dimension == 2) {
    const Vec3d third = furthest([&](const Vec3d& p) {
      return base::length(base::outer(base::unit(end - start), p - start));
    });
    feature.kind = FeatureKind::face;
    feature.normal = base::unit(base::outer(base::unit(end - start), base::unit(third - start)));
    if (random.below(2) == 0) feature.normal = Vec3d::Zero() - feature.normal;
    const double share = inside(random);
    feature.point =
        between(start, end, share) +
        base::scaled(DoubleDouble3::difference(third, start), {inside(random) * (1 - share), 0});
    return feature;
  }
  feature.point = base::exactly(start);
  return feature;
}

Feature pick_hull_feature(const Hull& hull, FeatureKind kind, base::Random& random) {
  if (hull.faces.empty()) return pick_degenerate_feature(hull, kind, random);
  Feature feature;
  feature.kind = kind;
  const auto vertex = [&](std::uint32_t i) { return base::exactly(hull.vertices[i]); };
  if (kind == FeatureKind::face) {
    const Hull::Face& face = hull.faces[random.below(hull.faces.size())];
    feature.normal = face.normal;
    feature.point = vertex(face.loop.front());
    // The corners have random weights; the first has the remainder.
    double sum = random.uniform(0.2, 1);
    std::vector<double> weights;
    for (std::size_t i = 1; i < face.loop.size(); ++i) {
      weights.push_back(random.uniform(0.2, 1));
      sum += weights.back();
    }
    for (std::size_t i = 1; i < face.loop.size(); ++i) {
      const DoubleDouble3 side =
          DoubleDouble3::difference(hull.vertices[face.loop[i]], hull.vertices[face.loop.front()]);
      feature.point = feature.point + base::scaled(side, {weights[i - 1] / sum, 0});
    }
    return feature;
  }
  if (kind == FeatureKind::edge) {
    const Hull::Edge& edge = hull.edges[random.below(hull.edges.size())];
    const DoubleDouble3 side =
        DoubleDouble3::difference(hull.vertices[edge.head], hull.vertices[edge.tail]);
    feature.direction = base::unit(side.value());
    feature.point = vertex(edge.tail) + base::scaled(side, {inside(random), 0});
    const double share = inside(random);
    feature.normal = base::unit(share * hull.faces[edge.left].normal +
                                (1 - share) * hull.faces[edge.right].normal);
    return feature;
  }
  std::uint32_t index = 0;
  do {
    index = static_cast<std::uint32_t>(random.below(hull.vertices.size()));
  } while (hull.neighbours[index].empty());  // vertices without neighbours are not extreme
  feature.point = vertex(index);
  Vec3d n = Vec3d::Zero();
  for (const Hull::Face& face : hull.faces) {
    if (std::ranges::find(face.loop, index) != face.loop.end()) {
      n += random.uniform(0.2, 1) * face.normal;
    }
  }
  feature.normal = base::unit(n);
  return feature;
}

// --- round shapes -------------------------------------------------------------------------------

// Returns a direction across the z axis, of length 1 to about 1e-31.
DoubleDouble3 around_axis(base::Random& random) {
  const base::SinCos turn = base::sin_cos_turns(random.unit());
  return base::true_unit({turn.cos, turn.sin, 0});
}

Feature pick_smooth_feature(const Shape& shape, base::Random& random) {
  Feature feature;
  feature.kind = FeatureKind::smooth;
  feature.normal = random.on_sphere();
  feature.radius = shape.radius;
  if (shape.kind == ShapeKind::capsule) {
    feature.point.z = {feature.normal.z() < 0 ? -shape.half_length : shape.half_length, 0};
  }
  if (shape.kind != ShapeKind::ellipsoid) return feature;
  feature.radius = 0;
  const Vec3d& r = shape.radii;
  const double greatest = r.maxCoeff();
  if (r.minCoeff() > 0 && random.below(2) == 0) {
    // The point is uniform over the surface, since normals gather where the surface is strongly
    // curved.
    const Vec3d p = feature.normal;
    feature.normal = base::unit(p.cwiseProduct((greatest * r.cwiseInverse())));
    feature.point = base::exactly(r.cwiseProduct(p));
    return feature;
  }
  if (!(greatest > 0)) return feature;
  const Vec3d stretched = (r / greatest).cwiseProduct(feature.normal);
  feature.point = base::exactly(r.cwiseProduct(stretched / base::length(stretched)));
  return feature;
}

// Picks the side, rim, tip or base of a capsule, cylinder or cone.
Feature pick_axial_feature(const Shape& shape, FeatureKind kind, base::Random& random) {
  Feature feature;
  feature.kind = kind;
  const double r = shape.radius, h = shape.half_length;
  const bool cone = shape.kind == ShapeKind::cone;
  const DoubleDouble3 around = around_axis(random);
  const Vec3d across = around.value();
  const double end = cone || random.below(2) == 0 ? -1 : 1;  // selects the base
  const double most = std::max(r, 2 * h);
  // The slope of a cone; for other kinds it points across the axis.
  const Vec3d slope =
      most > 0 ? base::unit((2 * h / most) * across + Vec3d(0, 0, r / most)) : across;
  const Vec3d side_normal = cone ? slope : across;
  const DoubleDouble3 base_centre = base::exactly({0, 0, end * h});
  switch (kind) {
    case FeatureKind::tip:
      feature.point = base::exactly({0, 0, h});
      feature.normal = base::unit(Vec3d::UnitZ() + 2 * random.unit() * side_normal);
      break;
    case FeatureKind::base: {
      feature.normal = {0, 0, end};
      const Vec3d place = random.in_ball();
      feature.point = base::exactly({0.9 * r * place.x(), 0.9 * r * place.y(), end * h});
      break;
    }
    case FeatureKind::rim:
      feature.point = base_centre + base::scaled(around, {r, 0});
      feature.normal = base::unit(side_normal + random.magnitude(0.25, 4) * Vec3d(0, 0, end));
      feature.direction = {-across.y(), across.x(), 0};
      break;
    default:  // side
      feature.normal = side_normal;
      if (cone) {
        const DoubleDouble3 down = base::scaled(around, {r, 0}) + base::exactly({0, 0, -2 * h});
        feature.point = base::exactly({0, 0, h}) + base::scaled(down, {inside(random), 0});
        feature.direction = most > 0 ? base::unit(down.value()) : Vec3d::UnitZ();
      } else {
        feature.point = base::exactly({0, 0, random.uniform(-0.9, 0.9) * h});
        feature.direction = Vec3d::UnitZ();
        feature.radius = r;
      }
      break;
  }
  return feature;
}

// --- half-spaces --------------------------------------------------------------------------------

Feature pick_plane_feature(const Shape& shape, double far, base::Random& random) {
  Feature feature;
  feature.kind = FeatureKind::face;
  feature.normal = base::unit(shape.normal);
  const DoubleDouble3 n = base::exactly(shape.normal);
  const double square = dot(n, n).value();
  const Vec3d away = base::beside(feature.normal, random.on_sphere());
  feature.point = base::exactly((far * random.unit()) * away);
  // This projects onto the plane; the second step removes the first one's rounding.
  for (int step = 0; step < 2; ++step) {
    const DoubleDouble miss = DoubleDouble{shape.offset, 0} - dot(n, feature.point);
    feature.point = feature.point + base::scaled(n, {miss.value() / square, 0});
  }
  return feature;
}

}  // namespace

std::string_view to_string(FeatureKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

bool has_feature(ShapeKind shape, FeatureKind feature) {
  switch (feature) {
    case FeatureKind::vertex:
    case FeatureKind::edge: return shape == ShapeKind::box || shape == ShapeKind::hull;
    case FeatureKind::face:
      return shape == ShapeKind::box || shape == ShapeKind::hull || shape == ShapeKind::halfspace;
    case FeatureKind::smooth:
      return shape == ShapeKind::sphere || shape == ShapeKind::ellipsoid ||
             shape == ShapeKind::capsule;
    case FeatureKind::side:
      return shape == ShapeKind::capsule || shape == ShapeKind::cylinder ||
             shape == ShapeKind::cone;
    case FeatureKind::rim:
    case FeatureKind::base: return shape == ShapeKind::cylinder || shape == ShapeKind::cone;
    case FeatureKind::tip: return shape == ShapeKind::cone;
  }
  return false;
}

Feature pick_feature(const Shape& shape, FeatureKind kind, double reach, base::Random& random) {
  switch (shape.kind) {
    case ShapeKind::box: return pick_box_feature(shape.half_extents, kind, random);
    case ShapeKind::hull: return pick_hull_feature(*shape.hull, kind, random);
    case ShapeKind::halfspace: return pick_plane_feature(shape, reach, random);
    default: break;
  }
  return kind == FeatureKind::smooth ? pick_smooth_feature(shape, random)
                                     : pick_axial_feature(shape, kind, random);
}

FeatureKind random_feature_kind(const Shape& shape, base::Random& random) {
  for (;;) {
    const auto kind = static_cast<FeatureKind>(random.below(kind_names.size()));
    if (has_feature(shape.kind, kind)) return kind;
  }
}

Feature box_feature(const Vec3d& half_extents, const Vec3d& n, base::Random& random) {
  Feature feature;
  feature.normal = n;
  Vec3d point, direction = Vec3d::Zero();
  int free = 0;
  for (int i = 0; i < 3; ++i) {
    if (n[i] == 0) {
      ++free;
      direction[i] = 1;
      point[i] = half_extents[i] * random.uniform(-0.9, 0.9);
    } else {
      point[i] = n[i] > 0 ? half_extents[i] : -half_extents[i];
    }
  }
  feature.point = base::exactly(point);
  feature.kind = free == 0   ? FeatureKind::vertex
                 : free == 1 ? FeatureKind::edge
                             : FeatureKind::face;
  if (free == 1) feature.direction = direction;
  return feature;
}

}  // namespace touchstone::kinds
