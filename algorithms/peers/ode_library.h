// ODE's library, which is set up once a process and has globals: the broad phases' calls take
// turns, and so do the making and the end of all geoms. And how it has a pose.
#pragma once

#include <ode/ode.h>

#include <mutex>

#include "algorithms/core/pose.h"

namespace touchstone::ode {

struct Library {
  std::mutex mutex;

  Library() { dInitODE2(0); }
};

// Of ODE in this thread, for as long as the lock is kept.
inline std::unique_lock<std::mutex> enter() {
  static Library library;
  std::unique_lock lock(library.mutex);
  dAllocateODEDataForThread(dAllocateMaskAll);
  return lock;
}

// A pose as ODE has it, rows of four.
struct Placement {
  dVector3 position;
  dMatrix3 rotation;

  explicit Placement(const Pose& pose) {
    for (int row = 0; row < 3; ++row) {
      position[row] = static_cast<dReal>(pose.translation[row]);
      for (int column = 0; column < 3; ++column) {
        rotation[4 * row + column] = static_cast<dReal>(pose.rotation(row, column));
      }
      rotation[4 * row + 3] = 0;
    }
    position[3] = 0;
  }
};

}  // namespace touchstone::ode
