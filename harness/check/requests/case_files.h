// Requests to check from a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "harness/check/axes/stress_request.h"
#include "harness/check/check_request.h"
#include "harness/check/soak/soak.h"

namespace touchstone::check {

// The work of a file with a table [check]: a check, with the key `axes` a sweep, and with `count` a
// soak. The last two may also have tables of their own, [stress] and [soak].
struct CaseFile {
  std::string name;  // its key `name`, else the file's
  std::variant<CheckRequest, StressRequest, SoakRequest> request;

  std::string_view kind() const;  // "check", "stress" or "soak", by the work
  CheckRequest& common();         // what all three have
};

// Returns whether the file has one of these tables.
bool has_case_work(const std::filesystem::path& file);
// The keys are documented in datasets/README.md. The folder of the results is left empty. Throws
// InputError with file, line and what was expected.
CaseFile read_case_file(const std::filesystem::path& file);

}  // namespace touchstone::check
