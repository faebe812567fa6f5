// The commands of the program. Each adds itself and its options to the command line.
#pragma once

namespace touchstone {

class CommandLine;

// The exit status of the program.
enum ExitStatus : int {
  exit_done = 0,
  exit_measured_wrong = 1,  // done, and something measured is wrong
  exit_bad_request = 2,     // the request or an input file is wrong (InputError)
  exit_undecided = 3,       // `compare` alone: too few samples, or too much noise, to tell
};

void add_list(CommandLine& line);
void add_query(CommandLine& line);
void add_manifold(CommandLine& line);
void add_pairs(CommandLine& line);
void add_check(CommandLine& line);
void add_soak(CommandLine& line);
void add_stress(CommandLine& line);
void add_run(CommandLine& line);
void add_compare(CommandLine& line);
void add_tables(CommandLine& line);
void add_draw(CommandLine& line);
void add_record(CommandLine& line);
void add_trade(CommandLine& line);
void add_advise(CommandLine& line);
void add_represent(CommandLine& line);

}  // namespace touchstone
