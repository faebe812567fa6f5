// The benchmarks of `touchstone bench`. A benchmark makes its inputs when it first runs, so that a
// filter makes for a quick start.
#pragma once

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

}  // namespace touchstone::bench
