// The executable `touchstone`: the commands that measure and compare.
#include "harness/commands/commands.h"
#include "harness/commands/program.h"

int main(int argc, char** argv) {
  using namespace touchstone;
  return commands::run_program(argc, argv,
                               {{"run", commands::add_run},
                                {"compare", commands::add_compare},
                                {"tables", commands::add_tables},
                                {"list", commands::add_list},
                                {"query", commands::add_query},
                                {"pairs", commands::add_pairs}});
}
