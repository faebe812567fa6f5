// Part of smooth: a normal at which the height of the difference is stationary, and the points of
// the cores that prove it. Includes core and kernels.
//
// At a local minimum of the height some point of the difference with that normal lies on the line of
// the normal through the origin. Where ends tie, or along a disc, the core has many points with that
// normal, and the balance says which.
// Paper:   Newton on the sphere: Absil, Mahony, Sepulchre, "Optimization Algorithms on Matrix
//          Manifolds", 2008, ch. 6; active sets: Nocedal, Wright, "Numerical Optimization", 2006,
//          sec. 16.5.
#pragma once

#include <optional>

#include "algorithms/narrow_phase/smooth/smooth_pair.h"

namespace touchstone {

// The points of one core with a normal: middle + first_share * first + second_share * second.
struct SmoothFace {
  enum class Kind : std::uint8_t { point, tie, disc } kind = Kind::point;
  SmoothPoint furthest;
  Vec3d middle = Vec3d::Zero();
  Vec3d first = Vec3d::Zero(),
        second = Vec3d::Zero();  // half the segment between the tied ends; two radii of the disc
  double first_share = 0, second_share = 0;
  double slack = 0;  // 1 minus the length of the shares
  Vec3d point() const { return middle + first_share * first + second_share * second; }
};

struct SmoothFoot {
  Vec3d normal = Vec3d::Zero();
  SmoothFace a, b;
  double height;  // of the difference along the normal: an upper bound on the cores' depth
  double held;    // the product of the normal with the balanced point, less what the kinks are off
  Vec3d nearest;  // that point of the difference
  double slide;   // its length across the normal
  int support_calls = 0;
};

// Sets all of a foot from its normal and returns its slide.
double make_foot(const SmoothPair& pair, const Vec3d& normal, SmoothFoot& foot);

// Descends from the normal `start` to a local minimum of the height. Returns none if Newton's method
// finds none within its steps. `at_kink`: the start itself may be one.
std::optional<SmoothFoot> find_foot(const SmoothPair& pair, const Vec3d& start, bool at_kink);

// Returns the lowest of the axes of discs, and of the normals where ties of both cores meet; none if
// its height is not below the given one.
std::optional<Vec3d> best_kink(const SmoothPair& pair, double below);

}  // namespace touchstone
