// The commands of the program. Each adds its options to the command line and says what to run.
#pragma once

#include <CLI/CLI.hpp>

namespace touchstone {

// The exit status of the program.
enum ExitStatus : int {
  exit_done = 0,
  exit_measured_wrong = 1,  // done, and something measured is wrong
  exit_bad_request = 2,     // the request or an input file is wrong (InputError)
  exit_undecided = 3,       // `compare` alone: too few samples, or too much noise, to tell
};

// Each puts its exit status into `status` when its subcommand was given.
void add_list(CLI::App& app, int& status);
void add_query(CLI::App& app, int& status);
void add_manifold(CLI::App& app, int& status);
void add_pairs(CLI::App& app, int& status);
void add_check(CLI::App& app, int& status);
void add_soak(CLI::App& app, int& status);
void add_stress(CLI::App& app, int& status);
void add_run(CLI::App& app, int& status);
void add_compare(CLI::App& app, int& status);
void add_tables(CLI::App& app, int& status);
void add_draw(CLI::App& app, int& status);
void add_record(CLI::App& app, int& status);
void add_trade(CLI::App& app, int& status);
void add_advise(CLI::App& app, int& status);
void add_represent(CLI::App& app, int& status);

}  // namespace touchstone
