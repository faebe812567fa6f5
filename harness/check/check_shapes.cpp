#include "harness/check/check_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "harness/check/plain_math.h"
#include "harness/scene/convex_hull.h"
#include "harness/scene/polytope.h"

namespace touchstone {
namespace {

// Half of each side, the longest between size / 2 and size, in no order.
Vec3d random_sides(const ShapeStyle& style, Random& random) {
  const double longest = style.size * random.uniform(0.5, 1);
  std::array<double, 3> half = {longest, longest * random.uniform(0.25, 1),
                                longest * random.uniform(0.25, 1)};
  if (style.form == Form::needle) half[1] /= style.aspect;
  if (style.form != Form::compact) half[2] /= style.aspect;
  for (std::size_t i = 2; i > 0; --i) std::swap(half[i], half[random.below(i + 1)]);
  return {half[0], half[1], half[2]};
}

// --- hulls, in the cube from -1 to 1 ------------------------------------------------------------

using Points = std::vector<Vec3d>;

Points cloud(std::size_t count, Random& random) {
  const bool round = random.below(2) == 0;
  Points points;
  while (points.size() < count) points.push_back(round ? random.on_sphere() : random.in_ball());
  return points;
}

Points sphere_points(int level) {
  Shape ball;
  ball.radius = 1;
  return as_polytope(ball, level).hull->vertices;
}

// Some of the points of a grid: many of them are coplanar, some collinear.
Points grid_points(Random& random) {
  const auto steps = static_cast<int>(1 + random.below(3));
  const auto count = static_cast<std::size_t>(8 + random.below(33));
  const auto coordinate = [&] {
    return static_cast<double>(static_cast<int>(random.below(2 * steps + 1)) - steps) / steps;
  };
  Points points;
  // Corners of the grid first, so that it is solid.
  for (const auto& [x, y, z] : {std::array{-1.0, -1.0, -1.0}, {1.0, 1.0, -1.0}, {1.0, -1.0, 1.0}}) {
    points.emplace_back(x, y, z);
  }
  points.emplace_back(-1, 1, 1);
  while (points.size() < count) {
    const double x = coordinate(), y = coordinate();
    points.emplace_back(x, y, coordinate());
  }
  return points;
}

Points prism(Random& random) {
  const auto sides = static_cast<int>(3 + random.below(14));
  const double phase = random.unit();
  Points points;
  for (int i = 0; i < sides; ++i) {
    const SinCos corner = sin_cos_turns(phase + static_cast<double>(i) / sides);
    for (const double z : {-1.0, 1.0}) points.emplace_back(corner.cos, corner.sin, z);
  }
  return points;
}

Points hull_points(std::uint64_t entry, Random& random) {
  switch (entry % 16) {
    case 0:
    case 1: return cloud(4, random);
    case 2:
    case 3: return sphere_points(static_cast<int>(random.below(2)));
    case 4:
    case 5:
    case 6: return grid_points(random);
    case 7:
    case 8: return prism(random);
    case 9:
      if (entry == 9) return cloud(256 + random.below(257), random);
      if (entry == 25) return sphere_points(2);
      [[fallthrough]];
    default: return cloud(4 + random.below(61), random);
  }
}

// --- the pool -----------------------------------------------------------------------------------

struct HullKey {
  std::uint64_t seed, entry;
  Form form;
  double aspect, size;
  bool mirrored;

  auto tied() const { return std::tie(seed, entry, form, aspect, size, mirrored); }
  bool operator<(const HullKey& other) const { return tied() < other.tied(); }
};

std::shared_ptr<const Hull> build(const HullKey& key) {
  Random random(key.seed, mix(key.entry) + 1);
  Points points = hull_points(key.entry, random);
  const Vec3d half = random_sides({key.size, key.form, key.aspect}, random);
  const Vec3d away = key.entry % 4 == 3 ? random.in_ball() : Vec3d::Zero();
  for (Vec3d& p : points) {
    p = half.cwiseProduct(p + away);
    if (key.mirrored) p = Vec3d::Zero() - p;
  }
  return make_hull(std::move(points));
}

// Hulls that were built, by what they were built from, which alone decides what they are.
class HullPool {
 public:
  std::shared_ptr<const Hull> get(const HullKey& key) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = hulls_.find(key); known != hulls_.end()) return known->second;
    }
    std::shared_ptr<const Hull> hull = build(key);
    const std::lock_guard lock(mutex_);
    if (hulls_.size() >= most) {
      hulls_.clear();
      keys_.clear();
    }
    const auto [place, is_new] = hulls_.insert({key, std::move(hull)});
    if (is_new) keys_.insert({place->second.get(), key});
    return place->second;
  }
  // What the hull was built from; false where it is none of the pool's.
  bool find_key(const Hull* hull, HullKey& key) {
    const std::lock_guard lock(mutex_);
    const auto known = keys_.find(hull);
    if (known == keys_.end()) return false;
    key = known->second;
    return true;
  }

 private:
  static constexpr std::size_t most = 4096;

  std::mutex mutex_;
  std::map<HullKey, std::shared_ptr<const Hull>> hulls_;
  std::map<const Hull*, HullKey> keys_;
};

