// Writes the tables of a run.
#include "harness/stats/run_report.h"

#include "harness/files/text_file.h"
#include "harness/stats/published_check.h"
#include "harness/stats/summary.h"

namespace touchstone::stats {

RunReport write_report(const Results& results, std::span<const record::Departure> departures,
                       const Published* published, const ReportSetting& setting,
                       const std::filesystem::path& folder) {
  const Tables tables = make_tables(results, setting.noise, setting.depth_error);
  RunReport report;
  report.tables = tables_markdown(tables);
  files::write_text(folder / "tables.md", report.tables);
  if (published != nullptr && !published->source.empty()) {
    const auto rows = check_published(*published, results, setting.noise);
    write_published(*published, rows, folder);
    report.published = published_text(*published, rows);
  }
  report.summary = summary(results, tables, departures, folder);
  return report;
}

}  // namespace touchstone::stats
