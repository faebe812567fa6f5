// Joins what the checkers say, as text and as a page.
#include "harness/check/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "harness/record/machine.h"

namespace touchstone::check {
namespace {

constexpr std::size_t shown_lines = 30;  // faults of ours at the terminal
constexpr std::size_t page_lines = 40;   // and on a page

std::string listed(const std::vector<std::string>& lines, std::string_view mark, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(lines.size(), most); ++i) {
    text += fmt::format("{}{}\n", mark, lines[i]);
  }
  if (lines.size() > most) text += fmt::format("{}and {} more\n", mark, lines.size() - most);
  return text;
}

bool asks(const CheckReport& report, Origin origin) {
  return std::ranges::any_of(report.request->contestants, [&](const kinds::Contestant& one) {
    return one.info->origin == origin;
  });
}

// Those that are held to their word.
std::string answerable(const CheckReport& report) {
  if (!asks(report, Origin::module)) return "our own algorithms";
  return asks(report, Origin::ours) ? "our own algorithms and the modules'"
                                    : "the modules' algorithms";
}

// Whether ours are wrong along axes.
std::string promise(const CheckReport& report) {
  if (std::ranges::none_of(report.request->contestants, &kinds::Contestant::promised)) return "";
  const std::vector<std::string> broken = report.ours_wrong();
  if (broken.empty()) {
    return fmt::format("In double, none of {} is silently wrong, crashes or hangs.\n",
                       answerable(report));
  }
  return fmt::format("In double, of {}:\n\n", answerable(report)) +
         listed(broken, "- ", page_lines);
}

std::string end_of_cases(const CheckReport& report) {
  const std::vector<std::string> wrong = report.ours_wrong();
  if (wrong.empty()) {
    return fmt::format("None of {} is wrong beyond its margin.\n", answerable(report));
  }
  const std::string whose = asks(report, Origin::module) ? "Of " + answerable(report) : "Ours";
  std::string text =
      fmt::format("\n{}, wrong beyond the documented margin: {}\n", whose, wrong.size()) +
      listed(wrong, "  ", shown_lines);
  std::vector<std::string> commands;
  for (const auto& checker : report.checkers) {
    for (std::string& command : checker->commands()) commands.push_back(std::move(command));
  }
  if (!commands.empty()) text += "Shown by\n" + listed(commands, "  ", commands.size());
  return text;
}

std::string end_of_counts(const CheckReport& report) {
  std::string text;
  const auto all = static_cast<std::int64_t>(report.request->period());
  if (report.jobs < all && !report.interrupted) {
    text += fmt::format(
        "\nOnly {} of {} regimes and families were asked, each {} cases; --count {} asks all.\n",
        report.jobs, all, kinds::cases_of_a_count_job, all * kinds::cases_of_a_count_job);
  }
  const std::vector<std::string> wrong = report.ours_wrong();
  return text + listed(wrong, "Wrong: ", wrong.size());
}

}  // namespace

CheckReport::CheckReport(const CheckRequest& of) : request(&of) {
  for (const kinds::Kind* kind : kinds::checked_kinds()) {
    std::unique_ptr<kinds::Checker> own = kind->checker(of);
    if (own == nullptr) continue;
    checkers.push_back(std::move(own));
    kinds_.push_back(kind);
  }
  checkers.push_back(std::make_unique<FamilyChecker>(of));
}

std::size_t CheckReport::checker_of(const kinds::Family& family) const {
  return static_cast<std::size_t>(std::ranges::find(kinds_, family.kind) - kinds_.begin());
}

std::string CheckReport::do_job(std::size_t job) const {
  const auto family = static_cast<std::uint32_t>(job % request->period());
  return checkers[checker_of(*request->families[family])]->do_job(family, job / request->period());
}

std::string CheckReport::certificates(std::size_t family) const {
  return checkers[checker_of(*request->families[family])]->certificates(
      static_cast<std::uint32_t>(family));
}

std::vector<std::string> CheckReport::ours_wrong() const {
  std::vector<std::string> lines;
  for (const auto& checker : checkers) {
    for (std::string& line : checker->ours_wrong()) lines.push_back(std::move(line));
  }
  return lines;
}

std::string summary_text(const CheckReport& report, std::size_t page_width) {
  std::string text;
  for (const auto& checker : report.checkers) text += checker->text(page_width);
  switch (report.request->mode) {
    case CheckMode::cases: break;
    case CheckMode::axes: return text + "\n" + promise(report);
    case CheckMode::count: return text + end_of_counts(report);
  }
  return text + end_of_cases(report);
}

std::string page_text(const CheckReport& report, const std::string& command,
                      const std::string& pictures) {
  const CheckRequest& request = *report.request;
  std::string text;
  if (request.mode == CheckMode::axes) {
    text = fmt::format(
        "# Where each algorithm breaks\n\nMade by `{}` (seed {}, {} cases of each value, fewer of "
        "large hulls; {} s of the processor a query). Along each axis one property of a case grows "
        "to its extreme while all else stays mild; every answer is held against exact "
        "arithmetic.\n\n{}\n{}\n",
        command, request.seed, request.cases, request.time_limit,
        record::facts_as_list({"compiler", "bullet", "fcl", "libccd", "ode", "commit"}),
        promise(report));
  } else {
    text = fmt::format(
        "# Who is wrong where\n\nMade by `{}` (seed {}, {} cases of each of {} regimes and "
        "families "
        "in a round). Every answer is graded against exact arithmetic. Lengths are parts of the "
        "pair's size, or of its distance where that is greater; each number is the greatest that "
        "was seen.\n\n{}",
        command, request.seed, request.cases, request.period(),
        record::facts_as_list({"compiler", "bullet", "fcl", "libccd", "ode", "mujoco", "embree",
                               "cgal", "boost_geometry", "commit"}));
  }
  for (const auto& checker : report.checkers) text += checker->page(pictures);
  for (const auto& checker : report.checkers) text += checker->page_end();
  return text;
}

}  // namespace touchstone::check
