// The executable `touchstone_more`: all other commands. `touchstone` runs it.
#include "harness/commands/commands.h"
#include "harness/commands/program.h"

int main(int argc, char** argv) {
  using namespace touchstone;
  return run_program(argc, argv,
                     {{"check", add_check},
                      {"soak", add_soak},
                      {"stress", add_stress},
                      {"manifold", add_manifold},
                      {"draw", add_draw},
                      {"record", add_record},
                      {"trade", add_trade},
                      {"advise", add_advise},
                      {"represent", add_represent},
                      {"run", add_run_trade}});
}
