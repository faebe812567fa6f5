// FCL's narrow phases in float: templates that Debian compiled for double alone, compiled here. They are
// the entries of fcl_narrow_phase.cpp in another scalar, and take as long to compile as ten files.
#include "algorithms/peers/fcl_solvers.h"

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_fcl_narrow_phase_float() {
  return fcl_solvers::entries<float>();
}

}  // namespace touchstone::entries
