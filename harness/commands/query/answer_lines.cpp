// Prints answers.
#include "harness/commands/query/answer_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace touchstone::commands {
namespace {

using kinds::Questions;
using kinds::ShownAnswer;

// "-0.2185 +- 1e-14 m (proven)": a number with its bounds; "-0.43 m (at least -0.43)" where it has one of them.
std::string number_text(const ShownAnswer& shown, std::string_view unit, bool is_oracle) {
  if (std::isnan(shown.number)) {
    const bool has_bounds = std::isfinite(shown.lower) && std::isfinite(shown.upper);
    return has_bounds ? fmt::format("from {} to {} {}", shown.lower, shown.upper, unit) : "";
  }
  std::string text = fmt::format("{}", shown.number);
  const bool has_both = std::isfinite(shown.lower) && std::isfinite(shown.upper);
  if (has_both) {
    text +=
        fmt::format(" +- {:.2g}", std::max(shown.number - shown.lower, shown.upper - shown.number));
  }
  if (!unit.empty()) text += fmt::format(" {}", unit);
  if (has_both) {
    text += is_oracle ? " (proven)" : " (certified)";
  } else if (std::isfinite(shown.lower)) {
    text += fmt::format(" (at least {:.6g})", shown.lower);
  } else if (std::isfinite(shown.upper)) {
    text += fmt::format(" (at most {:.6g})", shown.upper);
  }
  return text;
}

std::string line_text(const Questions& questions, std::size_t question, std::size_t contestant,
                      const std::optional<ShownAnswer>& exact) {
  const ShownAnswer shown = questions.shown(question, contestant);
  const bool is_oracle = questions.info(contestant).origin == Origin::oracle;
  std::vector<std::string> parts;
  const auto add = [&](std::string part) {
    if (!part.empty()) parts.push_back(std::move(part));
  };
  add(std::string(shown.verdict));
  add(number_text(shown, questions.unit(), is_oracle));
  add(shown.more);
  if (exact && !is_oracle) {
    if (shown.verdict != exact->verdict) {
      add(fmt::format("[exact: {}]", exact->verdict));
    } else if (!std::isnan(shown.number) && !std::isnan(exact->number)) {
      const double off = std::abs(shown.number - exact->number);
      add(off == 0 ? "(exact)" : fmt::format("(off by {:.2g})", off));
    }
  }
  const bool is_meant = shown.status == Status::ok || shown.status == Status::not_reported;
  if (!is_meant) add(fmt::format("[{}]", to_string(shown.status)));
  return fmt::format("{}", fmt::join(parts, "  "));
}

// Such as "ok 5, not_reported 2 (the library has no status)".
std::string status_counts(const std::map<Status, std::size_t>& statuses) {
  std::string text;
  for (const auto& [status, count] : statuses) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(status), count);
    if (status == Status::not_reported) text += " (the library has no status)";
  }
  return text;
}

}  // namespace

void print_lost(std::string_view algorithm, std::span<const kinds::AskFailure> failures) {
  constexpr std::size_t most = 5;
  for (const kinds::AskFailure& failure : failures.first(std::min(most, failures.size()))) {
    fmt::print(stderr, "{}, {}: {}\n", algorithm, failure.label, failure.reason);
  }
  if (failures.size() > most) {
    fmt::print(stderr, "{}: {} more failures\n", algorithm, failures.size() - most);
  }
}

void print_lines(const Questions& questions) {
  for (std::size_t i = 0; i < questions.size(); ++i) {
    fmt::print("{}\n", questions.label(i));
    std::optional<ShownAnswer> exact;
    std::vector<std::string> without;
    for (std::size_t c = 0; c < questions.contestants(); ++c) {
      const bool is_oracle = questions.info(c).origin == Origin::oracle;
      if (is_oracle && !exact) exact = questions.shown(i, c);
    }
    if (exact && exact->status != Status::ok) exact.reset();
    for (std::size_t c = 0; c < questions.contestants(); ++c) {
      if (questions.shown(i, c).status == Status::unsupported) {
        without.push_back(questions.name(c));
        continue;
      }
      fmt::print("  {:<28} {}\n", questions.name(c), line_text(questions, i, c, exact));
    }
    if (!without.empty()) fmt::print("  not taken by {}\n", fmt::join(without, ", "));
  }
}

void print_counts(const Questions& questions) {
  const std::vector<std::string_view> verdicts = questions.verdicts();
  std::string line = fmt::format("{:<28}", "algorithm");
  for (const std::string_view verdict : verdicts) line += fmt::format(" {:>11}", verdict);
  fmt::print("{}  status\n", line);
  for (std::size_t c = 0; c < questions.contestants(); ++c) {
    std::vector<std::size_t> counts(verdicts.size());
    std::map<Status, std::size_t> statuses;
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const ShownAnswer shown = questions.shown(i, c);
      ++statuses[shown.status];
      const auto at = std::ranges::find(verdicts, shown.verdict);
      if (at != verdicts.end()) ++counts[static_cast<std::size_t>(at - verdicts.begin())];
    }
    line = fmt::format("{:<28}", questions.name(c));
    for (const std::size_t count : counts) line += fmt::format(" {:>11}", count);
    fmt::print("{}  {}\n", line, status_counts(statuses));
  }
}

void print_scalar_hint(const Questions& questions, Precision asked) {
  const std::vector<std::string> names = questions.of_other_scalar();
  if (names.empty()) return;
  const bool is_double = asked == Precision::float64;
  fmt::print("Without an answer, as they calculate in {} alone: {}; --scalar {} asks them\n",
             is_double ? "float" : "double", fmt::join(names, ", "),
             is_double ? "float" : "double");
}

}  // namespace touchstone::commands
