// Names of folders and files that are made of names of the user's.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace touchstone::base {

inline constexpr std::size_t longest_name = 100;  // bytes

// True for one component of a path that leads to no other folder: neither empty, "." nor "..", and
// without '/' and NUL.
bool is_component(std::string_view name);

// Returns why a text cannot name a folder of results; empty if it can. Such a name is one component
// of a path, of 1 to 100 bytes, without control characters, and neither "." nor "..".
std::string name_fault(std::string_view name);

// Returns a file's name of at most `longest_name` bytes for a text: letters, digits and a few signs
// stay, and each other byte becomes '_'. Different texts may get the same name.
std::string safe_file_name(std::string_view text);

}  // namespace touchstone::base
