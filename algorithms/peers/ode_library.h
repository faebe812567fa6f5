// Used by ODE's narrow phase, contacts and broad phases: the set-up of ODE's library, once a
// process, a lock for its globals, and the conversion of a pose. The calls of the broad phases run
// under the lock, and so do making and destroying geoms.
#pragma once

#include <ode/ode.h>

#include <mutex>

#include "algorithms/core/pose.h"

namespace touchstone::ode {

struct Library {
  std::mutex mutex;

  Library() { dInitODE2(0); }
};

// Locks ODE, and prepares it for this thread.
inline std::unique_lock<std::mutex> enter() {
  static Library library;
  std::unique_lock lock(library.mutex);
  dAllocateODEDataForThread(dAllocateMaskAll);
  return lock;
}

// A pose in ODE's layout: rows of four.
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
