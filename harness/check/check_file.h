// Requests to check from a file.
#pragma once

#include <filesystem>
#include <string>

#include "harness/check/family_checker.h"

namespace touchstone::check {

// The work of a file with a table [check]: with the key `axes` that of axes, and with `count` counts. These two
// may also have tables of their own, [stress] and [soak].
struct CheckFile {
  std::string name;  // its key `name`, else the file's
  CheckRequest request;
};

// Returns whether the file has one of these tables.
bool has_check(const std::filesystem::path& file);
// The keys are documented in datasets/README.md. The folder of the results is left empty. Throws
// InputError with file, line and what was expected.
CheckFile read_check_file(const std::filesystem::path& file);

struct CheckEnd {
  std::string text;         // for the terminal; empty for a part, and after an interrupt
  bool ours_wrong = false;  // false for a part
  bool interrupted = false;
};

// Does run_check, and says what came out.
CheckEnd run_and_tell(const CheckRequest& request);

}  // namespace touchstone::check
