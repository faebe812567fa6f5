// Starts the programs behind pipes that a command is given.
#include <fmt/format.h>

#include <cmath>

#include "harness/base/table.h"
#include "harness/commands/shared_options.h"
#include "harness/peer/adapters.h"
#include "harness/peer/peer.h"

namespace touchstone::commands {

std::string start_peers(const std::vector<std::string>& peers, std::int64_t repeat) {
  std::string names;
  for (const std::string& named : peers) {
    for (const std::string& one : peer::named_versions(named)) {
      names = joined_names(names, peer::add(one, repeat));
    }
  }
  return names;
}

std::string repeats_text() {
  base::Table table({"peer", "repeats", "answers", "median", "least", "greatest"});
  std::int64_t repeated = 0;
  const auto time = [](double seconds) {
    return std::isnan(seconds) ? "-" : fmt::format("{:.3g} us", 1e6 * seconds);
  };
  for (const peer::PeerRow& row : peer::peer_rows()) {
    if (row.repeat == 0) continue;
    repeated += row.repeat;
    table.add({row.peer, fmt::format("{}", row.repeat), fmt::format("{}", row.repeated),
               time(row.median_seconds), time(row.least_seconds), time(row.greatest_seconds)});
  }
  if (repeated == 0) return "";
  return "\nTimes of one repeat, as each peer measured them inside: the same question again and "
         "again, and what the adapter adds.\nThey belong in no table with times that are measured "
         "here.\n" +
         table.text(base::page_width());
}

}  // namespace touchstone::commands
