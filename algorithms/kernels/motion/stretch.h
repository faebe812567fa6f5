// By how much the matrix of a pose lengthens vectors. Used by every cast.
#pragma once

#include "algorithms/core/pose.h"

namespace touchstone {

// Of a matrix whose squares neither overflow nor underflow.
struct Stretch {
  double most;   // an upper bound on the factor; tight for rotations
  double least;  // a lower bound on it, if the matrix is nearly a rotation, otherwise 0
};

Stretch stretch_of(const Pose& pose);

}  // namespace touchstone
