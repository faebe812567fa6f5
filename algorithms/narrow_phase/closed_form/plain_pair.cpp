// Finds the nearest points of two cores (a point, a segment or a box), and proves the answer by a
// plane. The vector w between them bounds the distance of the cores from above, whatever its
// rounding error, since both points are in the cores. The plane across w bounds it from below: the
// distance is at least (w . c - e_a(w) - e_b(w)) / |w|, where c joins the centres and e(w) is how
// far a core extends along w. The two differ by rounding only if w is right. Nothing is assumed of
// the rotations.
#include "algorithms/narrow_phase/closed_form/plain_pair.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

// All rounding errors of a gap together, as a part of the sum of all lengths: each of the fewer than
// 40 operations behind it has an error of at most 2^-53 of a number that is not greater than that
// sum.
constexpr double rounding = 40 * 0x1p-53;

// Squares below this may have lost digits to underflow, squares above to overflow.
constexpr double least_square = 1e-280, greatest_square = 1e280;

struct Vec {
  double x, y, z;
};
Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec read(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }
Vec column(const Mat3d& m, int k) { return {m(0, k), m(1, k), m(2, k)}; }
Vec3d written(const Vec& v) { return {v.x, v.y, v.z}; }

// The nearest points of two cores, relative to the centre of core a.
struct Nearest {
  Vec on_a, on_b;
  Vec between;          // on_b - on_a
  double along_centre;  // between . (centre of b - centre of a)
  double extent;        // how far both cores extend along `between`, times its length
  double size;          // the sum of all lengths that the points were calculated from
};

// `centre` is that of core b.
Nearest of_points(const Vec& centre, double size) {
  return {{0, 0, 0}, centre, centre, dot(centre, centre), 0, size};
}

// Each of these is one instruction; std::clamp may be a jump.
double clamp(double x, double least, double greatest) {
  return std::min(std::max(x, least), greatest);
}

// A point and the segment around `centre` with this half.
Nearest of_point_and_segment(const Vec& centre, const Vec& half, double size) {
  const double square = dot(half, half);
  const double t = square > 0 ? clamp(-dot(centre, half) / square, -1, 1) : 0;
  const Vec point = centre + t * half;
  return {{0, 0, 0}, point, point, dot(point, centre), std::abs(dot(point, half)), size};
}

// The segments of these halves, one around the origin, one around `centre` (Ericson, Real-Time
// Collision Detection, 2005, section 5.1.9). Divisions do not wait for one another.
Nearest of_segments(const Vec& half_a, const Vec& centre, const Vec& half_b, double size) {
  const double aa = dot(half_a, half_a), bb = dot(half_b, half_b), ab = dot(half_a, half_b);
  const double ac = dot(half_a, centre), bc = dot(half_b, centre);
  const double over_aa = aa > 0 ? 1 / aa : 0, over_bb = bb > 0 ? 1 / bb : 0;
  const double determinant = aa * bb - ab * ab;
  const double over = determinant > 1e-12 * aa * bb ? 1 / determinant : 0;
  double s = clamp((ac * bb - ab * bc) * over, -1, 1);
  const double t = clamp((s * ab - bc) * over_bb, -1, 1);
  s = clamp((t * ab + ac) * over_aa, -1, 1);
  const Vec on_a = s * half_a, on_b = centre + t * half_b;
  const Vec between = on_b - on_a;
  return {on_a,
          on_b,
          between,
          dot(between, centre),
          std::abs(dot(between, half_a)) + std::abs(dot(between, half_b)),
          size};
}

// A point and the box around `centre`.
Nearest of_point_and_box(const Vec& centre, const Mat3d& matrix, const Vec3d& half, double size) {
  const Vec x = column(matrix, 0), y = column(matrix, 1), z = column(matrix, 2);
  const auto local = [&](const Vec& axis, int k) {
    return clamp(-dot(axis, centre), -half[k], half[k]);
  };
  const Vec point = centre + local(x, 0) * x + local(y, 1) * y + local(z, 2) * z;
  const double extent = half[0] * std::abs(dot(point, x)) + half[1] * std::abs(dot(point, y)) +
                        half[2] * std::abs(dot(point, z));
  return {{0, 0, 0}, point, point, dot(point, centre), extent, size};
}

