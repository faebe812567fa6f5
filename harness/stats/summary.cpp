// Formats the summary at the end of a run.
#include "harness/stats/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/base/table.h"

namespace touchstone::stats {
namespace {

// The page width in characters: so great that no line of the table is split.
constexpr std::size_t unlimited_width = 1000;
constexpr std::size_t most_groups = 10;
constexpr std::size_t most_faults = 4;

constexpr std::string_view broad = "broad phases";

// The best of ours and the best library of a set; a label is empty if there is none.
struct Duel {
  std::string scene, kind;  // kind: "broad phases", or a task and its batch
  std::string ours, library;
  MedianInterval ratio;  // ratio of the library's time to that of ours
};

std::vector<Duel> duels_of(const Tables& tables) {
  std::vector<Duel> duels;
  for (const BroadBestRow& row : tables.broad_best) {
    duels.push_back(
        {row.key.scene, std::string(broad), row.ours.label, row.peer.label, row.peer.ratio});
  }
  for (const NarrowBestRow& row : tables.narrow_best) {
    const std::string batch = row.batch > 0 ? fmt::format(" by {}", row.batch) : "";
    duels.push_back({row.key.scene, row.key.task + batch, row.ours.label, row.right_peer.label,
                     row.right_peer.ratio});
  }
  return duels;
}

// Returns the most frequent name, with its share if there are others.
std::string most_often(const std::vector<std::string>& names) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& name : names) ++counts[name];
  if (counts.empty()) return "-";
  const auto most =
      std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; });
  return counts.size() == 1 ? most->first
                            : fmt::format("{} ({}/{})", most->first, most->second, names.size());
}

// Returns the geometric mean of the ratios; its interval takes their errors as independent.
MedianInterval mean_of(const std::vector<MedianInterval>& ratios) {
  double middle = 0, below = 0, above = 0;
  for (const MedianInterval& ratio : ratios) {
    middle += std::log(ratio.median);
    below += std::pow(std::log(ratio.median / ratio.low), 2);
    above += std::pow(std::log(ratio.high / ratio.median), 2);
  }
  const auto n = static_cast<double>(ratios.size());
  return {std::exp(middle / n), std::exp((middle - std::sqrt(below)) / n),
          std::exp((middle + std::sqrt(above)) / n), ratios.size()};
}

std::string ratio_text(const MedianInterval& ratio) {
  if (std::isnan(ratio.median)) return "-";
  return std::isnan(ratio.low)
             ? fmt::format("{:.2f}", ratio.median)
             : fmt::format("{:.2f} ({:.2f} to {:.2f})", ratio.median, ratio.low, ratio.high);
}

// Each scene is a group of its own. If there are too many groups, all scenes are one for the broad
// phases, and if there still are, for the tasks of narrow phases too.
std::string winners_text(const Tables& tables) {
  const std::vector<Duel> duels = duels_of(tables);
  std::vector<std::string> names;
  std::map<std::string, std::vector<const Duel*>> members;
  for (int joined = 0; joined < 3; ++joined) {
    names.clear();
    members.clear();
    for (const Duel& duel : duels) {
      const bool alone = joined == 0 || (joined == 1 && duel.kind != broad);
      const std::string name = (alone ? duel.scene : "all scenes") + ", " + duel.kind;
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
      members[name].push_back(&duel);
    }
    if (names.size() <= most_groups) break;
  }
  if (names.empty()) return "";
  base::Table table({"", "fastest of ours", "fastest library", "library / ours", "inputs"});
  for (const std::string& name : names) {
    std::vector<std::string> ours, libraries;
    std::vector<MedianInterval> ratios;
    for (const Duel* duel : members[name]) {
      ours.push_back(duel->ours);
      if (duel->library.empty()) continue;
      libraries.push_back(duel->library);
      if (!std::isnan(duel->ratio.median)) ratios.push_back(duel->ratio);
    }
    table.add({name, most_often(ours), most_often(libraries),
               ratios.empty() ? "-" : ratio_text(mean_of(ratios)),
               std::to_string(members[name].size())});
  }
  return table.text(unlimited_width);
}

