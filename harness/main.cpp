// The executable `touchstone`: the standard comparison, and what shows results.
#include "harness/commands/commands.h"
#include "harness/commands/program.h"

#define TOUCHSTONE_OF_touchstone(name) {#name, commands::add_##name},
#define TOUCHSTONE_OF_touchstone_more(name)
#define TOUCHSTONE_OF_launcher(name)

int main(int argc, char** argv) {
  using namespace touchstone;
  return commands::run_program(argc, argv, commands::this_build,
                               {
#define TOUCHSTONE_COMMAND(program, name, ...) TOUCHSTONE_OF_##program(name)
#include "harness/commands/commands.inl"
                               });
}
