// The main function of the program, which is two executables.
// The standard comparison does not wait for the compilation of all else: `touchstone` has what it measures,
// `touchstone_more` has everything. The first has the names of all commands, and hands over to the second.
// Installed there is one, `touchstone_more` under the name `touchstone`.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "harness/commands/arguments.h"
#include "harness/record/build.h"

namespace touchstone::commands {

// A command that an executable has, and the function that adds its options.
struct OwnCommand {
  std::string_view name;
  void (*add)(Arguments command);
};

// What the executables are built from, in a file that the build writes. It is linked into them alone.
extern const record::Build this_build;

// The body of main(). A command of the other executable is run by that.
int run_program(int argc, char** argv, const record::Build& build,
                std::initializer_list<OwnCommand> own);

// Returns the path of `touchstone_more`, which is beside this program unless it is this one, and the word that has to stand
// before all others when it is run: with it, a program of another build refuses to run.
std::string more_program();
std::string more_first_word();

// Replaces this process by `touchstone_more` with the same words, or throws InputError. Where the launcher started this
// program, the launcher takes its place, and builds the other first.
[[noreturn]] void hand_over();

}  // namespace touchstone::commands
