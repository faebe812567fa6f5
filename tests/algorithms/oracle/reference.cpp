#include "tests/algorithms/oracle/reference.h"

#include <algorithm>
#include <optional>
#include <set>

namespace touchstone::oracle::reference {
namespace {

using RationalPoint = std::array<mpq_class, 3>;

mpz_class dot(const Point& u, const Point& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
Point cross(const Point& u, const Point& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Point minus(const Point& u, const Point& v) { return {u[0] - v[0], u[1] - v[1], u[2] - v[2]}; }

std::vector<RationalPoint> world_vertices(const Body& body) {
  std::array<RationalPoint, 3> m;
  if (body.quaternion) {
    // Each column is q e q* / |q|^2 for a unit vector e.
    const mpq_class w = (*body.quaternion)[0], x = (*body.quaternion)[1], y = (*body.quaternion)[2],
                    z = (*body.quaternion)[3];
    const mpq_class s = 2 / mpq_class(w * w + x * x + y * y + z * z);
    m[0] = {1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)};
    m[1] = {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)};
    m[2] = {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)};
  } else {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) m[row][column] = body.matrix(row, column);
    }
  }
  std::vector<RationalPoint> points;
  for (const Vec3d& v : body.solid->vertices) {
    RationalPoint point;
    for (int row = 0; row < 3; ++row) {
      point[row] = mpq_class(body.translation[row]) + m[row][0] * mpq_class(v[0]) +
                   m[row][1] * mpq_class(v[1]) + m[row][2] * mpq_class(v[2]);
    }
    points.push_back(point);
  }
  return points;
}

// Divided by the greatest common divisor, and turned so that the first part that is not zero is
// positive: parallel vectors become equal. None for zero.
std::optional<Point> primitive(Point v) {
  mpz_class divisor = gcd(gcd(v[0], v[1]), v[2]);
  if (divisor == 0) return {};
  const int sign = sgn(v[0]) != 0 ? sgn(v[0]) : sgn(v[1]) != 0 ? sgn(v[1]) : sgn(v[2]);
  if (sign < 0) divisor = -divisor;
  for (mpz_class& part : v) part /= divisor;
  return v;
}

void add_segments(const std::vector<Point>& points, std::set<Point>& directions) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (const auto d = primitive(minus(points[i], points[j]))) directions.insert(*d);
    }
  }
}

// The greatest n . (x - y) over x in a and y in b.
mpz_class height(const IntegerPair& pair, const Point& n) {
  const auto furthest = [&](const std::vector<Point>& points, int sign) {
    mpz_class greatest = sign * dot(n, points[0]);
    for (const Point& p : points) greatest = std::max<mpz_class>(greatest, sign * dot(n, p));
    return greatest;
  };
  return furthest(pair.a, 1) + furthest(pair.b, -1);
}

// Decides whether a flat difference contains the origin; `directions` are all that can separate it.
Answer flat_answer(const IntegerPair& pair, const std::vector<Point>& directions) {
  for (const Point& n : directions) {
    if (height(pair, n) < 0 || height(pair, minus({}, n)) < 0) return Answer::separated;
  }
  return Answer::touching;
}

}  // namespace

IntegerPair integer_pair(const Body& a, const Body& b) {
  const auto points_a = world_vertices(a), points_b = world_vertices(b);
  mpz_class multiple = 1;
  for (const auto* points : {&points_a, &points_b}) {
    for (const RationalPoint& point : *points) {
      for (const mpq_class& x : point) multiple = lcm(multiple, x.get_den());
    }
  }
  const auto integers = [&](const std::vector<RationalPoint>& points) {
    std::vector<Point> all;
    for (const RationalPoint& p : points) {
      Point point;
      for (int k = 0; k < 3; ++k) point[k] = p[k].get_num() * (multiple / p[k].get_den());
      all.push_back(point);
    }
    return all;
  };
  return {integers(points_a), integers(points_b), mpq_class(1, multiple),
          mpq_class(a.solid->radius) + mpq_class(b.solid->radius)};
}

Separation separate(const IntegerPair& pair) {
  std::set<Point> segments, normals;
  add_segments(pair.a, segments);
  add_segments(pair.b, segments);
  for (auto d = segments.begin(); d != segments.end(); ++d) {
    for (auto e = std::next(d); e != segments.end(); ++e) {
      if (const auto n = primitive(cross(*d, *e))) normals.insert(*n);
    }
  }
  const Point unit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (segments.empty()) return {flat_answer(pair, {unit[0], unit[1], unit[2]}), 0};
  if (normals.empty()) {
    const Point& line = *segments.begin();
    std::vector<Point> directions = {line};
    for (const Point& axis : unit) directions.push_back(cross(line, axis));
    return {flat_answer(pair, directions), 0};
  }
  if (normals.size() == 1) {
    const Point& plane = *normals.begin();
    std::vector<Point> directions = {plane};
    for (const Point& d : segments) directions.push_back(cross(plane, d));
    return {flat_answer(pair, directions), 0};
  }
  std::optional<mpq_class> least;
  for (const Point& n : normals) {
    for (const Point& out : {n, minus({}, n)}) {
      const mpz_class h = height(pair, out);
      if (h < 0) return {Answer::separated, 0};
      mpq_class square(h * h, dot(n, n));
      if (!least || square < *least) least = std::move(square);
    }
  }
  least->canonicalize();
  return {*least == 0 ? Answer::touching : Answer::overlapping, -*least * pair.unit * pair.unit};
}

Answer answer_of(const SignedSquare& cores, const mpq_class& radii) {
  const int sign = cmp(cores, radii * radii);
  return sign > 0 ? Answer::separated : sign < 0 ? Answer::overlapping : Answer::touching;
}

SignedSquare signed_square(const SignedRoot& root) {
  mpq_class square(mpz_class(root.numerator.str()), mpz_class(root.denominator.str()));
  square.canonicalize();
  return root.sign * square;
}

}  // namespace touchstone::oracle::reference
