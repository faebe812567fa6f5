// Work done in a forked child, so that a crash or a hang of a library costs only the item at hand.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "harness/process/ending.h"
#include "harness/process/shared_array.h"

namespace touchstone::process {

struct IsolationLimits {
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);
  double item_seconds = 5;  // wall clock; an item is stopped at most a twentieth of a second later
  double setup_seconds = 60;        // the same for the setup of a child
  std::size_t failures = no_limit;  // no further item is begun after these
  // Bytes that a child may add to what is there; beyond, its allocations fail. The limit is not
  // kept under a sanitizer.
  std::size_t memory = std::size_t{4} << 30;
};

struct IsolationReport {
  std::vector<ItemState> states;           // of each item
  std::vector<IsolationFailure> failures;  // in the order of the items
};

using ItemWork = std::function<void(std::size_t item)>;

// Runs the items 0, 1, ... in order in a child process: `setup` once in each child, then the work
// that it returned on each item. After a failure a new child goes on at the next item; a failure of
// the setup would come again, so it ends the work, and its state is that of all items that are
// left.
//
// Results are written to SharedArrays; whatever else the child changes is lost with it. What it
// prints is kept from the terminal. Its memory is the caller's at the time of the call, but of the
// caller's threads only the calling one goes on in it: the work must not use an Executor that was
// made before. The child dies with the caller. An item costs a few stores; there is no fork for it.
IsolationReport isolate(std::size_t items, const IsolationLimits& limits,
                        const std::function<ItemWork()>& setup);

// Answers of items that a child answered; an answer has a `status`.
template <class Answer>
struct IsolatedAnswers {
  std::vector<Answer> answers;             // of each item
  std::vector<IsolationFailure> failures;  // in the order of the items
};

// Runs the items as isolate() does; `setup` returns a function from an item to its answer, which is
// plain bytes. The answer of an item that was lost is a default one whose status is crashed or
// timed_out; items that were not begun share the status of the last that was lost.
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

}  // namespace touchstone::process
