// Where and with what a campaign ran.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace touchstone::record {

// Facts as name and value, "unknown" where the system does not tell: processor, cores, caches,
// governor, turbo, kernel, memory, limits, compiler and flags, vector instructions in use, versions
// of the libraries, commit and whether the tree was changed since, command line.
std::vector<std::pair<std::string, std::string>> machine_facts();
// The one that may differ when a run goes on after a stop.
inline constexpr std::string_view command_line_fact = "command_line";

// 16 hexadecimal digits over the bytes of this program.
std::string hash_of_program();

// machine.csv (name,value): what comes first, then the facts.
void write_facts(std::vector<std::pair<std::string, std::string>> first,
                 const std::filesystem::path& file);

}  // namespace touchstone::record
