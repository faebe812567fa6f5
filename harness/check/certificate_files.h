// Files of the oracle's certificates: made for the cases of a check, and verified.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/check/check_request.h"

namespace touchstone::check {

// Proves the exact answers of the first round's cases, as given, and writes one certificate per
// line. The file is whole, or its old content stays. Returns their number. Throws InputError if it
// cannot be written.
std::int64_t save_certificates(const CheckRequest& request, const std::filesystem::path& file);

struct CertificateVerdicts {
  std::int64_t verified = 0;
  std::vector<std::string> refused;  // "FILE:LINE: id: why", at most a thousand
  std::int64_t refused_count = 0;
};

// Verifies every certificate of a file, and counts in `verdicts`. Throws InputError if the file cannot be read, or is
// malformed from some line on; those before are counted by then.
void verify_certificates(const std::filesystem::path& file, CertificateVerdicts& verdicts);

}  // namespace touchstone::check
