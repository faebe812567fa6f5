// Saves and verifies certificates.
#include "harness/commands/query/proofs.h"

#include <fmt/format.h>

#include <limits>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"

namespace touchstone::commands {
namespace {

constexpr int most_told = 1000;

}  // namespace

SavedCertificates::SavedCertificates(const std::string& file) : output_(file) {}

void SavedCertificates::head(const std::string& line) {
  if (line.size() >= base::longest_text) {
    throw base::InputError(
        output_.path().string(), 0,
        fmt::format("cannot hold what is asked, in a line of {} bytes; expected at most {}",
                    line.size(), base::longest_text));
  }
  output_.write(line + "\n");
}

void SavedCertificates::add_each(std::size_t items, double seconds,
                                 const std::function<process::MakeLine()>& setup,
                                 const std::function<std::string(std::size_t)>& name_of) {
  const process::IsolationLimits limits = {
      .item_seconds = seconds, .setup_seconds = std::numeric_limits<double>::infinity()};
  const process::LinesReport report = process::isolated_lines(
      items, limits, setup, [&](const std::string& line) { output_.write(line); });
  count_ += report.lines;
  if (!report.failures.empty() && report.failures.back().in_setup) {
    throw base::InputError(output_.path().string(), 0,
                           "no more can be proven: " + report.failures.back().reason());
  }
  print_failures("certificates", report.failures, name_of);
}

void SavedCertificates::close() {
  output_.close();
  fmt::print("{} certificates in {}\n", count_, output_.path().string());
}

void Verdicts::add(std::int64_t line, const std::string& name, const std::string& why) {
  ++(why.empty() ? verified_ : refused_);
  if (why.empty() || refused_ > most_told) return;
  fmt::print(stderr, "{}:{}: {}: {}\n", file_, line, name, why);
}

void Verdicts::print(const std::string& until) const {
  fmt::print("{} certificates verified, {} refused{}\n", verified_, refused_, until);
  if (without_order_ > 0) {
    fmt::print(
        "{} of them claim a hit without order: another part may be hit before it, in the "
        "bracket\n",
        without_order_);
  }
}

int Verdicts::of(const std::function<void()>& read) {
  try {
    read();
  } catch (const base::InputError&) {
    print(", before what cannot be read");
    throw;
  }
  print("");
  return refused_ == 0 ? exit_done : exit_measured_wrong;
}

std::string QuestionNumbers::fault(std::uint64_t number) {
  const bool is_next = !last_ || number > *last_;
  if (is_next) last_ = number;
  return is_next ? "" : "its number is not above that of the certificate before it";
}

std::string AskedCases::fault(const std::string& case_line) const {
  return lines_.empty() || lines_.contains(case_line) ? ""
                                                      : "CASES has no such case of that identifier";
}

void expect_without_certificates(const std::string& value, const char* name) {
  if (!value.empty()) return;
  throw base::InputError(fmt::format("{} is missing; expected it, or --certificates alone", name));
}

}  // namespace touchstone::commands
