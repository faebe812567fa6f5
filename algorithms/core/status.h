// The status of a query: part of every answer of broad phases, narrow phases and contact manifolds.
#pragma once

#include <cstdint>
#include <string_view>

namespace touchstone {

enum class Status : std::uint8_t {
  ok,             // the algorithm stands by its answer: a wrong answer with `ok` is a silent error
  not_converged,  // the iteration cap or the end of the scalar's precision came first
  degenerate,     // the input is beyond what the algorithm can decide
  capacity,       // a fixed store was full
  unsupported,    // the algorithm does not support this kind of pair, or this task
  not_reported,   // the library cannot report whether it failed
  crashed,        // set by the harness: the query killed its process
  timed_out,      // set by the harness: the query was stopped
  garbage,        // set by the harness: what a program answered cannot be read
};

std::string_view to_string(Status status);

}  // namespace touchstone
