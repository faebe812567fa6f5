// Writes the files of the tables.
#include "harness/files/text_file.h"
#include "harness/stats/tables/table_rows.h"

namespace touchstone::stats {

void write_tables(const Tables& tables, double band, const std::filesystem::path& folder) {
  record::write_rows(folder / "times.csv", tables.times);
  record::write_rows(folder / "ratios.csv", tables.ratios, band);
  record::write_rows(folder / "library_ratios.csv", tables.library_ratios, band);
  record::write_rows(folder / "winners.csv", tables.winners);
  record::write_rows(folder / "exponents.csv", tables.exponents);
  record::write_rows(folder / "speed_ups.csv", tables.speed_ups);
  record::write_rows(folder / "executors.csv", tables.executors);
  record::write_rows(folder / "agreement.csv", tables.agreement);
  record::write_rows(folder / "work.csv", tables.work);
  record::write_rows(folder / "broad_best.csv", tables.broad_best);
  record::write_rows(folder / "narrow_best.csv", tables.narrow_best);
  files::write_text(folder / "tables.md", tables_markdown(tables));
}

}  // namespace touchstone::stats
