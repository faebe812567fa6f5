// Puts the summary of a run together: head, how fast, how right, and where more stands.
#include "harness/stats/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "harness/base/names.h"
#include "harness/files/text_file.h"
#include "harness/stats/how_fast.h"
#include "harness/stats/how_right.h"
#include "harness/stats/summary_words.h"
#include "harness/stats/table_check.h"
#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

struct Disturbed {
  std::int64_t samples = 0, noisy = 0;
};

Disturbed disturbed(const Results& results) {
  Disturbed found;
  for (const SampleSet& set : results.sets) {
    for (const Contestant& contestant : set.contestants) {
      found.samples += std::ssize(contestant.samples);
      found.noisy += std::ranges::count(contestant.samples, true, &Sample::noisy);
    }
  }
  return found;
}

std::string head_text(const Results& results, const Disturbed& disturbed, Noise noise) {
  std::vector<std::string> facts;
  const auto add = [&](const char* name, const char* behind) {
    const auto at = results.machine.find(name);
    if (at != results.machine.end()) facts.push_back(at->second + behind);
  };
  add("processor", "");
  add("cores_online", " cores");
  for (const std::string& isa : results.isa) facts.push_back(isa);
  const std::string samples =
      disturbed.samples == 0 ? "Nothing was timed."
      : disturbed.noisy == 0
          ? fmt::format("None of {} samples was disturbed.", count_text(disturbed.samples))
          : fmt::format(
                "{:.{}f} % of {} samples were disturbed and {}.",
                100 * static_cast<double>(disturbed.noisy) / static_cast<double>(disturbed.samples),
                100 * disturbed.noisy < 10 * disturbed.samples ? 1 : 0,
                count_text(disturbed.samples), noise == Noise::kept ? "counted" : "left out");
  return fmt::format("Touchstone, {}: {}. {}\n",
                     results.campaign.empty() ? "a run" : results.campaign, fmt::join(facts, ", "),
                     samples);
}

std::string files_text(const std::filesystem::path& folder) {
  const std::string word = base::shell_word(folder.string());
  std::error_code error;
  const std::filesystem::path tables = folder / "tables.md";
  std::string text = fmt::format("Again     touchstone show {}", word);
  if (std::filesystem::exists(tables, error)) text += "    Tables " + tables.string();
  text += fmt::format("\nPage      touchstone report {} --out page.html", word);
  const std::filesystem::path cases = folder / "reproductions";
  const auto count = std::filesystem::is_directory(cases, error)
                         ? std::ranges::distance(std::filesystem::directory_iterator(cases, error))
                         : 0;
  if (count > 0)
    text += fmt::format("    Wrong {} ({} case{})", cases.string(), count, count == 1 ? "" : "s");
  return text + "\n";
}

}  // namespace

std::string summary(const Results& results, const Tables& tables,
                    std::span<const record::Departure> departures,
                    const std::filesystem::path& folder, const ReportSetting& setting) {
  const Disturbed share = disturbed(results);
  std::string text = head_text(results, share, setting.noise);
  if (setting.stopped) {
    text += fmt::format("Stopped in {}. Go on: {}\n", setting.stopped->at, setting.stopped->go_on);
  }
  const FastText fast = how_fast(results, tables, setting);
  const bool too_noisy = setting.noise == Noise::left_out && 2 * share.noisy > share.samples;
  if (too_noisy) {
    text += fmt::format(
        "TOO NOISY TO COMPARE  other programs disturbed {:.0f} % of the samples. Answers were "
        "checked: see below.\nRun again when the machine is quiet, or count disturbed samples too: "
        "touchstone show {} --tables --noisy\n\n",
        100 * static_cast<double>(share.noisy) / static_cast<double>(share.samples),
        base::shell_word(folder.string()));
  } else {
    text += fast.text;
  }
  if (const std::string right = how_right(results, tables, departures, setting.stopped.has_value());
      !right.empty()) {
    text += right;
    if (!too_noisy) text += doubts_text(fast.doubts);
  }
  return text + files_text(folder);
}

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
  report.summary = summary(results, tables, departures, folder, setting);
  return report;
}

}  // namespace touchstone::stats
