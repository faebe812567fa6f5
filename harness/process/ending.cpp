// Puts the ending of a child into words.
#include "harness/process/ending.h"

#include <fmt/format.h>

#include <cstring>

namespace touchstone::process {

std::string_view to_string(ItemState state) {
  switch (state) {
    case ItemState::done: return "ok";
    case ItemState::threw: return "threw";
    case ItemState::crashed: return "crashed";
    case ItemState::timed_out: return "timed_out";
    case ItemState::not_run:
    case ItemState::running: break;
  }
  return "not_run";
}

Status status_of(ItemState state) {
  if (state == ItemState::done) return Status::ok;
  return state == ItemState::timed_out ? Status::timed_out : Status::crashed;
}

std::string IsolationFailure::reason() const {
  std::string text;
  switch (state) {
    case ItemState::timed_out: text = "no answer in time"; break;
    case ItemState::threw: text = "threw"; break;
    default:
      text = signal != 0 ? fmt::format("killed by signal {} ({})", signal, strsignal(signal))
                         : fmt::format("left by exit({})", exit_code);
  }
  if (in_setup) text += " while it was set up";
  return words.empty() ? text : text + ": " + words;
}

}  // namespace touchstone::process
