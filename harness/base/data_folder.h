// Where the project's own files are: scenes, campaigns, adapters, kept results, scripts.
// They are below ../share/touchstone, as seen from the folder of the program. A build has a symbolic link to the source
// tree there; an installation has the files. No path is compiled in, so an installation can be moved.
#pragma once

#include <filesystem>

namespace touchstone::base {

struct DataFolder {
  std::filesystem::path
      path;                   // absolute; what is in it has the path that it has in the source tree
  bool is_installed = false;  // false: it is the source tree
};

// That of a program with this path. It need not be there: who reads a file in it says what is missing.
DataFolder data_folder_of(const std::filesystem::path& program);
// That of this program.
const DataFolder& data_folder();

// The path itself if there is such a file or folder, or if it is absolute or empty; else that of the same name in the
// data folder, if it is there; else the path itself.
std::filesystem::path found(const std::filesystem::path& path,
                            const DataFolder& data = data_folder());

}  // namespace touchstone::base
