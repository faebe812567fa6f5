// The cost of the harness inside the timed region.
#pragma once

namespace touchstone::bench {

// harness/overhead/{broad,narrow}/THREADS: the seconds that a sample reports for algorithms that do
// nothing, per frame or query, timed by the harness's own samplers on a scene of 1,000 bodies. They
// are all the time between two readings of the clock beside an algorithm's own work: the readings,
// the calls, and the executor if narrow phases have threads. Counters give the nanoseconds
// (`overhead`), those of our fastest algorithm in the same place (`fastest`), and the overhead's
// share of that in per cent (`share`).
void register_harness_overhead_benchmarks();

}  // namespace touchstone::bench
