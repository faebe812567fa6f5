// What the registry knows of every algorithm, whatever its contract.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace touchstone {

enum class Origin : std::uint8_t { ours, peer, oracle };

std::string_view to_string(Origin origin);

struct AlgorithmInfo {
  std::string name;  // as on the command line: lower case, words joined by '-'
  std::string
      citation;  // authors, title, where and when; for a peer the library and what was called
  Origin origin = Origin::ours;
  // A departure from the contract that is known and accepted, in one line; the comparison reports
  // it as such. Empty: any departure is a fault.
  std::string known_defect = {};
  std::string reason = {};  // why it is not built; empty where it is. Filled in by the registry.
  // What of a built algorithm is not built, and why, in one line; empty where all of it is.
  std::string lacking = {};
};

}  // namespace touchstone

// An algorithm's file says what it offers in the body of one of the two functions that these macros
// open: TOUCHSTONE_BROAD_PHASE { return {{.info = {...}, .make = ...}}; }
// The build names the function after the file, and the generated registry calls it by that name.
#define TOUCHSTONE_BROAD_PHASE                                 \
  namespace touchstone::entries {                              \
  std::vector<touchstone::BroadPhaseEntry> TOUCHSTONE_ENTRY(); \
  }                                                            \
  std::vector<touchstone::BroadPhaseEntry> touchstone::entries::TOUCHSTONE_ENTRY()
#define TOUCHSTONE_NARROW_PHASE                                 \
  namespace touchstone::entries {                               \
  std::vector<touchstone::NarrowPhaseEntry> TOUCHSTONE_ENTRY(); \
  }                                                             \
  std::vector<touchstone::NarrowPhaseEntry> touchstone::entries::TOUCHSTONE_ENTRY()

// For peers: a factory where the library is there, null where it is not. TOUCHSTONE_BUILT is 0
// or 1.
#if defined(TOUCHSTONE_BUILT) && TOUCHSTONE_BUILT
#define TOUCHSTONE_IF_BUILT(factory) factory
#else
#define TOUCHSTONE_IF_BUILT(factory) nullptr
#endif
