// Checks published claims against measured results.
#include "harness/stats/published_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/table.h"
#include "harness/files/text_file.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {
namespace {

bool is_about(const PublishedClaim& claim, const SampleSet& set) {
  const auto same = [](const std::string& wanted, const std::string& value) {
    return wanted.empty() || wanted == value;
  };
  return same(claim.scene, set.key.scene) && same(claim.pair_kind, set.key.pair_kind) &&
         set.find(claim.algorithm) != nullptr &&
         (claim.than.empty() || set.find(claim.than) != nullptr);
}

PublishedRow iterations_row(const PublishedClaim& claim, const SampleSet& set) {
  double sum = 0, squares = 0, count = 0;
  for (const Check& check : set.find(claim.algorithm)->checks) {
    const std::int64_t iterations = check.count(Work::iterations);
    if (iterations < 0 || check.pair_count <= 0) continue;
    sum += static_cast<double>(iterations);
    squares += static_cast<double>(check.count(Work::iterations_squared));
    count += static_cast<double>(check.pair_count);
  }
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(squares / count - mean * mean, 0.0));
  const double comparable = mean - static_cast<double>(claim.uncounted);
  PublishedRow row{set.key, "iterations of " + claim.algorithm,
                   fmt::format("{:g} ± {:g}", claim.mean, claim.deviation), "not counted",
                   Holds::undecided};
  if (!(count > 0)) return row;
  row.here = fmt::format("{:.1f} ± {:.1f}", comparable, deviation);
  if (claim.uncounted > 0)
    row.here += fmt::format(" ({:.1f} with the {} uncounted)", mean, claim.uncounted);
  row.state = std::abs(comparable - claim.mean) <= claim.deviation ? Holds::pass : Holds::fail;
  return row;
}

PublishedRow faster_row(const PublishedClaim& claim, const SampleSet& set, Noise noise) {
  const MedianInterval ratio =
      ratio_between(set, *set.find(claim.algorithm), *set.find(claim.than), noise);
  PublishedRow row{set.key, fmt::format("{} is faster than {}", claim.algorithm, claim.than), "yes",
                   "too few quiet squares", Holds::undecided};
  if (std::isnan(ratio.low)) return row;
  row.here = fmt::format("takes {:.3g} ({:.3g} to {:.3g}) times as long", ratio.median, ratio.low,
                         ratio.high);
  if (ratio.high < 1) row.state = Holds::pass;
  if (ratio.low > 1) row.state = Holds::fail;
  return row;
}

PublishedRow suffices_row(const PublishedClaim& claim, const SampleSet& set) {
  std::int64_t compared = 0, wrong = 0;
  for (const Check& check : set.find(claim.algorithm)->checks) {
    compared += std::max<std::int64_t>(check.compared, 0);
    wrong += std::max<std::int64_t>(check.disagreements, 0);
  }
  PublishedRow row{set.key, claim.algorithm + " suffices", "yes", "nothing was compared",
                   Holds::undecided};
  if (compared == 0) return row;
  row.here = fmt::format("{} of {} pairs wrong ({:.2g} %)", wrong, compared,
                         100.0 * static_cast<double>(wrong) / static_cast<double>(compared));
  row.state = wrong == 0 ? Holds::pass : Holds::fail;
  return row;
}

}  // namespace

std::vector<PublishedRow> check_published(const Published& published, const Results& results,
                                          Noise noise) {
  std::vector<PublishedRow> rows;
  for (const PublishedClaim& claim : published.claims) {
    const std::size_t before = rows.size();
    for (const SampleSet& set : results.sets) {
      if (!is_about(claim, set)) continue;
      switch (claim.kind) {
        case PublishedClaim::Kind::iterations: rows.push_back(iterations_row(claim, set)); break;
        case PublishedClaim::Kind::faster: rows.push_back(faster_row(claim, set, noise)); break;
        case PublishedClaim::Kind::suffices: rows.push_back(suffices_row(claim, set)); break;
      }
    }
    if (rows.size() > before) continue;
    SetKey nowhere;
    nowhere.scene = claim.scene;
    nowhere.pair_kind = claim.pair_kind;
    rows.push_back({nowhere, claim.algorithm, "", "was not run", Holds::undecided});
  }
  return rows;
}

std::string published_text(const Published& published, const std::vector<PublishedRow>& rows) {
  std::string text = fmt::format("Published: {}\n\n", published.source);
  if (!published.note.empty()) text += published.note + "\n\n";
  base::Table table({"", "input", "published", "here", ""}, 2);
  for (const PublishedRow& row : rows) {
    table.add(
        {row.claim, row.key.words(), row.published, row.here, std::string(to_string(row.state))});
  }
  return text + table.markdown();
}

void write_published(const Published& published, const std::vector<PublishedRow>& rows,
                     const std::filesystem::path& folder) {
  record::write_rows(folder / "published.csv", rows);
  files::write_text(folder / "published.md", published_text(published, rows));
}

}  // namespace touchstone::stats
