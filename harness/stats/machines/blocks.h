// The blocks of results that were measured in shards.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "harness/record/row.h"

namespace touchstone::stats {

// A row of blocks.csv, which stands beside a raw.csv of several shards.
struct BlockRow {
  std::int64_t block = 0, shard = 0;
  std::string machine;
  std::int64_t rows = 0;
};

template <record::row_of<BlockRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("block", row.block, "Number of the block in the campaign.");
  visit("shard", row.shard, "The shard that it was in.");
  visit("machine", row.machine,
        "The machine that measured it; `machines/` has its facts, and its tables where there are "
        "several.");
  visit("rows", row.rows, "Number of its rows in raw.csv.");
}

// Returns the machine of each block, as blocks.csv of the folder says; empty if it has no such file.
std::map<std::int64_t, std::string> machines_of_blocks(const std::filesystem::path& folder);

}  // namespace touchstone::stats
