// The benchmarks of `touchstone bench`. A benchmark makes its inputs when it first runs, so that a
// filter makes for a quick start.
#pragma once

#include <filesystem>
#include <string>

namespace touchstone::bench {

// narrow/ALGORITHM/SCALAR/SHAPES/TASK/REGIME: one query per iteration, over 256 pairs
// (placed_pairs.h). `wrong` counts the pairs with a wrong answer.
void register_narrow_benchmarks();

// broad/ALGORITHM/SCENE/BODIES/CALL: one call per iteration, with one thread. CALL is `build` and
// `find-pairs` on a scene's boxes, with another draw each time, and `update` and
// `find-pairs-updated` on its frames. `pairs` is the number of pairs found.
void register_broad_benchmarks();

// oracle/{verdict,distance,depth}/SHAPES/REGIME: the exact answers, one query per iteration.
void register_oracle_benchmarks();

// meshes/{mid,concave,ray,point}/ALGORITHM/MESH/build: one construction for a mesh per iteration; with `mid`
// also `refit`, to boxes of moved vertices. `per_triangle` is its time, `bytes` the memory of a triangle that the
// C library gave; what a library takes from elsewhere is not in it.
void register_mesh_benchmarks();

// executors/KIND/CALL: one loop per iteration on two pinned threads. CALL is `fork-join` of two empty
// tasks; `shared/Nus` of N tasks of a microsecond, shared by the threads in any case; `loop/Nus` of the
// same, by the caller alone where the executor finds that faster.
void register_executor_benchmarks();

// kernels/...: support functions, sorting and tests of boxes.
void register_kernel_benchmarks();

// The cost of the harness inside the timed region.

// harness/overhead/{broad,narrow}/THREADS: the seconds that a sample reports for algorithms that do
// nothing, per frame or query, timed by the harness's own samplers on a scene of 1,000 bodies. They
// are all the time between two readings of the clock beside an algorithm's own work: the readings,
// the calls, and the executor if narrow phases have threads. Counters give the nanoseconds
// (`overhead`), those of our fastest algorithm in the same place (`fastest`), and the overhead's
// share of that in per cent (`share`).
void register_harness_overhead_benchmarks();

// Counts the instructions of a query with Valgrind's Callgrind. A noisy machine does not change the
// result.

// Runs this program again under Valgrind and writes a row for each narrow-phase benchmark
// (benchmarks.h) whose name matches the expression (as std::regex_search does):
// `benchmark,queries,instructions`, the mean over the pairs of its batch, after one pass that is
// not counted. Valgrind supports at most AVX2. Throws InputError if Valgrind is missing now or was
// missing when this program was built, and for a filter that is malformed or matches nothing.
void count_instructions(const std::string& filter, const std::filesystem::path& out);

// The task of the second run: counts, one dump of Callgrind's per benchmark.
void count_under_valgrind(const std::string& filter);

}  // namespace touchstone::bench
