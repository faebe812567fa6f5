// FCL's narrow phases in float: templates that Debian compiled for double alone, compiled here. They are
// the entries of fcl_narrow_phase.cpp in another scalar.
// Paper:   that of fcl_narrow_phase.cpp.
// Departs: as there; the whole program alone has it, since it takes as long to compile as ten files.
// Fails:   as there, and within the rounding of floats.
// Cost:    as there.
#include "algorithms/peers/fcl_solvers.h"

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_fcl_narrow_phase_float() {
  return fcl_solvers::entries<float>();
}

}  // namespace touchstone::entries
