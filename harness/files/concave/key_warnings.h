// Keys of cases that are nearly known ones.
#pragma once

#include <set>
#include <string>

#include "harness/files/json_line.h"

namespace touchstone::files {

// Cases may have keys of their own, which are ignored. One that is nearly a key of cases is a slip, and what was
// meant would be ignored in silence.
class KeyWarnings {
 public:
  // Prints a warning for each such key of the case, its bodies, their shapes and parts, to standard error; for each key
  // once.
  void look(const JsonNode& line);

 private:
  void look_within(const JsonNode& node, int depth);

  std::set<std::string> seen_;
};

}  // namespace touchstone::files
