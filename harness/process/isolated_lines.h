// Lines of text that a forked child makes, so that a crash or a hang costs only the line at hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/process/isolate.h"

namespace touchstone::process {

// Makes the line of an item, without the line break; nothing if the item has none.
using MakeLine = std::function<std::optional<std::string>(std::size_t item)>;

struct LinesReport {
  std::int64_t lines = 0;
  std::vector<IsolationFailure> failures;  // in the order of the items
};

// Runs the items as isolate() does, `setup` returns what makes their lines. Hands the lines, with their line breaks, to
// `take` in the items' order, once all are made; until then they are in a temporary file. An item that is lost has no line. Throws
// std::system_error if there is no temporary file.
LinesReport isolated_lines(std::size_t items, const IsolationLimits& limits,
                           const std::function<MakeLine()>& setup,
                           const std::function<void(const std::string& line)>& take);

}  // namespace touchstone::process
