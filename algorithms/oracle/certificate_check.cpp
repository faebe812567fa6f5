#include "algorithms/oracle/certificate_check.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace touchstone::oracle {
namespace {

using Vector = std::array<mpq_class, 3>;

struct Fault {
  std::string reason;
};
void require(bool holds, const char* otherwise) {
  if (!holds) throw Fault{otherwise};
}

// --- numbers, all exact but for one bound ---

mpq_class rational(long double x) {
  require(std::isfinite(x), "a number of a body or of a generator is not finite");
  int exponent = 0;
  mpq_class sum;
  for (x = std::frexp(x, &exponent); x != 0;) {  // as a sum of doubles
    const auto part = static_cast<double>(x);
    sum += mpq_class(part);
    x -= part;
  }
  return exponent < 0 ? mpq_class(sum >> -exponent) : mpq_class(sum << exponent);
}

mpq_class rational(const Integer& x) {
  std::vector<std::uint64_t> parts;
  export_bits(Integer(abs(x)), std::back_inserter(parts), 64);
  mpz_class whole;
  mpz_import(whole.get_mpz_t(), parts.size(), 1, sizeof parts[0], 0, 0, parts.data());
  return x < 0 ? -whole : whole;
}

template <class Three>
Vector vector(const Three& v) {
  return {rational(v[0]), rational(v[1]), rational(v[2])};
}

mpq_class dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Vector operator+(const Vector& u, const Vector& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}
Vector operator-(const Vector& u, const Vector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
Vector operator*(const mpq_class& s, const Vector& v) { return {s * v[0], s * v[1], s * v[2]}; }
bool is_zero(const Vector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

// At least the root of x >= 0, too great by less than 2^-bits over the denominator of x; the root
// itself where it is rational.
mpq_class root_above(const mpq_class& x, mp_bitcnt_t bits) {
  const mpz_class square = (x.get_num() * x.get_den()) << 2 * bits;
  mpz_class root = sqrt(square);
  if (root * root != square) ++root;
  mpq_class above(root, x.get_den() << bits);
  above.canonicalize();
  return above;
}

// Of a length x, the rational x * |x|, which orders as the lengths do; or infinitely long.
struct SignedSquare {
  int infinite = 0;  // its sign
  mpq_class square = {};

  friend std::strong_ordering operator<=>(const SignedSquare& x, const SignedSquare& y) {
    if (x.infinite != y.infinite) return x.infinite <=> y.infinite;
    return cmp(x.square, y.square) <=> 0;
  }
};

// Of the length x / sqrt(square).
SignedSquare quotient(const mpq_class& x, const mpq_class& square) {
  return {0, x * abs(x) / square};
}

SignedSquare signed_square(const SignedRoot& x) {
  const bool one_sign = x.sign == -1 || x.sign == 1;
  require(one_sign ? x.numerator > 0 && x.denominator >= 0
                   : x.sign == 0 && x.numerator == 0 && x.denominator > 0,
          "a claimed bound is not a number");
  if (x.denominator == 0) return {x.sign};
  return {0, x.sign * rational(x.numerator) / rational(x.denominator)};
}

// --- bodies ---

// A body's core in the world. Roots are taken to so many bits.
class Core {
 public:
  Core(const Body& body, mp_bitcnt_t root_bits)
      : solid_(*body.solid), root_bits_(root_bits), translation_(vector(body.translation)) {
    if (body.quaternion) {
      const auto& q = *body.quaternion;
      const mpq_class w = rational(q[0]);
      const Vector v = {rational(q[1]), rational(q[2]), rational(q[3])};
      const mpq_class square = w * w + dot(v, v);
      require(square != 0, "a quaternion is zero");
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        rows_[i][i] = (w * w + v[i] * v[i] - v[j] * v[j] - v[k] * v[k]) / square;
        rows_[i][j] = 2 * (v[i] * v[j] - w * v[k]) / square;
        rows_[i][k] = 2 * (v[i] * v[k] + w * v[j]) / square;
      }
    } else {
      for (int i = 0; i < 3; ++i) rows_[i] = vector(Vec3d(body.matrix.row(i)));
    }
    if (is_halfspace()) place_plane();
    extents_ = vector(solid_.extents);
    for (const mpq_class& extent : extents_) require(extent >= 0, "an extent is negative");
    require(solid_.core != Solid::Core::polytope || !solid_.vertices.empty(),
            "a polytope has no vertices");
  }

  bool is_halfspace() const { return solid_.core == Solid::Core::halfspace; }
  // A half-space is normal . x <= height; the normal is outward, and zero where the matrix is
  // singular, so that there is no half-space.
  const Vector& normal() const { return normal_; }

  // At least the greatest n . x of the core's points x; none where they have no greatest.
  std::optional<mpq_class> support(const Vector& n) const {
    if (is_halfspace()) {
      const mpq_class along = dot(n, normal_);
      if (!is_zero(cross(n, normal_)) || along <= 0) return {};
      return along / dot(normal_, normal_) * height_;
    }
    const Vector u = n[0] * rows_[0] + n[1] * rows_[1] + n[2] * rows_[2];
    return support_in_body(u) + dot(n, translation_);
  }

  // The generators in the world, each checked to lie in the core; of a half-space, a point of its
  // plane.
  std::vector<Vector> points(const std::vector<Generator>& generators) const {
    if (is_halfspace()) {
      require(generators.empty(), "a half-space has no generators");
      require(!is_zero(normal_), "the matrix of a half-space is singular");
      return {height_ / dot(normal_, normal_) * normal_};
    }
    std::vector<Vector> all;
    for (const Generator& generator : generators) {
      const Vector x = point_in_body(generator);
      all.push_back(Vector{dot(rows_[0], x), dot(rows_[1], x), dot(rows_[2], x)} + translation_);
    }
    return all;
  }

 private:
  void place_plane() {
    const Vector n = vector(solid_.normal);
    require(!is_zero(n), "the normal of a half-space is zero");
    const std::array<Vector, 3> cofactors = {cross(rows_[1], rows_[2]), cross(rows_[2], rows_[0]),
                                             cross(rows_[0], rows_[1])};
    const mpq_class determinant = dot(rows_[0], cofactors[0]);
    for (int i = 0; i < 3; ++i) normal_[i] = sgn(determinant) * dot(cofactors[i], n);
    height_ = abs(determinant) * rational(solid_.offset) + dot(normal_, translation_);
  }

  mpq_class support_in_body(const Vector& u) const {
    const mpq_class end = extents_[2] * u[2];
    const auto rim = [&]() -> mpq_class {
      return extents_[0] * root_above(u[0] * u[0] + u[1] * u[1], root_bits_);
    };
    switch (solid_.core) {
      case Solid::Core::cylinder: return abs(end) + rim();
      case Solid::Core::cone: return std::max<mpq_class>(end, rim() - end);
      case Solid::Core::ellipsoid: {
        const Vector scaled = {extents_[0] * u[0], extents_[1] * u[1], end};
        return root_above(dot(scaled, scaled), root_bits_);
      }
      default: break;
    }
    mpq_class greatest = dot(u, vector(solid_.vertices[0]));
    for (const Vec3d& vertex : solid_.vertices) {
      greatest = std::max<mpq_class>(greatest, dot(u, vector(vertex)));
    }
    return greatest;
  }

  Vector point_in_body(const Generator& generator) const {
    if (solid_.core == Solid::Core::polytope) {
      require(generator.vertex >= 0 &&
                  static_cast<std::size_t>(generator.vertex) < solid_.vertices.size(),
              "a generator names no vertex of its polytope");
      return vector(solid_.vertices[static_cast<std::size_t>(generator.vertex)]);
    }
    require(generator.vertex < 0, "a generator names a vertex of a body that has none");
    const Vector x = vector(generator.point);
    require(holds(x), "a generator lies outside its body");
    return x;
  }

  // Whether a round core holds the point.
  bool holds(const Vector& x) const {
    const auto& [r, s, h] = extents_;
    if (solid_.core == Solid::Core::ellipsoid) {
      mpq_class sum;
      for (int i = 0; i < 3; ++i) {
        if (extents_[i] == 0 && x[i] != 0) return false;
        if (extents_[i] != 0) sum += x[i] * x[i] / (extents_[i] * extents_[i]);
      }
      return sum <= 1;
    }
    const mpq_class off_axis = x[0] * x[0] + x[1] * x[1];
    if (abs(x[2]) > h || off_axis > r * r) return false;
    const mpq_class below_tip = r * (h - x[2]);
    return solid_.core == Solid::Core::cylinder || 4 * h * h * off_axis <= below_tip * below_tip;
  }

  const Solid& solid_;
  mp_bitcnt_t root_bits_;
  std::array<Vector, 3> rows_;
  Vector translation_, extents_, normal_;
  mpq_class height_;
};

// --- what is proven ---

SignedSquare gap_along(const Vector& n, const Core& a, const Core& b) {
  const auto reach_a = a.support(n), reach_b = b.support(mpq_class(-1) * n);
  if (!reach_a || !reach_b) return {-1};
  return quotient(-*reach_a - *reach_b, dot(n, n));
}

SignedSquare proven_lower(const Certificate& certificate, const Core& a, const Core& b) {
  const Vector n = vector(certificate.direction);
  if (!is_zero(n)) return gap_along(n, a, b);
  require(certificate.lower.is_infinite(), "the direction is zero");
  return {-1};
}

// Points of the difference of the cores, by their generators.
class Difference {
 public:
  Difference(std::vector<Vector> a, std::vector<Vector> b) : a_(std::move(a)), b_(std::move(b)) {}

  Vector operator()(const DifferencePoint& point) const {
    require(point.a < a_.size() && point.b < b_.size(), "a point names no generator");
    return a_[point.a] - b_[point.b];
  }
  Vector operator()(const std::vector<Certificate::Term>& terms) const {
    Vector sum;
    mpq_class weights;
    for (const Certificate::Term& term : terms) {
      require(term.weight > 0, "a weight is not positive");
      sum = sum + rational(term.weight) * (*this)(term.point);
      weights += rational(term.weight);
    }
    return 1 / weights * sum;
  }

 private:
  std::vector<Vector> a_, b_;
};

// Minus the least distance of the triangles' planes from the origin. No edge is without its
// reverse, so the surface goes around the origin a whole number of times; that is at least once,
// as each triangle goes the same way. So each ray from the origin meets the surface, no nearer than
// the nearest plane.
SignedSquare surface_depth(const Certificate::Surface& surface, const Difference& difference) {
  std::vector<Vector> points;
  for (const DifferencePoint& point : surface.points) points.push_back(difference(point));
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  SignedSquare least{-1};
  for (const auto& corners : surface.triangles) {
    for (int i = 0; i < 3; ++i) {
      require(corners[i] < points.size(), "a triangle names no point of the surface");
      require(edges.emplace(corners[i], corners[(i + 1) % 3]).second,
              "an edge of the surface is there twice");
    }
    const Vector &p = points[corners[0]], &q = points[corners[1]], &r = points[corners[2]];
    const Vector n = cross(q - p, r - p);
    const mpq_class height = dot(n, p);
    require(height > 0, "the origin is not on the inner side of each triangle");
    least = std::max(least, quotient(-height, dot(n, n)));
  }
  for (const auto& [tail, head] : edges) {
    require(edges.contains({head, tail}), "the surface is not closed");
  }
  return least;
}

SignedSquare proven_upper(const Certificate& certificate, const Core& a, const Core& b) {
  if (certificate.upper.sign > 0 && certificate.upper.is_infinite()) return {1};
  const Difference difference(a.points(certificate.a), b.points(certificate.b));
  // Two half-spaces are their own proof: along any other direction they have no gap.
  if (a.is_halfspace() && b.is_halfspace()) return gap_along(a.normal(), a, b);
  require(!certificate.closest.empty() || !certificate.surface.triangles.empty(),
          "nothing is there to prove the upper bound");
  SignedSquare best{1};
  if (!certificate.closest.empty()) {
    const Vector z = difference(certificate.closest);
    if (a.is_halfspace() || b.is_halfspace()) {
      const Vector& n = (a.is_halfspace() ? a : b).normal();
      const mpq_class height = dot(n, z);
      best = quotient(a.is_halfspace() ? mpq_class(-height) : height, dot(n, n));
    } else {
      best = {0, dot(z, z)};
    }
  }
  if (!certificate.surface.triangles.empty()) {
    require(!a.is_halfspace() && !b.is_halfspace(), "a half-space has no surface");
    best = std::min(best, surface_depth(certificate.surface, difference));
  }
  return best;
}

mp_bitcnt_t size_of(const Integer& x) { return x > 0 ? msb(x) : 0; }

Answer answer_of(const SignedSquare& lower, const SignedSquare& upper, const mpq_class& radius) {
  const SignedSquare radii{0, radius * radius};
  if (lower > radii) return Answer::separated;
  if (upper < radii) return Answer::overlapping;
  return lower >= radii && upper <= radii ? Answer::touching : Answer::unknown;
}

}  // namespace

std::string fault(const Certificate& certificate, const Body& a, const Body& b) {
  try {
    const SignedSquare lower = signed_square(certificate.lower);
    const SignedSquare upper = signed_square(certificate.upper);
    // Far finer than what is claimed, whose rounding is of about the claim's own size.
    const mp_bitcnt_t root_bits =
        256 + size_of(certificate.lower.numerator) + size_of(certificate.lower.denominator);
    const Core core_a(a, root_bits), core_b(b, root_bits);
    const mpq_class radius_a = rational(a.solid->radius), radius_b = rational(b.solid->radius);
    require(radius_a >= 0 && radius_b >= 0, "a radius is negative");
    require(lower <= proven_lower(certificate, core_a, core_b),
            "the direction does not prove the lower bound");
    require(upper >= proven_upper(certificate, core_a, core_b),
            "the points do not prove the upper bound");
    require(certificate.answer == answer_of(lower, upper, radius_a + radius_b),
            "the answer does not follow from the bounds");
  } catch (const Fault& found) {
    return found.reason;
  }
  return {};
}

}  // namespace touchstone::oracle
