// The time in which the threads of this process were ready to run and had no processor.
#pragma once

#include <optional>

namespace touchstone::measure {

// Seconds, summed over the threads that there are (proc(5), /proc/PID/schedstat); empty where the
// system does not tell. Unlike the number of switches it says how much was lost.
std::optional<double> run_delay();

// Returns when this process has been at rest for a tenth of a millisecond, or after five: a thread
// of an executor looks for more work for a while before it sleeps, and would do so in the time of
// whoever is measured next.
void come_to_rest();

}  // namespace touchstone::measure