// The faults of one algorithm.
struct Fault {
  std::string label;
  bool ours = false, known = true;
  std::string what;                   // the first departure
  std::size_t more = 0;               // the number of further departures
  double worst_error = std::nan("");  // error of a distance or depth beyond the stated error
  bool is_bound = false;              // of a depth that is an upper bound by design
  std::int64_t unknown = 0, queries = 0;
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
  for (const record::Departure& departure : departures) {
    Fault& fault = fault_of(departure.algorithm, departure.ours);
    if (fault.what.empty()) {
      fault.what = departure.what + ", on " + departure.where;
    } else {
      ++fault.more;
    }
    fault.known = fault.known && departure.known;
  }
  for (const TimeRow& row : tables.times) {
    const bool ours = row.origin == record::RowOrigin::ours;
    const bool off = row.worst_error > tables.depth_error;
    if (!off && (row.unknown == 0 || !ours)) continue;
    Fault& fault = fault_of(row.label, ours);
    if (off) fault.worst_error = std::fmax(fault.worst_error, row.worst_error);
    const bool is_depth = row.key.task == "penetration" || row.key.task == "signed";
    fault.is_bound = fault.is_bound || (row.depth_is_bound && is_depth);
    fault.unknown += row.unknown;
    fault.queries += row.queries;
  }
  std::ranges::stable_sort(faults, {}, [](const Fault& fault) {
    return std::tuple(!fault.ours, fault.known,
                      std::isnan(fault.worst_error) ? 0 : -fault.worst_error);
  });
  return faults;
}

std::string line_of(const Fault& fault) {
  std::vector<std::string> words;
  if (!fault.what.empty()) {
    words.push_back(fault.what + (fault.known ? " (known)" : "") +
                    (fault.more > 0 ? fmt::format(", and {} more", fault.more) : ""));
  }
  if (!std::isnan(fault.worst_error)) {
    words.push_back(
        fmt::format("{} off by up to {:.2g} of the size",
                    fault.is_bound ? "depth, an upper bound by design," : "distance or depth",
                    fault.worst_error));
  }
  if (fault.unknown > 0) {
    words.push_back(fmt::format("{} of {} answers unknown", fault.unknown, fault.queries));
  }
  return fmt::format("  {}{}: {}\n", fault.label, fault.ours ? " (OURS)" : "",
                     fmt::join(words, "; "));
}

std::string notes_text(const Results& results) {
  std::size_t rounds = 0, noisy = 0, suspect = 0;
  for (const SampleSet& set : results.sets) {
    suspect += set.suspect;
    for (const Contestant& contestant : set.contestants) {
      rounds += contestant.samples.size();
      noisy +=
          static_cast<std::size_t>(std::ranges::count(contestant.samples, true, &Sample::noisy));
    }
  }
  std::string text = fmt::format("{} of {} samples were disturbed", noisy, rounds);
  if (suspect > 0) {
    text += fmt::format("; in {} of {} sets the baseline could be told from itself", suspect,
                        results.sets.size());
  }
  return text + ".\n";
}

}  // namespace

std::string summary(const Results& results, const Tables& tables,
                    std::span<const record::Departure> departures,
                    const std::filesystem::path& folder) {
  std::string text;
  if (const std::string winners = winners_text(tables); !winners.empty()) {
    text +=
        fmt::format(
            "Fastest of those that answer right (depths within {:g} of the size); the ratio is the "
            "geometric mean over\nthe inputs, with its 95 % interval.\n\n",
            tables.depth_error) +
        winners + "\n";
  } else if (!results.sets.empty()) {
    text += "No input has enough undisturbed rounds for a winner (--noisy counts the others).\n";
  }
  const std::vector<Fault> faults = faults_of(tables, departures);
  if (faults.empty()) {
    text += "No algorithm was wrong.\n";
  } else {
    text += "Wrong, failed or unknown:\n";
    for (std::size_t i = 0; i < std::min(most_faults, faults.size()); ++i)
      text += line_of(faults[i]);
    if (faults.size() > most_faults) {
      text += fmt::format("  and {} more in departures.csv and tables.md\n",
                          faults.size() - most_faults);
    }
  }
  text += notes_text(results);
  return text + fmt::format("Tables: {} (on the screen: --tables)\nRows: {}\n",
                            (folder / "tables.md").string(), (folder / "raw.csv").string());
}

}  // namespace touchstone::stats
