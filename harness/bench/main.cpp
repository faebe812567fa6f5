// Kernel benchmarks: every algorithm of the registry, the oracle and the kernels that algorithms
// share, under Google Benchmark, for profiling one at a time
// (--benchmark_filter=narrow/gjk/double/box-box). The harness proper times whole scenes, and keeps
// what crashes or hangs apart; see `touchstone run`.
#include <benchmark/benchmark.h>

#include "harness/bench/benchmarks.h"
#include "harness/bench/harness_overhead.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  touchstone::register_broad_benchmarks();
  touchstone::register_narrow_benchmarks();
  touchstone::register_oracle_benchmarks();
  touchstone::register_kernel_benchmarks();
  touchstone::register_harness_overhead_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
