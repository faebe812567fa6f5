// How a query ended. Part of every answer, of broad phases, narrow phases and contact manifolds.
#pragma once

#include <cstdint>
#include <string_view>

namespace touchstone {

enum class Status : std::uint8_t {
  ok,             // the algorithm stands by its answer: wrong with `ok` is a silent error
  not_converged,  // the iteration cap or the end of the scalar's precision came first
  degenerate,     // the input is beyond what the algorithm can decide
  capacity,       // a fixed store was full
  unsupported,    // this kind of pair, or this task, is not one of the algorithm's
  not_reported,   // the library has no way to say whether it failed
  crashed,        // set by the harness: the query killed its process
  timed_out,      // set by the harness: the query was stopped
};

std::string_view to_string(Status status);

}  // namespace touchstone
