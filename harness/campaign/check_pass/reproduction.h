// The file that reproduces a departure.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "harness/campaign/run_context.h"

namespace touchstone::campaign {

// Has `write` write reproductions/block-N/NAME.ENDING in the results folder of the run, where NAME is
// `text` made safe and unique, and sets the departure's reproduction. A file that cannot be written is
// a note in the departure. Does nothing without a results folder.
void write_reproduction(const RunContext& context, std::string_view text, std::string_view ending,
                        const std::function<void(const std::filesystem::path&)>& write,
                        record::Departure& departure);

}  // namespace touchstone::campaign
