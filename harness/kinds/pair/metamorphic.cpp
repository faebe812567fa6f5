// Makes exact variants of a case, and maps their outcomes back.
#include "harness/kinds/pair/metamorphic.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/pair/regimes/check_shapes.h"

namespace touchstone::kinds {
namespace {

Variant named(const files::Case& c, std::string name) {
  Variant variant;
  variant.transformed = c;
  variant.transformed.id = c.id + "/" + name;
  variant.name = std::move(name);
  return variant;
}

// Returns whether x + d is exact.
bool adds_exactly(double x, double d) {
  const double sum = x + d;
  return std::isfinite(sum) && sum - d == x && sum - x == d;
}

// Multiplies by powers of two, and records whether all products were exact.
class Scaling {
 public:
  explicit Scaling(int exponent) : exponent_(exponent) {}
  bool exact() const { return exact_; }

  void operator()(double& x) {
    const double scaled = std::ldexp(x, exponent_);
    if (x != 0 && !std::isnormal(scaled)) exact_ = false;
    x = scaled;
  }
  void operator()(Vec3d& v) {
    for (double& x : v) (*this)(x);
  }
  void operator()(Shape& shape) {
    (*this)(shape.radius);
    (*this)(shape.half_length);
    (*this)(shape.half_extents);
    (*this)(shape.radii);
    (*this)(shape.offset);
    if (shape.kind != ShapeKind::hull) return;
    // Faces, edges and unit normals do not change.
    auto hull = std::make_shared<Hull>(*shape.hull);
    for (Vec3d& v : hull->vertices) (*this)(v);
    shape.hull = std::move(hull);
  }

 private:
  int exponent_;
  bool exact_ = true;
};

void shuffle_vertices(Shape& shape, base::Random& random) {
  if (shape.kind != ShapeKind::hull) return;
  std::vector<Vec3d> vertices = shape.hull->vertices;
  for (std::size_t i = vertices.size(); i > 1; --i) {
    std::swap(vertices[i - 1], vertices[random.below(i)]);
  }
  shape = hull_of(std::move(vertices));
}

template <class T>
void append(std::vector<T>& list, std::vector<T> more) {
  for (T& item : more) list.push_back(std::move(item));
}

}  // namespace

Variant swap_variant(const files::Case& c) {
  Variant variant = named(c, "swap");
  std::swap(variant.transformed.shape_a, variant.transformed.shape_b);
  std::swap(variant.transformed.pose_a, variant.transformed.pose_b);
  variant.swapped = true;
  return variant;
}

Variant rotation_variant(const files::Case& c, const geometry::SignedPermutation& rotation) {
  Variant variant = named(c, "rotation" + rotation.name());
  variant.rotation = rotation;
  for (Pose* pose : {&variant.transformed.pose_a, &variant.transformed.pose_b}) {
    pose->rotation = rotation(pose->rotation);
    pose->translation = rotation(pose->translation);
  }
  return variant;
}

std::vector<Variant> translation_variants(const files::Case& c, base::Random& random) {
  Variant variant = named(c, "translation");
  Vec3d& a = variant.transformed.pose_a.translation;
  Vec3d& b = variant.transformed.pose_b.translation;
  for (int axis = 0; axis < 3; ++axis) {
    // The random candidate is a few units of a power of two, of about the coordinates' size.
    const double greatest = std::max(std::abs(a[axis]), std::abs(b[axis]));
    const int exponent = greatest > 0 ? std::ilogb(greatest) : 0;
    const double wild = std::ldexp(static_cast<double>(random.below(15)) - 7, exponent - 2);
    std::array<double, 3> candidates = {wild, -a[axis], -b[axis]};
    std::swap(candidates[0], candidates[random.below(3)]);
    for (const double d : candidates) {
      if (d == 0 || !adds_exactly(a[axis], d) || !adds_exactly(b[axis], d)) continue;
      variant.translation[axis] = d;
      a[axis] += d;
      b[axis] += d;
      break;
    }
  }
  if (variant.translation.isZero(0)) return {};
  return {std::move(variant)};
}

std::vector<Variant> scale_variants(const files::Case& c, int exponent) {
  Variant variant = named(c, "scale-2^" + std::to_string(exponent));
  variant.exponent = exponent;
  Scaling scale(exponent);
  scale(variant.transformed.shape_a);
  scale(variant.transformed.shape_b);
  scale(variant.transformed.pose_a.translation);
  scale(variant.transformed.pose_b.translation);
  if (!scale.exact()) return {};
  return {std::move(variant)};
}

std::vector<Variant> vertex_variants(const files::Case& c, base::Random& random) {
  if (c.shape_a.kind != ShapeKind::hull && c.shape_b.kind != ShapeKind::hull) return {};
  Variant variant = named(c, "vertices");
  shuffle_vertices(variant.transformed.shape_a, random);
  shuffle_vertices(variant.transformed.shape_b, random);
  return {std::move(variant)};
}

std::vector<Variant> variants(const files::Case& c, base::Random& random) {
  std::vector<Variant> list;
  list.push_back(swap_variant(c));
  const auto turns = geometry::signed_permutations();
  list.push_back(rotation_variant(c, turns[1 + random.below(turns.size() - 1)]));
  append(list, translation_variants(c, random));
  append(list, scale_variants(c, 1 + static_cast<int>(random.below(40))));
  append(list, scale_variants(c, -1 - static_cast<int>(random.below(40))));
  append(list, vertex_variants(c, random));
  return list;
}

std::vector<Variant> sampled_variants(const files::Case& c, std::uint64_t seed,
                                      std::uint64_t index) {
  if (!is_sampled(index)) return {};
  base::Random random(seed, index);
  return variants(c, random);
}

std::string kind_of(const Variant& variant) {
  return variant.name.substr(0, variant.name.find_first_of("+-"));
}

Outcome to_original(const Variant& variant, const Outcome& outcome) {
  Outcome original = variant.swapped ? touchstone::swapped(outcome) : outcome;
  const geometry::SignedPermutation back = variant.rotation.inverse();
  for (double* length : {&original.distance, &original.lower, &original.upper}) {
    *length = std::ldexp(*length, -variant.exponent);
  }
  original.normal = back(original.normal);
  for (Vec3d* point : {&original.witness_a, &original.witness_b}) {
    *point = back(Vec3d(*point - variant.translation));
    for (double& x : *point) x = std::ldexp(x, -variant.exponent);
  }
  return original;
}

}  // namespace touchstone::kinds
