// Collects findings and formats their departures.
#include "harness/record/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace touchstone::record {

void Findings::add(Departure departure) {
  departure.where = one_line(std::move(departure.where));
  departure.what = one_line(std::move(departure.what));
  if (departure.row < 0) departure.row = static_cast<std::int64_t>(rows_.size()) - 1;
  const bool told = std::ranges::any_of(departures_, [&](const Departure& d) {
    return d.block == departure.block && d.algorithm == departure.algorithm &&
           d.where == departure.where && d.what == departure.what;
  });
  if (!told) departures_.push_back(std::move(departure));
}

bool ours_are_wrong(std::span<const Departure> departures) {
  return std::ranges::any_of(departures, [](const Departure& d) { return d.ours && !d.known; });
}

std::string departures_text(const Findings& findings) {
  // There is one line for each algorithm and manner, with the first case as the example.
  std::map<std::pair<std::string, bool>, std::vector<const Departure*>> by_algorithm;
  for (const Departure& departure : findings.departures()) {
    by_algorithm[{departure.algorithm, departure.known}].push_back(&departure);
  }
  std::string text;
  for (const auto& [key, list] : by_algorithm) {
    const Departure& first = *list.front();
    const auto row = static_cast<std::size_t>(first.row);
    const bool is_of_module = first.row >= 0 && row < findings.rows().size() &&
                              findings.rows()[row].origin == RowOrigin::module;
    text += fmt::format("{}{}: {}\n    on {}\n", first.algorithm,
                        first.known    ? ""
                        : is_of_module ? " (MODULE)"
                        : first.ours   ? " (OURS)"
                                       : " (peer)",
                        first.what, first.where);
    if (list.size() > 1) text += fmt::format("    and {} more like it\n", list.size() - 1);
    if (!first.reproduction.empty()) text += fmt::format("    shown by {}\n", first.reproduction);
  }
  return text.empty() ? text : "Departures\n\n" + text;
}

}  // namespace touchstone::record
