// What `show` makes of the rows of a results folder.
#pragma once

#include <string>

#include "harness/commands/arguments.h"
#include "harness/grade/margins.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::commands {

struct ShowOptions {
  std::string results, out;
  double band = 1.5, depth_error = grade::usual_depth_error;
  bool tables = false, figures = false, noisy = false;
};

// Writes the tables of these rows if they are asked for, and prints the summary of a campaign otherwise. Returns false if
// there are no rows of a campaign, of one machine. Throws InputError.
using ShowRows = bool (*)(const ShowOptions& options);

// Adds `show` to a program that has what rows need.
void add_show(Arguments command, ShowRows show_rows);

}  // namespace touchstone::commands
