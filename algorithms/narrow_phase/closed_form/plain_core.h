// Parts of plain_pair.cpp, plain_capsule_box.cpp, plain_box_depth.cpp and plain_box_rest.cpp: vectors, the nearest points of two cores, and the proof of
// an answer by a plane. The vector w between the points bounds the distance of the cores from above,
// whatever its rounding error, since both points are in the cores. The plane across w bounds it from
// below: the distance is at least (w . c - e_a(w) - e_b(w)) / |w|, where c joins the centres and e(w)
// is how far a core extends along w. The two differ by rounding only if w is right. Nothing is
// assumed of the rotations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::plain {

// All rounding errors of a gap together, as a part of the sum of all lengths: each of the fewer than
// 40 operations behind it has an error of at most 2^-53 of a number that is not greater than that
// sum.
inline constexpr double rounding = 40 * 0x1p-53;

// Squares below this may have lost digits to underflow, squares above to overflow.
inline constexpr double least_square = 1e-280, greatest_square = 1e280;

struct Vec {
  double x, y, z;
};
inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec read(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }
inline Vec column(const Mat3d& m, int k) { return {m(0, k), m(1, k), m(2, k)}; }
inline Vec3d written(const Vec& v) { return {v.x, v.y, v.z}; }

using Three = std::array<double, 3>;
inline Three three(const Vec& v) { return {v.x, v.y, v.z}; }

// A matrix is taken for a rotation within this, where a depth along all axes is asked for: by so much its
// columns may differ from unit length and from right angles. It changes a depth by at most eight times
// that of the sum of the lengths.
inline constexpr double greatest_skew = 1.5e-15;
inline bool is_rotation(const Vec& x, const Vec& y, const Vec& z) {
  const double lengths =
      std::max(std::max(std::abs(dot(x, x) - 1), std::abs(dot(y, y) - 1)), std::abs(dot(z, z) - 1));
  const double angles =
      std::max(std::max(std::abs(dot(x, y)), std::abs(dot(y, z))), std::abs(dot(z, x)));
  return std::max(lengths, angles) <= greatest_skew;
}

// The nearest points of two cores, relative to the centre of core a.
struct Nearest {
  Vec on_a, on_b;
  Vec between;          // on_b - on_a
  double along_centre;  // between . (centre of b - centre of a)
  double extent;        // how far both cores extend along `between`, times its length
  double size;          // the sum of all lengths that the points were calculated from
};

// Each of these is one instruction; std::clamp may be a jump.
inline double clamp(double x, double least, double greatest) {
  return std::min(std::max(x, least), greatest);
}

inline double length(const Vec& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// Writes an answer that is sure.
inline void write(Answer answer, Outcome& outcome) {
  outcome.answer = answer;
  outcome.status = Status::ok;
  outcome.iterations = 0;
  outcome.support_calls = -1;
}

// Writes the outcome for cores with balls of these radii around them; those that are further apart than
// `margin` (metres) get no distance. Returns false, and leaves it as
// it is, if that leaves the answer or a number open.
inline bool answer(Task task, double margin, const Nearest& cores, double radius_a, double radius_b,
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

// From the centre of a capsule's segment to its end.
inline Vec half_of(const Shape& capsule, const Pose& pose) {
  return capsule.half_length * column(pose.rotation, 2);
}

}  // namespace touchstone::plain
