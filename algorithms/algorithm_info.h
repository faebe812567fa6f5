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
