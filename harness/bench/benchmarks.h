// What `touchstone bench` measures. Inputs are made when a benchmark first runs, so that a filter
// makes for a quick start.
#pragma once

namespace touchstone {

// narrow/ALGORITHM/SCALAR/SHAPES/TASK/REGIME: one query an iteration, over 256 pairs
// (placed_pairs.h). `wrong` counts the pairs whose answer is not the right one.
void register_narrow_benchmarks();

// broad/ALGORITHM/SCENE/BODIES/CALL: one call an iteration, at one thread; CALL is `build` and
// `find-pairs` of a scene's boxes, each time another draw, and `update` and `find-pairs-updated` of
// its frames. `pairs` is how many there were.
void register_broad_benchmarks();

// oracle/{verdict,distance,depth}/SHAPES/REGIME: the exact answers, one query an iteration.
void register_oracle_benchmarks();

// kernels/...: support functions, sorting and tests of boxes.
void register_kernel_benchmarks();

}  // namespace touchstone
