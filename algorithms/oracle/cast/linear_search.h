// Part of the oracle: the time at which polytopes, and balls around them, first touch that do not turn.
// Conservative advancement in integers, between the difference of the cores and the point that moves past
// it. exact_cast explains the steps; prove_cast makes a proof of what is found.
#pragma once

#include <optional>
#include <vector>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/oracle/cast/moving_cores.h"
#include "algorithms/oracle/cast/nearest.h"

namespace touchstone::oracle {

// A point of both balls at a time, `steps` / `parts` steps from the start: the mean of the differences of `feature`,
// with these weights, is as near to the point that moves as the radii are long together, or nearer.
struct LinearContact {
  Integer steps = 0, parts = 1;
  std::vector<DifferencePoint> feature;
  std::vector<Integer> weights;
};

// The difference of the cores at a time, seen from the point that moves past it. All lengths are `scale`
// times those of the cores, and there are as many steps in a step of their time.
class LinearSearch {
 public:
  LinearSearch(const MovingCores& cores, int& iterations, const Integer& scale = 1)
      : cores_(cores), scale_(scale), radius_(scale * cores.radius()), iterations_(iterations) {}

  const Integer& time() const { return time_; }
  const RationalPoint& nearest() const { return nearest_; }
  // Which of the cores' points `nearest` is the mean of.
  std::vector<DifferencePoint> feature() const;
  // For a time at which the bodies are in contact.
  LinearContact contact() const { return {time_, scale_, feature(), nearest_.weights}; }

  void go_to(const Integer& time);
  bool in_contact() const;
  // True if the plane with the normal z parts the bodies `steps` of time later too, with |z| > R.
  bool is_free(const Integer& steps) const;
  // A number of steps of time that the plane parts the bodies, one or two short of all; they close
  // along it.
  Integer steps() const;
  // True if there was no contact in the last step of time either. The distance is a convex function of
  // time: where it falls at the end of the step, or a plane parts the bodies at both ends, it is.
  bool was_free() const;

  // Where the cores come nearest on the whole line of the path. Without a contact there, `plane` parts the bodies at all
  // times. For a scale of 1, and bodies that move.
  struct Passing {
    std::optional<LinearContact> contact;
    IntegerVector plane;
  };
  Passing passing() const;

 private:
  void find_nearest();
  void add(const IntegerVector& n);

  const MovingCores& cores_;
  Integer scale_, radius_;
  int& iterations_;
  Integer time_ = 0;
  std::vector<IntegerVector> simplex_;
  std::vector<MovingCores::Point> known_;  // each that was ever in the simplex, at time 0
  RationalPoint nearest_;
};

// What a search found. Times are in steps of 2^-MovingCores::time_bits.
struct LinearImpact {
  CastAnswer answer = CastAnswer::unknown;
  Integer lower = 0;                   // of a hit
  LinearContact contact;               // of a hit; its time is the upper end
  std::optional<IntegerVector> plane;  // against the normal from a to b, of the last plane
  // The planes that part the bodies, each until a time from the end of the one before it.
  struct Parted {
    IntegerVector plane;
    Integer until;
  };
  std::vector<Parted> parted;
};

// Runs the search.
LinearImpact find_impact(LinearSearch& search, int most_times = 4000);

}  // namespace touchstone::oracle
