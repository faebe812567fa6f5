// Finds files of rows by their names.
#include "harness/files/row_file.h"

#include <system_error>

namespace touchstone::files {
namespace {

constexpr const char* packed_ending = ".zst";

}  // namespace

std::filesystem::path packed_name(std::filesystem::path csv) { return csv += packed_ending; }

bool is_packed(const std::filesystem::path& file) { return file.extension() == packed_ending; }

std::filesystem::path row_file(const std::filesystem::path& csv) {
  std::error_code ignored;
  const std::filesystem::path packed = packed_name(csv);
  return !std::filesystem::exists(csv, ignored) && std::filesystem::exists(packed, ignored) ? packed
                                                                                            : csv;
}

}  // namespace touchstone::files
