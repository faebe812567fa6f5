// ODE's library, which is set up once a process and has globals: the broad phases' calls take
// turns, and so do the making and the end of all geoms.
#pragma once

#include <ode/ode.h>

#include <mutex>

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

}  // namespace touchstone::ode