HullPool& pool() {
  static HullPool hulls;
  return hulls;
}

Shape hull_shape(std::shared_ptr<const Hull> hull) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return shape;
}

Shape random_halfspace(const ShapeStyle& style, Random& random) {
  Shape shape;
  shape.kind = ShapeKind::halfspace;
  const double length = random.below(2) == 0 ? 1 : random.magnitude(0.1, 10);
  if (random.below(2) == 0) {
    shape.normal = length * random.on_sphere();
  } else {
    shape.normal = Vec3d::Zero();
    shape.normal[static_cast<int>(random.below(3))] = random.below(2) == 0 ? length : -length;
  }
  if (random.below(2) == 0) shape.offset = length * style.size * random.uniform(-1, 1);
  return shape;
}

}  // namespace

ShapeKind random_kind(Random& random) {
  constexpr std::array<std::pair<ShapeKind, std::uint64_t>, 7> weights = {
      {{ShapeKind::box, 25},
       {ShapeKind::hull, 25},
       {ShapeKind::sphere, 14},
       {ShapeKind::capsule, 14},
       {ShapeKind::cylinder, 8},
       {ShapeKind::cone, 7},
       {ShapeKind::ellipsoid, 7}}};
  std::uint64_t draw = random.below(100);
  for (const auto& [kind, weight] : weights) {
    if (draw < weight) return kind;
    draw -= weight;
  }
  return ShapeKind::box;
}

Shape random_shape(ShapeKind kind, const ShapeStyle& style, std::uint64_t seed, Random& random) {
  Shape shape;
  shape.kind = kind;
  switch (kind) {
    case ShapeKind::sphere: shape.radius = style.size * random.uniform(0.5, 1); return shape;
    case ShapeKind::hull: {
      const std::uint64_t entries = style.form == Form::compact && style.size == 1 ? 160 : 48;
      return hull_shape(
          pool().get({seed, random.below(entries), style.form, style.aspect, style.size, false}));
    }
    case ShapeKind::halfspace: return random_halfspace(style, random);
    default: break;
  }
  const Vec3d half = random_sides(style, random);
  const double least = half.minCoeff(), greatest = half.maxCoeff();
  const double middle =
      std::max(std::min(half.x(), half.y()), std::min(std::max(half.x(), half.y()), half.z()));
  switch (kind) {
    case ShapeKind::box: shape.half_extents = half; break;
    case ShapeKind::ellipsoid: shape.radii = half; break;
    case ShapeKind::capsule:
      shape.radius = least;
      shape.half_length = greatest - least;
      break;
    default:  // cylinder, cone
      shape.radius = style.form == Form::needle ? least : middle;
      shape.half_length = style.form == Form::plate ? least : greatest;
      break;
  }
  return shape;
}

Shape mirrored(const Shape& hull) {
  HullKey key;
  if (pool().find_key(hull.hull.get(), key)) {
    key.mirrored = !key.mirrored;
    return hull_shape(pool().get(key));
  }
  Points points;
  for (const Vec3d& v : hull.hull->vertices) points.emplace_back(Vec3d::Zero() - v);
  return hull_of(std::move(points));
}

Shape hull_of(std::vector<Vec3d> points) { return hull_shape(make_hull(std::move(points))); }

Shape box_as_hull(const Vec3d& half_extents) {
  Points points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(
        half_extents.cwiseProduct(Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  }
  return hull_of(std::move(points));
}

Vec3d inner_point(const Shape& shape) {
  if (shape.kind == ShapeKind::cone) return {0, 0, -shape.half_length / 2};
  if (shape.kind != ShapeKind::hull) return Vec3d::Zero();
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& v : shape.hull->vertices) sum += v;
  return sum / static_cast<double>(shape.hull->vertices.size());
}

double support_value(const Shape& shape, const Vec3d& n) {
  const double norm = length(n);
  const double disc = shape.radius * std::sqrt(n.x() * n.x() + n.y() * n.y());
  const double along = shape.half_length * std::abs(n.z());
  switch (shape.kind) {
    case ShapeKind::sphere: return shape.radius * norm;
    case ShapeKind::capsule: return along + shape.radius * norm;
    case ShapeKind::box: return inner(n.cwiseAbs(), shape.half_extents);
    case ShapeKind::cylinder: return along + disc;
    case ShapeKind::cone:
      return std::max(shape.half_length * n.z(), disc - shape.half_length * n.z());
    case ShapeKind::ellipsoid: return length(n.cwiseProduct(shape.radii));
    case ShapeKind::hull: {
      double greatest = -std::numeric_limits<double>::infinity();
      for (const Vec3d& v : shape.hull->vertices) greatest = std::max(greatest, inner(n, v));
      return greatest;
    }
    case ShapeKind::halfspace: break;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace touchstone
