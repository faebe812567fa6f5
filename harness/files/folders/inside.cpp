// Follows links to the place of a file.
#include "harness/files/folders/inside.h"

#include <algorithm>
#include <system_error>

namespace touchstone::files {

bool is_regular_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path place = std::filesystem::canonical(file, error);
  if (error) return false;
  const std::filesystem::path home = std::filesystem::canonical(folder, error);
  if (error || !std::filesystem::is_regular_file(place, error)) return false;
  return std::ranges::mismatch(home, place).in1 == home.end();
}

}  // namespace touchstone::files
