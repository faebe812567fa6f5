// Kernel benchmarks under Google Benchmark: every algorithm of the registry, the oracle, the
// executors and the shared kernels, for profiling one at a time (--benchmark_filter=narrow/gjk/double/box-box).
// `touchstone run` times whole scenes and isolates crashes and hangs. With --instructions=FILE.csv
// the program counts the instructions of a query instead; --benchmark_filter then takes a regular
// expression. --with=./libmine.so adds the algorithms of a module.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

#include "harness/bench/benchmarks.h"
#include "harness/modules/modules.h"

namespace {

// The value of an option `name=value`, or an empty string if it is not given.
std::string value_of(int argc, char** argv, std::string_view name) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word.starts_with(name)) return std::string(word.substr(name.size()));
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string module_file = value_of(argc, argv, "--with=");
    if (!module_file.empty()) touchstone::modules::load(module_file);
    argc = static_cast<int>(std::remove_if(argv + 1, argv + argc,
                                           [](const char* word) {
                                             return std::string_view(word).starts_with("--with=");
                                           }) -
                            argv);
    if (const auto filter = value_of(argc, argv, "--under-valgrind="); !filter.empty()) {
      touchstone::bench::count_under_valgrind(filter);
      return 0;
    }
    if (const auto out = value_of(argc, argv, "--instructions="); !out.empty()) {
      if (!module_file.empty()) {
        throw std::invalid_argument("--with was given; expected it without --instructions");
      }
      const std::string filter = value_of(argc, argv, "--benchmark_filter=");
      touchstone::bench::count_instructions(filter.empty() ? "." : filter, out);
      return 0;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "touchstone bench: %s\n", error.what());
    return 2;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  touchstone::bench::register_broad_benchmarks();
  touchstone::bench::register_narrow_benchmarks();
  touchstone::bench::register_oracle_benchmarks();
  touchstone::bench::register_mesh_benchmarks();
  touchstone::bench::register_executor_benchmarks();
  touchstone::bench::register_kernel_benchmarks();
  touchstone::bench::register_harness_overhead_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
