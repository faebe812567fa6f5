// What the harness itself costs inside the timed region.
#pragma once

namespace touchstone {

// harness/overhead/{broad,narrow}/THREADS: the seconds that a sample reports of algorithms that do
// nothing, a frame or a query, timed by the harness's own samplers on a scene of 1,000 bodies. So
// it is all that stands between the two readings of the clock beside an algorithm's own work: the
// readings, the calls, and the executor where narrow phases have threads. Counters tell the
// nanoseconds (`overhead`), those of our fastest algorithm in the same place (`fastest`), and the
// overhead's part of that in per cent (`share`).
void register_harness_overhead_benchmarks();

}  // namespace touchstone
