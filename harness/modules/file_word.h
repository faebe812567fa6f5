// The words that name the file of a module, where names of algorithms stand too.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace touchstone::modules {

// True for a word with a slash or the ending .so. No algorithm is called so.
inline bool is_file(std::string_view word) {
  return word.find('/') != std::string_view::npos || word.ends_with(".so");
}

// What AlgorithmInfo::file has for it.
inline std::string file_of(std::string_view word) {
  std::error_code error;
  return std::filesystem::weakly_canonical(word, error).string();
}

}  // namespace touchstone::modules
