// A finished folder of results that is made one that a kill has stopped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/files/text_file.h"
#include "harness/record/folder_files.h"

namespace touchstone {

// Makes the folder unfinished, after so many units, when its files of rows had these lengths.
inline void stop_folder(const std::filesystem::path& folder, std::int64_t units,
                        const std::vector<std::pair<std::string, std::size_t>>& files) {
  record::Facts facts = record::read_facts(folder / "machine.csv");
  for (auto& [name, value] : facts) {
    if (name == record::finished_fact) value = "no";
  }
  record::write_facts(folder / "machine.csv", facts);
  std::vector<record::RowsOfFile> rows;
  for (const auto& [name, size] : files) {
    rows.push_back({.name = name, .size = static_cast<std::int64_t>(size), .hash = {}});
    files::add_file(rows.back().hash, folder / name, 0, rows.back().size);
  }
  record::write_progress(folder, units, rows, facts);
}

}  // namespace touchstone
