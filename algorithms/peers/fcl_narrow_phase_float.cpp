// FCL's narrow phases in float. Debian compiled FCL's templates for double alone, so this file compiles
// them. fcl_narrow_phase.cpp describes the algorithms.
// Paper:   that of fcl_narrow_phase.cpp.
// Departs: as there. The first program leaves this file out, since it takes long to compile.
// Fails:   as there.
// Cost:    as there.
#include "algorithms/peers/fcl_solvers.h"

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_fcl_narrow_phase_float() {
  return fcl_solvers::entries<float>();
}

}  // namespace touchstone::entries
