// Reads which machine measured which block.
#include "harness/stats/machines/blocks.h"

#include <system_error>
#include <utility>

namespace touchstone::stats {

std::map<std::int64_t, std::string> machines_of_blocks(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "blocks.csv";
  std::error_code error;
  std::map<std::int64_t, std::string> machines;
  if (!std::filesystem::exists(file, error)) return machines;
  for (BlockRow& row : record::read_rows<BlockRow>(file))
    machines[row.block] = std::move(row.machine);
  return machines;
}

}  // namespace touchstone::stats
