// Gathers the faults of each algorithm from the tables of answers and from the departures.
#include "harness/stats/how_right.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "harness/stats/summary_words.h"

namespace touchstone::stats {
namespace {

// What is wrong with one algorithm.
struct Fault {
  std::string label;
  bool ours = false, by_design = false;
  bool slow = false;  // took more than the campaign's limit for a frame
  std::int64_t wrong = 0, queries = 0, unanswered = 0;
  double metres = nan;  // the worst answer on the wrong side
  double error = nan;   // the worst number beyond the stated error
  bool is_bound = false;
  std::vector<std::string> scenes;
  std::string what;      // the first departure, shortened
  std::size_t more = 0;  // the number of further departures

  // Returns what is wrong with the answers; empty if nothing is.
  std::string wrong_text() const {
    std::vector<std::string> words;
    if (wrong > 0) {
      words.push_back(fmt::format("{} of {}", count_text(wrong), count_text(queries)));
      std::vector<std::string> more_words;
      if (!std::isnan(metres)) more_words.push_back("by " + metres_text(metres));
      more_words.push_back(list_text(scenes, 2));
      words.back() += fmt::format(" ({})", fmt::join(more_words, "; "));
    }
    if (!std::isnan(error)) {
      words.push_back(
          fmt::format("{} {:.2g} of the size", is_bound ? "too deep by" : "off by", error));
    }
    if (words.empty() && !what.empty())
      words.push_back(what + (more > 0 ? fmt::format(", and {} more", more) : ""));
    if (words.empty()) return "";
    return fmt::format("{} {}", short_label(label), fmt::join(words, ", "));
  }
};

std::vector<Fault> faults_of(const Tables& tables, std::span<const record::Departure> departures) {
  std::vector<Fault> faults;
  const auto fault_of = [&](const std::string& label, bool ours) -> Fault& {
    const auto at = std::ranges::find(faults, label, &Fault::label);
    if (at != faults.end()) return *at;
    Fault& fault = faults.emplace_back();
    fault.label = label;
    fault.ours = ours;
    return fault;
  };
  for (const AgreementRow& row : tables.agreement) {
    Fault& fault = fault_of(row.label, record::is_answerable(row.origin));
    fault.queries += row.queries;
    fault.wrong += row.wrong;
    fault.unanswered += row.failed + row.unanswered;
    fault.metres = std::fmax(fault.metres, row.worst_disagreement);
    const std::string scene = row.key.scene.substr(
        0, std::min(row.key.scene.find(" gap "), row.key.scene.find(" depth ")));
    if (row.wrong > 0 && std::ranges::find(fault.scenes, scene) == fault.scenes.end())
      fault.scenes.push_back(scene);
    if (!(row.worst_error > tables.depth_error)) continue;
    fault.error = std::fmax(fault.error, row.worst_error);
    fault.is_bound = row.depth_is_bound;
  }
  for (const record::Departure& departure : departures) {
    Fault& fault = fault_of(departure.algorithm, departure.ours);
    fault.by_design =
        fault.by_design || departure.what.find("approximate by design") != std::string::npos;
    if (departure.what.find("limit of") != std::string::npos ||
        departure.what.find("not answered within") != std::string::npos) {
      fault.slow = true;
    } else if (fault.what.empty()) {
      fault.what = departure.what.substr(0, departure.what.find(';')) + " on " +
                   departure.where.substr(0, departure.where.find(','));
    } else {
      ++fault.more;
    }
  }
  std::ranges::stable_sort(faults, std::greater<>(), &Fault::wrong);
  return faults;
}

}  // namespace

std::string how_right(const Results& results, const Tables& tables,
                      std::span<const record::Departure> departures, bool stopped) {
  std::int64_t queries = 0, frames = 0;
  bool libraries = false;
  std::set<std::string> modules;  // labels of their algorithms
  for (const SampleSet& set : results.sets) {
    for (const Contestant& contestant : set.contestants) {
      if (contestant.origin == record::RowOrigin::module) modules.insert(contestant.label);
      libraries = libraries || contestant.origin == record::RowOrigin::peer;
      if (!set.key.narrow()) frames += static_cast<std::int64_t>(contestant.checks.size());
    }
  }
  for (const AgreementRow& row : tables.agreement) queries += row.queries;
  if (queries == 0 && frames == 0 && departures.empty()) return "";

  std::vector<std::string> of_libraries, of_ours, of_modules, by_design, unanswered, slow;
  for (const Fault& fault : faults_of(tables, departures)) {
    const std::string text = fault.wrong_text();
    if (fault.slow) slow.push_back(short_label(fault.label));
    if (!text.empty()) {
      (fault.by_design || (fault.is_bound && fault.wrong == 0) ? by_design
       : modules.contains(fault.label)                         ? of_modules
       : fault.ours                                            ? of_ours
                                                               : of_libraries)
          .push_back(text);
    }
    if (fault.ours && fault.unanswered > 0) {
      unanswered.push_back(fmt::format("{} {} of {}", short_label(fault.label),
                                       count_text(fault.unanswered), count_text(fault.queries)));
    }
  }
  std::string text = fmt::format(
      "HOW RIGHT answers on the wrong side of contact, of those asked (the worst); numbers off by "
      "more than {:g} of the pair's size{}\n",
      tables.depth_error, stopped ? "; of what was checked before the stop" : "");
  const auto add = [&](std::string_view who, const std::vector<std::string>& words,
                       const std::string& more = "") {
    text +=
        fmt::format("  {:<12}{}{}\n", who, words.empty() ? "none" : lines_text(words, 14, 3), more);
  };
  if (libraries) add("libraries", of_libraries);
  add("ours", of_ours, unanswered.empty() ? "" : "; without an answer: " + list_text(unanswered));
  if (!modules.empty()) add("modules", of_modules);
  if (!by_design.empty()) add("by design", by_design);
  if (!slow.empty()) add("over time", slow);
  return text;
}

}  // namespace touchstone::stats
