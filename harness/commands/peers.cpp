// Starts the programs behind pipes that a command is given.
#include "harness/commands/shared_options.h"
#include "harness/peer/adapters.h"
#include "harness/peer/peer.h"

namespace touchstone::commands {

std::string start_peers(const std::vector<std::string>& peers) {
  std::string names;
  for (const std::string& named : peers) {
    for (const std::string& one : peer::named_versions(named)) {
      names = joined_names(names, peer::add(one));
    }
  }
  return names;
}

}  // namespace touchstone::commands
