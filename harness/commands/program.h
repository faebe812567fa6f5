// The program is two executables, so that a comparison does not wait for the compilation of all
// other commands: `touchstone` has the commands that measure and compare, `touchstone_more` has the
// others. The first knows the names of all, and hands over to the second.
#pragma once

#include <initializer_list>
#include <string_view>

#include "harness/commands/arguments.h"

namespace touchstone::commands {

// A command that an executable has, and what adds its options.
struct OwnCommand {
  std::string_view name;
  void (*add)(Arguments command);
};

// The body of main(). Words that name a command of the other executable are handed over.
int run_program(int argc, char** argv, std::initializer_list<OwnCommand> own);

// Replaces this process by `touchstone_more` with the same words, or throws InputError.
[[noreturn]] void hand_over();

}  // namespace touchstone::commands
