// Saves and verifies certificates.
#include "harness/commands/query/proofs.h"

#include <fmt/format.h>

#include <limits>

#include "harness/base/error.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"

namespace touchstone::commands {
namespace {

constexpr int most_told = 1000;

}  // namespace

SavedCertificates::SavedCertificates(const std::string& file) : output_(file) {}

void SavedCertificates::head(const std::string& line) { output_.write(line + "\n"); }

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

int Verdicts::end() const {
  fmt::print("{} certificates verified, {} refused\n", verified_, refused_);
  return refused_ == 0 ? exit_done : exit_measured_wrong;
}

void expect_without_certificates(const std::string& value, const char* name) {
  if (!value.empty()) return;
  throw base::InputError(fmt::format("{} is missing; expected it, or --certificates alone", name));
}

}  // namespace touchstone::commands
