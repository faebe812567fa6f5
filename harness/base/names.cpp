// Looks at the bytes of names.
#include "harness/base/names.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/input_file.h"

namespace touchstone::base {

bool is_component(std::string_view name) {
  return !name.empty() && name != "." && name != ".." &&
         name.find_first_of(std::string_view("/\0", 2)) == std::string_view::npos;
}

std::string name_fault(std::string_view name) {
  if (is_component(name) && name.size() <= longest_name && !has_control(name)) return "";
  return fmt::format(
      "found '{}'{}; expected a name for a folder: 1 to {} bytes without '/' or control "
      "characters, and neither '.' nor '..'",
      shortened(name),
      name.size() > longest_name ? fmt::format(", {} bytes", name.size()) : std::string(),
      longest_name);
}

std::string safe_file_name(std::string_view text) {
  const auto is_safe = [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return letter || std::string_view("-_.,+=").find(c) != std::string_view::npos;
  };
  std::string name(text.substr(0, longest_name));
  for (char& c : name) {
    if (!is_safe(c)) c = '_';
  }
  if (name.empty() || name[0] == '.' || name[0] == '-') name.insert(0, "_");
  name.resize(std::min(name.size(), longest_name));
  return name;
}

}  // namespace touchstone::base
