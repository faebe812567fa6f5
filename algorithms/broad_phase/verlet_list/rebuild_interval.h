// How many frames a list of candidate pairs is to last.
//
// A list over boxes grown for f frames costs a search every f frames and its tests every frame, and
// grows like the cube of what the boxes grow by. All by counts, so that the choice does not depend
// on the machine's mood.
#pragma once

#include <cstddef>

namespace touchstone {

struct Motion {
  float step = 0;    // metres a frame on an axis, in the mean
  double share = 0;  // of it in the box's side and itself, in the mean
};

class RebuildInterval {
 public:
  // Frames for the next list; 0 where none is worth while. `pairs` were found in the last frame.
  double choose(const Motion& motion, std::size_t bodies, std::size_t pairs);
  // What a list that was made has; when it ended, and the pairs found then.
  void made(const Motion& motion, double frames, std::size_t bodies, std::size_t candidates);
  void ended(int age, std::size_t bodies, std::size_t pairs);

 private:
  double growth_ = 2;  // of a box's side a frame, in shares of the motion
  double lasted_ = 1;  // frames that a list lasted, a frame that it was made for
  double share_ = 0;   // of the last list
  double frames_ = 0;
  double candidates_ = 0;  // a body
};

}  // namespace touchstone
