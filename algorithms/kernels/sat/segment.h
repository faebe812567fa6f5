// The closest points of two segments. Used by closed-form and witness_points.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 5.1.9.
// Departs: the closest points of the two lines come from cross products, which keep their digits if
//          the lines are almost parallel, and are refined from there. The ends are candidates too,
//          so that no case depends on a threshold.
#pragma once

#include <algorithm>

#include "algorithms/core/vec.h"

namespace touchstone {

template <class Scalar>
struct Segment {
  Vec3<Scalar> start, along;  // the points start + s * along, s in [0, 1]

  Vec3<Scalar> at(Scalar s) const { return start + s * along; }
  // Parameter of the point closest to `point`.
  Scalar nearest(const Vec3<Scalar>& point) const {
    const Scalar square = along.squaredNorm();
    if (!(square > 0)) return 0;
    return std::clamp(along.dot(point - start) / square, Scalar{0}, Scalar{1});
  }
};

template <class Scalar>
struct SegmentPoints {
  Scalar s, t;  // parameters on the first and the second
  Vec3<Scalar> first, second;
  Scalar square;  // of their distance
};

template <class Scalar>
SegmentPoints<Scalar> closest_points(const Segment<Scalar>& p, const Segment<Scalar>& q) {
  const auto points = [&](Scalar s, Scalar t) {
    const Vec3<Scalar> first = p.at(s), second = q.at(t);
    return SegmentPoints<Scalar>{s, t, first, second, (first - second).squaredNorm()};
  };
  SegmentPoints<Scalar> best = points(0, q.nearest(p.start));
  const auto offer = [&](const SegmentPoints<Scalar>& candidate) {
    if (candidate.square < best.square) best = candidate;
  };
  offer(points(1, q.nearest(p.at(1))));
  offer(points(p.nearest(q.start), 0));
  offer(points(p.nearest(q.at(1)), 1));

  const Vec3<Scalar> across = p.along.cross(q.along);
  const Scalar square = across.squaredNorm();
  if (!(square > 0)) return best;
  Scalar s = 0, t = 0;
  for (int step = 0; step < 3; ++step) {
    // The parameters' distances from the lines' closest points.
    const Vec3<Scalar> between = q.at(t) - p.at(s);
    const Scalar ds = between.cross(q.along).dot(across) / square;
    const Scalar dt = between.cross(p.along).dot(across) / square;
    s = std::clamp(s + ds, Scalar{0}, Scalar{1});
    t = std::clamp(t + dt, Scalar{0}, Scalar{1});
  }
  // The parameters s and t of almost parallel lines are uncertain, but each point of one has a
  // well-defined nearest point on the other.
  offer(points(s, q.nearest(p.at(s))));
  offer(points(p.nearest(q.at(t)), t));
  return best;
}

}  // namespace touchstone
