// Sums the counts of a soak over the regimes and families.
#include "harness/check/soak/soak_text.h"

#include <fmt/format.h>

#include <map>
#include <utility>
#include <vector>

#include "harness/base/table.h"
#include "harness/check/families/family_tables.h"

namespace touchstone::check {

std::string soak_text(const SoakRequest& request, const SoakResult& result,
                      std::size_t page_width) {
  std::map<std::pair<std::size_t, Precision>, SoakCount> totals;
  for (const auto& [key, count] : result.counts) {
    totals[{std::get<0>(key), std::get<1>(key)}].add(count);
  }
  base::Table table({"algorithm", "pairs", "separated", "touching", "overlapping", "unresolved",
                     "silent errors", "gave up", "failed"});
  for (const auto& [key, count] : totals) {
    std::vector<std::string> row = {
        fmt::format("{} {}", request.narrow[key.first]->info.name, to_string(key.second))};
    for (const std::int64_t value :
         {count.pairs, count.separated, count.touching, count.overlapping, count.unresolved,
          count.silent, count.honest, count.lost}) {
      row.push_back(std::to_string(value));
    }
    table.add(row);
  }
  std::string text = request.narrow.empty() ? "" : table.text(page_width);
  text += family_summary(request, result.families, page_width);
  const auto all = static_cast<std::int64_t>(request.period());
  const std::int64_t asked = result.drawn / cases_a_soak_job;
  if (asked < all && !result.interrupted) {
    text += fmt::format(
        "\nOnly {} of {} regimes and families were asked, each {} cases; --count {} asks "
        "all.\n",
        asked, all, cases_a_soak_job, all * cases_a_soak_job);
  }
  for (const std::string& line : broken_family_promises(request, result.failures)) {
    text += "Wrong: " + line + '\n';
  }
  return text;
}

}  // namespace touchstone::check
