// Other programs, started and waited for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::process {

// Runs a program, found as a shell finds it, with these arguments; what it prints goes into `log`.
// Its exit status, or 128 and the number of the signal that ended it. InputError where it cannot be
// started.
int run_and_wait(const std::string& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& log);

}  // namespace touchstone::process