// Whether a ball around the origin meets the box around `centre`: in the box's own axes, which must
// be those of a rotation up to `skew`. `unknown` if they are not, or rounding leaves it open.
Answer ball_meets_box(double radius, const Vec& centre, const Mat3d& matrix, const Vec3d& half) {
  constexpr double skew = 1e-14;
  const Vec x = column(matrix, 0), y = column(matrix, 1), z = column(matrix, 2);
  const double off = std::max(std::max(std::max(std::abs(dot(x, x) - 1), std::abs(dot(y, y) - 1)),
                                       std::max(std::abs(dot(z, z) - 1), std::abs(dot(x, y)))),
                              std::max(std::abs(dot(y, z)), std::abs(dot(z, x))));
  const auto beyond = [&](const Vec& axis, int k) {
    return std::max(std::abs(dot(axis, centre)) - half[k], 0.0);
  };
  const Vec out{beyond(x, 0), beyond(y, 1), beyond(z, 2)};
  const double square = dot(out, out);
  const double size = std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z) + half[0] +
                      half[1] + half[2] + radius;
  const double error = (rounding + 8 * skew) * size;
  const double inner = radius - error, outer = radius + error;
  const bool in_range = size > 1e-130 && size < 1e130 && off <= skew;
  if (in_range && square > outer * outer) return Answer::separated;
  if (in_range && inner > 0 && square < inner * inner) return Answer::overlapping;
  return Answer::unknown;
}

double length(const Vec& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

void write(Answer answer, Outcome& outcome) {
  outcome.answer = answer;
  outcome.status = Status::ok;
  outcome.iterations = 0;
  outcome.support_calls = -1;
}

bool answer(Task task, double margin, const Nearest& cores, double radius_a, double radius_b,
            const Pose& pose_a, Outcome& outcome) {
  const double square = dot(cores.between, cores.between);
  const double radii = radius_a + radius_b;
  const double size = cores.size + radii;
  if (!(std::max(square, radii * radii) > least_square && size * size < greatest_square))
    return false;
  const double error = rounding * size;
  // Squares are compared, since a root takes longer than all the rest.
  const double inner = radii - error, outer = radii + error;
  const bool common = inner > 0 && square < inner * inner;
  const double along = cores.along_centre - cores.extent;
  const bool apart = along > 0 && along * along > square * (outer * outer);
  if (!apart && !common) return false;
  if (!asks_for_number(task, apart ? Answer::separated : Answer::overlapping)) {
    write(apart ? Answer::separated : Answer::overlapping, outcome);
    return true;
  }
  // The bound is on the distance of the cores, so the margin is added to the radii.
  if (apart && along * along > square * ((outer + margin) * (outer + margin))) {
    write(Answer::separated, outcome);
    write_beyond(margin, outcome);
    return true;
  }
  // A normal of nearly coincident points would have lost its digits.
  const double distance = std::sqrt(square), inverse = 1 / distance;
  const double lower = along * inverse - outer, upper = distance - inner;
  if (!(distance > 1e-3 * size && upper - lower < 4 * error)) return false;
  write(apart ? Answer::separated : Answer::overlapping, outcome);
  const Vec normal = inverse * cores.between;
  const Vec origin = read(pose_a.translation);
  outcome.distance = distance - radii;
  outcome.lower = lower;
  outcome.upper = upper;
  outcome.normal = written(normal);
  outcome.witness_a = written(origin + (cores.on_a + radius_a * normal));
  outcome.witness_b = written(origin + (cores.on_b - radius_b * normal));
  return true;
}

Vec half_of(const Shape& capsule, const Pose& pose) {
  return capsule.half_length * column(pose.rotation, 2);
}

constexpr int of_kinds(ShapeKind a, ShapeKind b) {
  return 8 * static_cast<int>(a) + static_cast<int>(b);
}

}  // namespace

bool solve_plain_pair(Task task, const Shape& a, const Pose& pose_a, const Shape& b,
                      const Pose& pose_b, Outcome& outcome, double margin) {
  const Vec centre = read(pose_b.translation) - read(pose_a.translation);
  const double size = length(centre);
  switch (of_kinds(a.kind, b.kind)) {
    case of_kinds(ShapeKind::sphere, ShapeKind::sphere):
      return answer(task, margin, of_points(centre, size), a.radius, b.radius, pose_a, outcome);
    case of_kinds(ShapeKind::sphere, ShapeKind::capsule): {
      const Vec half = half_of(b, pose_b);
      return answer(task, margin, of_point_and_segment(centre, half, size + length(half)), a.radius,
                    b.radius, pose_a, outcome);
    }
    case of_kinds(ShapeKind::sphere, ShapeKind::box): {
      if (task == Task::intersect) {
        const Answer found = ball_meets_box(a.radius, centre, pose_b.rotation, b.half_extents);
        if (found != Answer::unknown) write(found, outcome);
        if (found != Answer::unknown) return true;
      }
      const double extent = b.half_extents.sum() * pose_b.rotation.cwiseAbs().maxCoeff();
      return answer(task, margin,
                    of_point_and_box(centre, pose_b.rotation, b.half_extents, size + extent),
                    a.radius, 0, pose_a, outcome);
    }
    case of_kinds(ShapeKind::capsule, ShapeKind::capsule): {
      const Vec half_a = half_of(a, pose_a), half_b = half_of(b, pose_b);
      return answer(task, margin,
                    of_segments(half_a, centre, half_b, size + length(half_a) + length(half_b)),
                    a.radius, b.radius, pose_a, outcome);
    }
    default: return false;
  }
}

}  // namespace touchstone
