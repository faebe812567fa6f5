// Writes the tables of several machines.
#include "harness/stats/machines/machine_tables.h"

#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "harness/base/error.h"
#include "harness/files/text_file.h"
#include "harness/stats/machines/across.h"

namespace touchstone::stats {

std::string write_machine_tables(const std::map<std::string, Results>& of_machines,
                                 const ReportSetting& setting, double band,
                                 const std::filesystem::path& folder) {
  std::string text;
  std::vector<Tables> all;
  for (const auto& [name, results] : of_machines) {
    const std::filesystem::path own = folder / "machines" / name;
    std::error_code error;
    std::filesystem::create_directories(own, error);
    if (error) throw base::InputError(own.string(), 0, "cannot be made: " + error.message());
    all.push_back(make_tables(results, setting.noise, setting.depth_error));
    write_tables(all.back(), band, own);
    text += fmt::format("{}: {} times, {} ratios in {}\n", name, all.back().times.size(),
                        all.back().ratios.size(), (own / "tables.md").string());
  }
  const std::vector<AcrossRow> rows = across_machines(all);
  record::write_rows(folder / "across.csv", rows);
  files::write_text(folder / "across.md", across_markdown(rows));
  text += fmt::format("{} ratios that several machines measured, as ranges, in {}\n", rows.size(),
                      (folder / "across.md").string());
  return text;
}

}  // namespace touchstone::stats
