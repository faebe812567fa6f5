// What `run` is asked of other files than campaigns of scenes, and of the shards of a plan.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/arguments.h"

namespace touchstone::commands {

struct RunFileOptions {
  std::string file, out, plan;
  std::int64_t shard = -1;
  std::vector<int> threads = {};  // empty: one a processor
  bool with_page = false, resume = false;
  std::vector<std::string> others =
      {};  // further options that were given, which a campaign of scenes alone takes
};

// What the whole `run` has beyond the standard comparison.
struct WholeRun {
  // Does what a file asks for, and returns the exit status; returns nothing if the file is a campaign of scenes.
  // Throws InputError.
  std::optional<int> (*run_file)(const RunFileOptions& options);
  // As start_peers of shared_options.h.
  std::string (*start_peers)(const std::vector<std::string>& peers);
};

// Adds `run` to a program that has all this. `whole` outlives it.
void add_run(Arguments command, const WholeRun& whole);

}  // namespace touchstone::commands
