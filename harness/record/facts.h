// Facts: names with their values, as machine.csv and progress.csv hold them (name,value).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/files/csv.h"

namespace touchstone::record {

using Facts = std::vector<std::pair<std::string, std::string>>;

// Facts of machine.csv that the folder itself adds.
inline constexpr const char* begun_fact = "begun";        // when the work was begun
inline constexpr const char* finished_fact = "finished";  // "yes" or "no"

// Returns the facts of a file. Throws InputError if it cannot be read.
Facts read_facts(const std::filesystem::path& file);
// Writes a file of facts, which is whole or absent. Throws InputError if it cannot be written.
void write_facts(const std::filesystem::path& file, const Facts& facts,
                 files::CsvWriter::Durable durable = files::CsvWriter::Durable::against_power_cuts);

// Returns the value of the fact; empty if there is none of this name.
std::string value_of(const Facts& facts, std::string_view name);

}  // namespace touchstone::record
