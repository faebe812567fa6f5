// The executable `touchstone_more`: all other commands, and what `touchstone` hands over.
#include "harness/commands/commands.h"
#include "harness/commands/program.h"

#define TOUCHSTONE_OF_touchstone(name)
#define TOUCHSTONE_OF_touchstone_more(name) {#name, commands::add_##name},
#define TOUCHSTONE_OF_launcher(name)

int main(int argc, char** argv) {
  using namespace touchstone;
  return commands::run_program(
      argc, argv, commands::this_build,
      {
#define TOUCHSTONE_COMMAND(program, name, ...) TOUCHSTONE_OF_##program(name)
#include "harness/commands/commands.inl"
          {"run", commands::add_run_of_any}, {"show", commands::add_show_of_any}});
}
