// The ending of work in a child process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "algorithms/core/status.h"

namespace touchstone::process {

enum class ItemState : std::uint8_t {
  not_run,    // never begun, since too many items failed before it
  running,    // begun, and not ended yet
  done,       // its work returned
  threw,      // its work, or the setup before it, threw
  crashed,    // its work ended the child: a signal, an assertion, exit()
  timed_out,  // it was stopped
};

// Returns "ok" for `done`, "threw", "crashed" or "timed_out"; "not_run" for work that did not end.
std::string_view to_string(ItemState state);

// The status of an answer whose item ended in this state: ok for `done`, timed_out for a stopped
// item, crashed for all else.
Status status_of(ItemState state);

// Returns whether an answer is missing because the query ended its process or was stopped.
inline bool is_lost(Status status) {
  return status == Status::crashed || status == Status::timed_out;
}

struct IsolationFailure {
  std::size_t item = 0;
  // The setup failed; `item` is the item that it preceded. This ends the whole work.
  bool in_setup = false;
  ItemState state = ItemState::crashed;
  int signal = 0;     // signal that ended the child, or 0
  int exit_code = 0;  // status of a child that left by exit()
  std::string words;  // text of the exception, or the last output of the child; may be empty

  // Returns words such as "killed by signal 11 (Segmentation fault)" or "no answer in time".
  std::string reason() const;
};

}  // namespace touchstone::process
