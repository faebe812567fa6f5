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

// Does it, and returns the exit status; returns nothing if the file is a campaign of scenes. Throws InputError.
using RunFile = std::optional<int> (*)(const RunFileOptions& options);

// Adds `run` to a program that has what such files need.
void add_run(Arguments command, RunFile run_file);

}  // namespace touchstone::commands
