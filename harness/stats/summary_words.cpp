// Formats the numbers and lists of summaries.
#include "harness/stats/summary_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace touchstone::stats {

std::string ratio_text(double ratio) {
  if (ratio >= 9.95) return fmt::format("{:.0f}", ratio);
  return ratio >= 0.0995 ? fmt::format("{:.2f}", ratio) : fmt::format("{:.2g}", ratio);
}

std::string ratio_text(const MedianInterval& ratio) {
  return fmt::format("{} ({} to {})", ratio_text(ratio.median), ratio_text(ratio.low),
                     ratio_text(ratio.high));
}

std::string count_text(std::int64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string metres_text(double metres) {
  constexpr std::array<std::pair<double, const char*>, 3> units = {
      {{1, "m"}, {1e-3, "mm"}, {1e-6, "um"}}};
  for (const auto& [unit, name] : units) {
    if (metres < 0.995 * unit) continue;
    return metres >= 9.95 * unit ? fmt::format("{:.0f} {}", metres / unit, name)
                                 : fmt::format("{:.2g} {}", metres / unit, name);
  }
  return fmt::format("{:.0e} m", metres);
}

std::string seconds_text(double seconds) {
  if (seconds >= 1e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  return seconds >= 1e-6 ? fmt::format("{:.3g} us", seconds * 1e6)
                         : fmt::format("{:.3g} ns", seconds * 1e9);
}

std::string short_label(std::string label) {
  const std::size_t at = label.find(" double");
  return at == std::string::npos ? label : label.erase(at, std::string_view(" double").size());
}

std::string list_text(const std::vector<std::string>& words, std::size_t most) {
  const auto shown = std::span(words).first(std::min(most, words.size()));
  std::string text = fmt::format("{}", fmt::join(shown, ", "));
  if (words.size() > shown.size()) text += fmt::format(", {} more", words.size() - shown.size());
  return text;
}

std::string lines_text(const std::vector<std::string>& words, std::size_t indent,
                       std::size_t most) {
  constexpr std::size_t width = 140;
  std::string text;
  std::size_t column = indent;
  const auto add = [&](const std::string& word) {
    if (!text.empty()) {
      text += ";";
      const bool fits = column + word.size() + 2 <= width;
      text += fits ? " " : "\n" + std::string(indent, ' ');
      column = fits ? column + 2 : indent;
    }
    text += word;
    column += word.size();
  };
  const std::size_t shown = std::min(most, words.size());
  for (const std::string& word : std::span(words).first(shown)) add(word);
  if (words.size() > shown) add(fmt::format("{} more", words.size() - shown));
  return text;
}

std::string most_often(const std::vector<std::string>& names) {
  std::map<std::string, std::ptrdiff_t> counts;
  for (const std::string& name : names) ++counts[name];
  std::vector<std::string> all;
  for (const auto& [name, count] : counts) all.push_back(name);
  std::ranges::stable_sort(all, std::greater<>(), [&](const auto& name) { return counts[name]; });
  all.resize(std::min<std::size_t>(all.size(), 2));
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace touchstone::stats
