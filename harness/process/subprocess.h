// Starts another program and waits for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::process {

// Runs a program, found as a shell finds it, with these arguments; its output goes to `log`.
// Returns its exit status, or 128 plus the number of the signal that ended it. Throws InputError if
// the program cannot be started.
int run_and_wait(const std::string& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& log);

}  // namespace touchstone::process
