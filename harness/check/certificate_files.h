// Files of the oracle's certificates: made for the cases of a check, and verified.
#pragma once

#include <cstdint>
#include <filesystem>

#include "harness/check/family_checker.h"
#include "harness/kinds/proofs.h"

namespace touchstone::check {

// Proves the exact answers of the first round's cases whose checkers prove them, as given, and writes one certificate
// per line. The file is whole, or its old content stays. Returns their number. Throws InputError if it cannot be
// written.
std::int64_t save_certificates(const CheckRequest& request, const std::filesystem::path& file);

// Verifies every certificate of a file, and adds it to the verdicts. Throws InputError if the file cannot be read, or is
// malformed from some line on; those before are added by then.
void verify_certificates(const std::filesystem::path& file, kinds::Verdicts& verdicts);

}  // namespace touchstone::check
