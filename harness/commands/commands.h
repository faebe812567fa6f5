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

// The commands of the executable `touchstone`.
void add_run(Arguments command);
void add_compare(Arguments command);
void add_tables(Arguments command);
void add_list(Arguments command);
void add_query(Arguments command);
void add_pairs(Arguments command);

// The commands of the executable `touchstone_more`.
void add_check(Arguments command);
void add_soak(Arguments command);
void add_stress(Arguments command);
void add_manifold(Arguments command);
void add_rays(Arguments command);
void add_points(Arguments command);
void add_ccd(Arguments command);
void add_cast(Arguments command);
void add_draw(Arguments command);
void add_record(Arguments command);
void add_trade(Arguments command);
void add_advise(Arguments command);
void add_represent(Arguments command);
void add_report(Arguments command);
void add_plan(Arguments command);
void add_merge(Arguments command);
void add_status(Arguments command);
void add_run_file(Arguments command);  // `run` for all but a campaign

}  // namespace touchstone::commands
