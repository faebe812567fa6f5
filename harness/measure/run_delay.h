// The time in which the threads of this process were ready to run and had no processor.
#pragma once

#include <optional>

namespace touchstone::measure {

// Returns seconds, summed over the existing threads (proc(5), /proc/PID/schedstat); nothing if the
// system does not report it. Unlike the number of switches it measures the time lost.
std::optional<double> run_delay();

// Returns when this process has been at rest for a tenth of a millisecond, or after five: a thread
// of an executor looks for more work for a while before it sleeps, and would do so in the time of
// the next contestant.
void come_to_rest();

}  // namespace touchstone::measure
