// Does the work of a file with a table [check], [stress] or [soak].
#pragma once

#include <string>

#include "harness/check/requests/case_files.h"

namespace touchstone::check {

struct CaseEnd {
  std::string text;         // for the terminal; empty for a part, and after an interrupt
  bool ours_wrong = false;  // false for a part
  bool interrupted = false;
};

// Runs the file's request as run_check, run_stress and run_soak do; its folder is `common().out`.
CaseEnd run_case_file(CaseFile& file);

}  // namespace touchstone::check
