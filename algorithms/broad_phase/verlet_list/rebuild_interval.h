// Part of verlet-list: the rebuild interval, which is the number of frames that a list of candidate
// pairs is made for.
//
// A list over boxes grown for f frames costs a search every f frames and its tests in every frame,
// and its length grows with the cube of the boxes' growth. All costs are counts, whose weights depend
// on the number of bodies and on the level of vectors, so that no measured time decides.
#pragma once

#include <cstddef>

#include "algorithms/broad_phase/verlet_list/box_motion.h"

namespace touchstone {

// The choice of the interval, and the estimates that it rests on, which each list corrects.
class RebuildInterval {
 public:
  // Returns the number of frames for the next list; 0 if no list pays. `pairs` is the number found
  // in the last frame.
  double choose(const MeanMotion& motion, std::size_t bodies, std::size_t pairs);
  // Records a list that was made, and the age at which it ended with the pairs found then.
  void made(const MeanMotion& motion, double frames, std::size_t bodies, std::size_t candidates);
  void ended(int age, std::size_t bodies, std::size_t pairs);

 private:
  double growth_ = 1.5;  // growth of a box's side a frame, in units of the share
  double lasted_ = 1;  // mean ratio of the age at which a list ended and the frames it was made for
  double share_ = 0;   // share of the last list
  double frames_ = 0;  // frames that it was made for
  double candidates_ = 0;  // its pairs, for each body
};

}  // namespace touchstone
