// What the exact answers cost.
#pragma once

namespace touchstone {

// oracle/{verdict,distance,depth}/SHAPE/SIGNED_DISTANCE: one query an iteration, over 256 pairs.
void register_oracle_benchmarks();

}  // namespace touchstone
