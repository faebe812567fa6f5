// Questions that are answered one by one, each by an algorithm in a child process.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {

// `Entry` is the registry's, `Answer` is trivially copyable and has a status, which is `unsupported` in a new one.
template <class Entry, class Answer>
class AnswersOf : public Questions {
 public:
  std::size_t contestants() const final { return asked_.size(); }
  const AlgorithmInfo& info(std::size_t contestant) const final {
    return asked_[contestant].entry->info;
  }

 protected:
  struct Asked {
    const Entry* entry;
    Precision scalar = Precision::float64;
    std::vector<Answer> answers = {};  // one for each question
  };

  void select(const std::vector<std::string>& names, std::string_view what, Precision scalar) {
    for (const Entry* entry : kinds::select(registry::entries<Entry>(), names, what)) {
      asked_.push_back({.entry = entry, .scalar = scalar});
    }
  }
  const Answer& answer(std::size_t question, std::size_t contestant) const {
    return asked_[contestant].answers[question];
  }

  // Asks the questions that `takes`. `setup` returns, in the child process, a function from a question to its answer.
  template <class Takes, class Setup>
  std::vector<AskFailure> ask_each(std::size_t contestant, double seconds, const Takes& takes,
                                   const Setup& setup) {
    Asked& asked = asked_[contestant];
    asked.answers.assign(size(), Answer{});
    std::vector<std::size_t> taken;
    for (std::size_t i = 0; i < size(); ++i) {
      if (takes(i)) taken.push_back(i);
    }
    const auto solved = process::isolated_answers<Answer>(
        taken.size(), {.item_seconds = seconds},
        [&] { return [&taken, solve = setup()](std::size_t item) { return solve(taken[item]); }; });
    for (std::size_t item = 0; item < taken.size(); ++item) {
      asked.answers[taken[item]] = solved.answers[item];
    }
    std::vector<AskFailure> failures;
    for (const process::IsolationFailure& failure : solved.failures) {
      failures.push_back({label(taken[failure.item]), failure.reason()});
    }
    return failures;
  }

  std::vector<Asked> asked_;
};

}  // namespace touchstone::kinds
