// Boxes that rest, one pair at a time: the plane of the face with the greatest gap, and two points, as
// in kernels/batch/box_pair_rest.inl, with the same bounds on what rounding may do.
#include "algorithms/narrow_phase/closed_form/plain_box_rest.h"

#include <array>

#include "algorithms/kernels/batch/box_pair_lanes.h"
#include "algorithms/narrow_phase/closed_form/plain_core.h"

namespace touchstone {
namespace {

using namespace plain;

using Error = RestError<double>;
// Gaps of faces beyond this are no contact, whatever rounding did.
constexpr double near = 128 * Error::u;

struct Box {
  std::array<Vec, 3> axes;
  Three half;
};
Box read_box(const Shape& shape, const Pose& pose) {
  return {{column(pose.rotation, 0), column(pose.rotation, 1), column(pose.rotation, 2)},
          three(read(shape.half_extents))};
}
Vec at(const Box& box, const Three& place) {
  return place[0] * box.axes[0] + place[1] * box.axes[1] + place[2] * box.axes[2];
}
double reach(const Box& box, const Vec& along) {
  return box.half[0] * std::abs(dot(box.axes[0], along)) +
         box.half[1] * std::abs(dot(box.axes[1], along)) +
         box.half[2] * std::abs(dot(box.axes[2], along));
}

struct Face {
  double gap = -std::numeric_limits<double>::infinity();
  int number = 0;  // of a's axes, then of b's
};

// The face with the greatest gap, for boxes whose axes are orthonormal.
Face widest_face(const Box& a, const Box& b, const Vec& offset) {
  std::array<double, 6> gaps;
  for (int k = 0; k < 3; ++k) {
    gaps[k] = std::abs(dot(a.axes[k], offset)) - a.half[k];
    gaps[3 + k] = std::abs(dot(b.axes[k], offset)) - b.half[k];
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double cosine = std::abs(dot(a.axes[i], b.axes[j]));
      gaps[i] -= b.half[j] * cosine;
      gaps[3 + j] -= a.half[i] * cosine;
    }
  }
  Face face;
  for (int k = 0; k < 6; ++k) {
    if (gaps[k] > face.gap) face = {gaps[k], k};
  }
  return face;
}

}  // namespace

bool solve_plain_box_rest(Task task, const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                          const Pose& pose_b, Outcome& outcome) {
  const Box a = read_box(shape_a, pose_a), b = read_box(shape_b, pose_b);
  const Vec between = read(pose_b.translation) - read(pose_a.translation);
  const double size =
      length(between) + a.half[0] + a.half[1] + a.half[2] + b.half[0] + b.half[1] + b.half[2];
  if (!(size > 1e-120 && size < 1e120)) return false;
  const Face face = widest_face(a, b, between);
  if (!(std::abs(face.gap) <= near * size)) return false;
  if (!is_rotation(a.axes[0], a.axes[1], a.axes[2]) ||
      !is_rotation(b.axes[0], b.axes[1], b.axes[2]))
    return false;

  const bool of_b = face.number >= 3;
  const int number = face.number % 3;
  const Box &own = of_b ? b : a, &other = of_b ? a : b;
  const Vec offset = of_b ? -1 * between : between;
  const double along = dot(own.axes[number], offset), side = along < 0 ? -1 : 1;
  const Vec normal = side * own.axes[number];
  const double room = Error::room * size, error = Error::rest * size;
  const double gap = (std::abs(along) - reach(own, normal)) - reach(other, normal);
  const double depth = std::max(-gap, 0.0), apart = std::max(gap, 0.0);
  // The place of the first point is that deep inside its box from every face; that of the second is
  // on the feature that meets the face.
  Three low, high, low_other, high_other;
  for (int k = 0; k < 3; ++k) {
    const double inside = std::max(own.half[k] - depth, 0.0);
    low[k] = k == number ? side * inside : -inside;
    high[k] = k == number ? side * inside : inside;
    const double half = other.half[k], lean = half * dot(normal, other.axes[k]);
    low_other[k] = lean < -room ? half : -half;
    high_other[k] = lean > room ? -half : half;
  }
  const auto nearest = [](const Box& box, const Vec& to, const Three& least,
                          const Three& greatest) {
    return Three{clamp(dot(box.axes[0], to), least[0], greatest[0]),
                 clamp(dot(box.axes[1], to), least[1], greatest[1]),
                 clamp(dot(box.axes[2], to), least[2], greatest[2])};
  };
  const Vec up = apart * normal, start = up - offset;
  Three place = nearest(own, offset, low, high);
  Vec point, line;
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    point = offset + at(other, nearest(other, at(own, place) + start, low_other, high_other));
    place = nearest(own, point - up, low, high);
    line = point - at(own, place);
    const Vec miss = line - up;
    if (std::max({std::abs(miss.x), std::abs(miss.y), std::abs(miss.z)}) <= room) break;
  }
  const double inside =
      std::min({own.half[0] - std::abs(place[0]), own.half[1] - std::abs(place[1]),
                own.half[2] - std::abs(place[2])});
  const double apart_at_most = std::sqrt(dot(line, line)) - inside;
  const double lower = gap - error, upper = apart_at_most + error;
  const bool narrow = upper - lower < Error::widest * size;
  const Answer answer = lower > 0   ? Answer::separated
                        : upper < 0 ? Answer::overlapping
                                    : Answer::touching;
  const bool asked = asks_for_number(task, answer);
  if (!narrow && (asked || answer != Answer::separated)) return false;
  // Farther from contact another proof may decide.
  if (answer == Answer::touching &&
      !(std::max(std::abs(gap), apart_at_most) < Error::at_contact * size))
    return false;
  write(answer, outcome);
  if (answer == Answer::touching || asked) {
    outcome.lower = lower;
    outcome.upper = upper;
  }
  if (!asked) return true;
  outcome.distance = gap;
  const Vec origin = read((of_b ? pose_b : pose_a).translation);
  const Vec on_other = origin + point, on_own = origin + (point - gap * normal);
  outcome.normal = written(of_b ? -1 * normal : normal);
  outcome.witness_a = written(of_b ? on_other : on_own);
  outcome.witness_b = written(of_b ? on_own : on_other);
  return true;
}

}  // namespace touchstone
