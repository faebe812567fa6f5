// Facts: names with their values, and those of the machine and the program that a campaign ran
// with.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/files/csv.h"

namespace touchstone::record {

// Facts: names with their values, as machine.csv and progress.csv hold them (name,value).

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

// Returns facts as name and value, "unknown" if the system does not report it: processor, cores,
// caches, governor, turbo, kernel, memory, limits, compiler and flags, vector instructions in use,
// versions of the libraries, what was built (build.h), command line.
std::vector<std::pair<std::string, std::string>> machine_facts();
// The fact that may differ when a run is resumed.
inline constexpr std::string_view command_line_fact = "command_line";

// Returns the machine's facts of these names as a list in Markdown.
std::string facts_as_list(std::initializer_list<std::string_view> names);

// What the program puts in front of its words where it hands them to its second half: the id of its
// build.
inline constexpr std::string_view of_build_option = "--of-build=";

// Returns the words of a command, each ended by a NUL, as one line that a shell reads as the same
// words. The folder of the program and `of_build_option` are left out; line ends are blanks.
std::string shell_line(const std::string& words);

// Returns date and time in UTC: "2026-01-31 13:05:00 UTC".
std::string date_now();

// Returns 16 hexadecimal digits, a hash of the instructions of this program and of what it was built
// from. Another commit of the same sources has the same.
std::string hash_of_program();

}  // namespace touchstone::record
