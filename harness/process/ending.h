// How work in a child process ended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "algorithms/core/status.h"

namespace touchstone::process {

enum class ItemState : std::uint8_t {
  not_run,    // never begun: the failures before it were too many
  running,    // begun, and not ended yet
  done,       // its work returned
  threw,      // its work, or the setup before it, threw
  crashed,    // it ended the child: a signal, an assertion, exit()
  timed_out,  // it was stopped
};

// "ok" of what is done, "threw", "crashed", "timed_out"; "not_run" of what did not end.
std::string_view to_string(ItemState state);

// The status of an answer whose item ended so: ok when it is done, timed_out when it was stopped,
// otherwise crashed.
Status status_of(ItemState state);

// Whether there is no answer because the query ended its process or was stopped.
inline bool is_lost(Status status) {
  return status == Status::crashed || status == Status::timed_out;
}

struct IsolationFailure {
  std::size_t item = 0;
  bool in_setup = false;  // `item` is then the one that the setup was for; it ends the whole work
  ItemState state = ItemState::crashed;
  int signal = 0;     // that ended the child, or 0
  int exit_code = 0;  // of a child that left by exit()
  std::string words;  // what was thrown, or the last that the child printed; may be empty

  // "killed by signal 11 (Segmentation fault)", "no answer in time", ...
  std::string reason() const;
};

}  // namespace touchstone::process
