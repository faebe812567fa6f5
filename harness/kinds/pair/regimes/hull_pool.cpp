// Builds the hulls of generated cases and keeps them.
#include "harness/kinds/pair/regimes/check_shapes.h"

#include <array>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::kinds {
namespace {

// --- hulls, in the cube from -1 to 1 ------------------------------------------------------------

using Points = std::vector<Vec3d>;

Points cloud(std::size_t count, base::Random& random) {
  const bool round = random.below(2) == 0;
  Points points;
  while (points.size() < count) points.push_back(round ? random.on_sphere() : random.in_ball());
  return points;
}

Points sphere_points(int level) {
  Shape ball;
  ball.radius = 1;
  return geometry::as_polytope(ball, level).hull->vertices;
}

// Draws some of the points of a grid: many are coplanar, some collinear.
Points grid_points(base::Random& random) {
  const auto steps = static_cast<int>(1 + random.below(3));
  const auto count = static_cast<std::size_t>(8 + random.below(33));
  const auto coordinate = [&] {
    return static_cast<double>(static_cast<int>(random.below(2 * steps + 1)) - steps) / steps;
  };
  Points points;
  // Four corners of the grid come first, so that the hull is solid.
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

Points prism(base::Random& random) {
  const auto sides = static_cast<int>(3 + random.below(14));
  const double phase = random.unit();
  Points points;
  for (int i = 0; i < sides; ++i) {
    const base::SinCos corner = base::sin_cos_turns(phase + static_cast<double>(i) / sides);
    for (const double z : {-1.0, 1.0}) points.emplace_back(corner.cos, corner.sin, z);
  }
  return points;
}

Points hull_points(std::uint64_t entry, base::Random& random) {
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
  Proportions form;
  double aspect, size;
  bool mirrored;

  auto tied() const { return std::tie(seed, entry, form, aspect, size, mirrored); }
  bool operator<(const HullKey& other) const { return tied() < other.tied(); }
};

std::shared_ptr<const Hull> build(const HullKey& key) {
  base::Random random(key.seed, base::mix(key.entry) + 1);
  Points points = hull_points(key.entry, random);
  const Vec3d half = random_sides({key.size, key.form, key.aspect}, random);
  const Vec3d away = key.entry % 4 == 3 ? random.in_ball() : Vec3d::Zero();
  for (Vec3d& p : points) {
    p = half.cwiseProduct(p + away);
    if (key.mirrored) p = Vec3d::Zero() - p;
  }
  return make_hull(std::move(points));
}

// The hulls that were built, by their keys. A key alone determines a hull.
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
  // Finds the key of a hull; returns false if the hull is not in the pool.
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

}  // namespace

std::shared_ptr<const Hull> pooled_hull(std::uint64_t seed, std::uint64_t entry,
                                        const ShapeStyle& style) {
  return pool().get({seed, entry, style.form, style.aspect, style.size, false});
}

std::shared_ptr<const Hull> mirrored_hull(const Hull& hull) {
  HullKey key;
  if (pool().find_key(&hull, key)) {
    key.mirrored = !key.mirrored;
    return pool().get(key);
  }
  Points points;
  for (const Vec3d& v : hull.vertices) points.emplace_back(Vec3d::Zero() - v);
  return make_hull(std::move(points));
}

}  // namespace touchstone::kinds
