// Names and writes files that reproduce departures.
#include "harness/campaign/check_pass/reproduction.h"

#include <fmt/format.h>

#include "harness/base/error.h"
#include "harness/record/own_files.h"

namespace touchstone::campaign {

void write_reproduction(const RunContext& context, std::string_view text, std::string_view ending,
                        const std::function<void(const std::filesystem::path&)>& write,
                        record::Departure& departure) {
  if (context.results.empty()) return;
  try {
    record::OwnFiles own(context.results);
    std::filesystem::path file = own.free_stem(
        std::filesystem::path("reproductions") / fmt::format("block-{}", context.number), text);
    file += ending;
    own.note({file});
    write(file);
    departure.reproduction = file.string();
  } catch (const base::InputError& error) {
    departure.what += fmt::format("; without a file that shows it: {}", error.what());
  }
}

}  // namespace touchstone::campaign
