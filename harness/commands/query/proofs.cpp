// Saves and verifies certificates.
#include "harness/commands/query/proofs.h"

#include <fmt/format.h>

#include "harness/base/error.h"
#include "harness/commands/commands.h"

namespace touchstone::commands {
namespace {

constexpr int most_told = 1000;

}  // namespace

SavedCertificates::SavedCertificates(const std::string& file)
    : file_(file), stream_(file, std::ios::binary) {}

void SavedCertificates::head(const std::string& line) { stream_ << line << '\n'; }

void SavedCertificates::add(const std::string& line) {
  stream_ << line << '\n';
  ++count_;
}

void SavedCertificates::close() {
  stream_.close();
  if (!stream_) throw base::InputError(file_, 0, "cannot be written");
  fmt::print("{} certificates in {}\n", count_, file_);
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
