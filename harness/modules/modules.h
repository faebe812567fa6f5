// Modules: shared objects of somebody's own, whose algorithms are entries of the registry beside all others.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace touchstone::modules {

// Loads the file, and adds each algorithm that it offers to the registry. A file that was loaded before stays as it is.
// The caller must have no threads. Throws base::InputError where it is no module, or where something in it is wrong.
void load(const std::filesystem::path& file);

// Loads the modules among these words, which are joined by commas (is_file of file_word.h says which they are).
void load_named(std::string_view words);

// The files that were loaded: absolute paths.
std::vector<std::filesystem::path> files();

// The names of those files, with a hash of their bytes: what results depend on.
std::vector<std::pair<std::string, std::string>> facts();

}  // namespace touchstone::modules
