// The findings of a check: for the terminal, and as a page.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "harness/check/family_checker.h"

namespace touchstone::check {

// The checkers of a request, and what they say.
struct CheckReport {
  // Each kind's own checker, if it has one, and that of families. The request outlives it.
  explicit CheckReport(const CheckRequest& of);

  const CheckRequest* request;
  std::vector<std::unique_ptr<kinds::Checker>> checkers;
  std::int64_t jobs = 0;     // that are done
  bool interrupted = false;  // rows are kept, and nothing is made of them

  // Does a job. Its number gives family and round: all of a round, then the next round. Returns its rows as bytes.
  std::string do_job(std::size_t job) const;
  // Returns the certificates of the first round's cases of a family, a line each.
  std::string certificates(std::size_t family) const;
  // The place of the checker that has the jobs of a family.
  std::size_t checker_of(const kinds::Family& family) const;
  // Returns the checker of this type.
  template <class One>
  const One& of() const {
    for (const auto& checker : checkers) {
      if (const auto* one = dynamic_cast<const One*>(checker.get())) return *one;
    }
    throw std::logic_error("no such checker");
  }

  // Lists the faults of ours, one line each: of cases those beyond the documented margins, of axes and counts
  // verdicts that are silently wrong, and queries that crashed or hung. Empty if there are none.
  std::vector<std::string> ours_wrong() const;

 private:
  std::vector<const kinds::Kind*> kinds_;  // of the checkers; the last has none
};

// Returns the text for the terminal.
std::string summary_text(const CheckReport& report, std::size_t page_width);

// Returns the Markdown page of errors, or of the first failures along axes. `command` is the command that
// made it. `pictures` is the path of the maps of axes from the page's folder; if it is empty, the page has
// no maps.
std::string page_text(const CheckReport& report, const std::string& command,
                      const std::string& pictures = "");

}  // namespace touchstone::check
