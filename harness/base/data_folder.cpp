// Finds the project's own files from the path of the program.
#include "harness/base/data_folder.h"

#include <system_error>

namespace touchstone::base {

namespace fs = std::filesystem;

DataFolder data_folder_of(const fs::path& program) {
  const fs::path folder = program.parent_path().parent_path() / "share" / "touchstone";
  std::error_code error;
  if (!fs::exists(folder / "CMakeLists.txt", error)) return {.path = folder, .is_installed = true};
  const fs::path source = fs::read_symlink(folder, error);
  return {.path = error ? folder : source, .is_installed = false};
}

const DataFolder& data_folder() {
  static const DataFolder folder = data_folder_of(fs::read_symlink("/proc/self/exe"));
  return folder;
}

fs::path found(const fs::path& path, const DataFolder& data) {
  std::error_code error;
  if (path.empty() || path.is_absolute() || fs::exists(path, error)) return path;
  fs::path kept = data.path / path;
  return fs::exists(kept, error) ? kept : path;
}

}  // namespace touchstone::base
