// The executable `touchstone`: the commands that measure and compare.
#include "harness/commands/commands.h"
#include "harness/commands/program.h"

int main(int argc, char** argv) {
  using namespace touchstone;
  return run_program(argc, argv,
                     {{"run", add_run},
                      {"compare", add_compare},
                      {"tables", add_tables},
                      {"list", add_list},
                      {"query", add_query},
                      {"pairs", add_pairs}});
}
