// The counts of a soak as text.
#pragma once

#include <cstddef>
#include <string>

#include "harness/check/soak/soak.h"

namespace touchstone::check {

// Returns a table for the terminal, a row for each algorithm and scalar, over all regimes.
std::string soak_text(const SoakRequest& request, const SoakResult& result, std::size_t page_width);

}  // namespace touchstone::check
