// Counts verified and refused proofs.
#include "harness/kinds/proofs.h"

#include <fmt/format.h>

#include <cstdio>

#include "harness/base/error.h"

namespace touchstone::kinds {
namespace {

constexpr int most_told = 1000;

}  // namespace

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

bool Verdicts::of(const std::function<void()>& read) {
  try {
    read();
  } catch (const base::InputError&) {
    print(", before what cannot be read");
    throw;
  }
  print("");
  return refused_ == 0;
}

std::string QuestionNumbers::fault(std::uint64_t number) {
  const bool is_next = !last_ || number > *last_;
  if (is_next) last_ = number;
  return is_next ? "" : "its number is not above that of the certificate before it";
}

std::string AskedCases::fault(const std::string& case_line) const {
  return lines_.empty() || lines_.contains(case_line) ? ""
                                                      : "FILE has no such case of that identifier";
}

}  // namespace touchstone::kinds
