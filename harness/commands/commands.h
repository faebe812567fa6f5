// The commands of the program. Each adds its options and its job.
#pragma once

namespace touchstone::commands {

class Arguments;

// The exit status of the program.
enum ExitStatus : int {
  exit_done = 0,
  exit_measured_wrong = 1,  // the job is done, and a measured answer is wrong
  exit_bad_request = 2,     // the request or an input file is wrong (InputError)
  exit_undecided = 3,       // `compare` alone: the samples are too few or too noisy
};

// add_NAME for each command of either executable, and add_NAME_WORD for those within one.
#define TOUCHSTONE_COMMAND(program, name, ...) TOUCHSTONE_DECLARE_##program(name)
#define TOUCHSTONE_DECLARE_touchstone(name) void add_##name(Arguments command);
#define TOUCHSTONE_DECLARE_touchstone_more(name) void add_##name(Arguments command);
#define TOUCHSTONE_DECLARE_launcher(name)
#define TOUCHSTONE_NESTED(command, name, ...) void add_##command##_##name(Arguments arguments);
#include "harness/commands/commands.inl"
#undef TOUCHSTONE_DECLARE_touchstone
#undef TOUCHSTONE_DECLARE_touchstone_more
#undef TOUCHSTONE_DECLARE_launcher

// `run` and `show` of the executable `touchstone_more`: for any file, and any results.
void add_run_of_any(Arguments command);
void add_show_of_any(Arguments command);

}  // namespace touchstone::commands
