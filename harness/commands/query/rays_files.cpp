// The file of rays, and the lines at the end.
#include "harness/commands/query/rays_files.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "harness/base/file_text.h"
#include "harness/commands/query/query_rows.h"
#include "harness/files/csv.h"

namespace touchstone::commands {

std::vector<Ray> read_rays(const std::string& file) {
  std::vector<Ray> rays;
  const files::CsvReader reader(file, {"origin_x", "origin_y", "origin_z", "direction_x",
                                       "direction_y", "direction_z", "t_max"});
  reader.read([&](const files::CsvReader::Row& row) {
    const auto finite = [&](std::size_t column) {
      const double value = row.number(column);
      if (!std::isfinite(value)) {
        row.fail(fmt::format("column {}: found {}; expected a finite number", row.name(column),
                             base::shortened(row.text(column))));
      }
      return value;
    };
    Ray ray{{finite(0), finite(1), finite(2)}, {finite(3), finite(4), finite(5)}, row.number(6)};
    if (ray.direction.isZero(0)) row.fail("the direction is zero; expected one that is not");
    if (!(ray.t_max >= 0)) {
      row.fail(fmt::format("column t_max: found {}; expected 0 or more, or inf",
                           base::shortened(row.text(6))));
    }
    rays.push_back(std::move(ray));
  });
  return rays;
}

std::string name_of_ray(std::size_t ray) { return fmt::format("ray {}", ray); }

void print_summaries(const std::vector<RaysSummary>& summaries) {
  fmt::print("{:<24} {:>9} {:>9}  {}\n", "algorithm", "hits", "misses", "status");
  for (const RaysSummary& summary : summaries) {
    fmt::print("{:<24} {:>9} {:>9}  {}\n", summary.name, summary.hits, summary.misses,
               status_counts(summary.statuses));
  }
}

}  // namespace touchstone::commands
