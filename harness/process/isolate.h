// Work done in a forked child, so that a crash or a hang of a library costs only the item at hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/process/child_process.h"

namespace touchstone::process {

struct IsolationLimits {
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);
  double item_seconds = 5;  // wall clock; an item is stopped at most a twentieth of a second later
  double setup_seconds = 60;        // wall clock, for the setup of a child
  std::size_t failures = no_limit;  // no further item is begun after so many failures
  // Bytes that a child may add to its memory; further allocations fail. The limit is not set under
  // a sanitizer.
  std::size_t memory = std::size_t{4} << 30;
};

struct IsolationReport {
  std::vector<ItemState> states;           // one for each item
  std::vector<IsolationFailure> failures;  // in the order of the items
};

using ItemWork = std::function<void(std::size_t item)>;

// Runs the items 0, 1, ... in order in a child process: `setup` once in each child, then the work
// that it returned on each item. After a failure a new child goes on at the next item. A failure of
// the setup would come again, so it ends the work, and all remaining items get its state.
//
// Results are written to SharedArrays; all other changes that the child makes are lost with it. Its
// output does not reach the terminal. Its memory is a copy of the caller's at the time of the call,
// but only the calling thread goes on in it: the work must not use an Executor that was made
// before. The child dies with the caller. An item costs a few stores, and no fork.
IsolationReport isolate(std::size_t items, const IsolationLimits& limits,
                        const std::function<ItemWork()>& setup);

// The answers of a child, one for each item; an answer has a `status`.
template <class Answer>
struct IsolatedAnswers {
  std::vector<Answer> answers;             // one for each item
  std::vector<IsolationFailure> failures;  // in the order of the items
};

// Runs the items as isolate() does; `setup` returns a function from an item to its answer, which is
// trivially copyable. A lost item gets a default answer with status crashed or timed_out; items
// that were not begun get the status of the last lost one.
template <class Answer, class Setup>
IsolatedAnswers<Answer> isolated_answers(std::size_t items, const IsolationLimits& limits,
                                         const Setup& setup) {
  SharedArray<Answer> shared(items);
  IsolationReport report = isolate(items, limits, [&]() -> ItemWork {
    return [&shared, answer = setup()](std::size_t item) { shared[item] = answer(item); };
  });
  IsolatedAnswers<Answer> result = {{shared.span().begin(), shared.span().end()},
                                    std::move(report.failures)};
  Status lost = Status::crashed;
  for (std::size_t item = 0; item < items; ++item) {
    const ItemState state = report.states[item];
    if (state == ItemState::done) continue;
    if (state != ItemState::not_run) lost = status_of(state);
    result.answers[item] = Answer{};
    result.answers[item].status = lost;
  }
  return result;
}

// Lines of text that a forked child makes, so that a crash or a hang costs only the line at hand.

// Makes the line of an item, without the line break; nothing if the item has none.
using MakeLine = std::function<std::optional<std::string>(std::size_t item)>;

struct LinesReport {
  std::int64_t lines = 0;
  std::vector<IsolationFailure> failures;  // in the order of the items
};

// Runs the items as isolate() does, `setup` returns what makes their lines. Hands the lines, with their line breaks, to
// `take` in the items' order, once all are made; until then they are in a temporary file. An item that is lost has no line. Throws
// std::system_error if there is no temporary file.
LinesReport isolated_lines(std::size_t items, const IsolationLimits& limits,
                           const std::function<MakeLine()>& setup,
                           const std::function<void(const std::string& line)>& take);

}  // namespace touchstone::process
