// Tables of several machines, each for itself, and the range of their ratios.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "harness/stats/run_report.h"

namespace touchstone::stats {

// Writes the tables of each machine into FOLDER/machines/NAME (see write_tables), and across.csv and
// across.md into the folder. Returns a text for the terminal. Throws InputError if a file cannot be
// written.
std::string write_machine_tables(const std::map<std::string, Results>& of_machines,
                                 const ReportSetting& setting, double band,
                                 const std::filesystem::path& folder);

}  // namespace touchstone::stats
