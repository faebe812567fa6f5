#include "harness/process/isolate.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string_view>
#include <system_error>

#include "harness/base/clock.h"
#include "harness/process/child_process.h"

namespace touchstone {
namespace {

constexpr int tick_milliseconds = 20;

// What a child tells its parent, in shared memory.
struct Progress {
  // Items begun since the parent made this, counting the setup of each child: goes up whenever the
  // child's time starts afresh.
  std::atomic<std::uint64_t> beats = 0;
  std::atomic<bool> in_setup = false;
  std::atomic<std::size_t> item = 0;  // at hand
  std::atomic<ItemState> end = ItemState::running;
  std::array<char, LastWords::kept> thrown{};
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

void keep_thrown(Progress& progress, std::string_view what) {
  const std::size_t size = std::min(what.size(), progress.thrown.size() - 1);
  std::copy_n(what.data(), size, progress.thrown.data());
  progress.thrown[size] = '\0';
  progress.end.store(ItemState::threw);
}

// Never returns: what the parent has open, buffered and registered for its exit is none of the
// child's.
[[noreturn]] void be_child(pid_t parent, int output, const IsolationLimits& limits,
                           std::size_t first, Progress& progress, SharedArray<ItemState>& states,
                           const std::function<ItemWork()>& setup) {
  begin_child(parent, output);
  allow_memory(limits.memory);
  try {
    const ItemWork work = setup();
    progress.beats.fetch_add(1);  // first: or the setup's time would be held against an item
    progress.in_setup.store(false);
    for (std::size_t item = first; item < states.size(); ++item) {
      progress.item.store(item);
      states[item] = ItemState::running;
      progress.beats.fetch_add(1);
      work(item);
      states[item] = ItemState::done;
    }
    progress.end.store(ItemState::done);
    _exit(EXIT_SUCCESS);
  } catch (const std::exception& error) {
    keep_thrown(progress, error.what());
  } catch (...) {
    keep_thrown(progress, "something that is no std::exception");
  }
  _exit(EXIT_FAILURE);
}

// The child at work, as its parent sees it.
class Child {
 public:
  Child(const IsolationLimits& limits, std::size_t first, Progress& progress,
        SharedArray<ItemState>& states, const std::function<ItemWork()>& setup)
      : limits_(limits), progress_(progress), pid_(start(limits, first, progress, states, setup)) {}
  ~Child() {
    if (pid_ > 0) stop();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Returns when the child has ended; stops it when it takes too long over one thing.
  void watch() {
    std::uint64_t beats = progress_.beats.load();
    Stopwatch stopwatch;
    while (waitpid(pid_, &status_, WNOHANG) == 0) {
      const double allowed =
          progress_.in_setup.load() ? limits_.setup_seconds : limits_.item_seconds;
      if (const std::uint64_t now = progress_.beats.load(); now != beats) {
        beats = now;
        stopwatch.restart();
      }
      if (stopwatch.seconds() > allowed) {
        stop();
        stopped_ = true;
        too_late_ = progress_.beats.load() != beats;
        break;
      }
      words_->listen(tick_milliseconds);
    }
    pid_ = -1;
  }

  // After watch(): it was stopped just when it had gone on to another item, which has no fault.
  bool stopped_too_late() const { return too_late_; }

  // After watch(), of a child that did not do all.
  IsolationFailure failure() {
    IsolationFailure failure;
    failure.item = progress_.item.load();
    failure.in_setup = progress_.in_setup.load();
    failure.words = words_->take();
    if (stopped_) {
      failure.state = ItemState::timed_out;
    } else if (progress_.end.load() == ItemState::threw) {
      failure.state = ItemState::threw;
      failure.words = progress_.thrown.data();
    } else if (WIFSIGNALED(status_)) {
      failure.signal = WTERMSIG(status_);
    } else {
      failure.exit_code = WEXITSTATUS(status_);
    }
    return failure;
  }

 private:
  pid_t start(const IsolationLimits& limits, std::size_t first, Progress& progress,
              SharedArray<ItemState>& states, const std::function<ItemWork()>& setup) {
    const WordsPipe pipe = make_words_pipe();
    words_ = std::make_unique<LastWords>(pipe.listening);
    std::fflush(nullptr);  // or the child would have a copy of what is not written yet
    const pid_t parent = getpid();
    const pid_t child = fork();
    const int error = errno;
    if (child == 0) be_child(parent, pipe.speaking, limits, first, progress, states, setup);
    close(pipe.speaking);
    if (child < 0) throw std::system_error(error, std::generic_category(), "fork");
    return child;
  }
  void stop() { status_ = kill_and_wait(pid_); }

  const IsolationLimits& limits_;
  Progress& progress_;
  std::unique_ptr<LastWords> words_;
  pid_t pid_;
  int status_ = 0;
  bool stopped_ = false;
  bool too_late_ = false;
};

}  // namespace

std::string IsolationFailure::reason() const {
  std::string text;
  switch (state) {
    case ItemState::timed_out: text = "no answer in time"; break;
    case ItemState::threw: text = "threw"; break;
    default:
      text = signal != 0 ? fmt::format("killed by signal {} ({})", signal, strsignal(signal))
                         : fmt::format("left by exit({})", exit_code);
  }
  if (in_setup) text += " while it was set up";
  return words.empty() ? text : text + ": " + words;
}

IsolationReport isolate(std::size_t items, const IsolationLimits& limits,
                        const std::function<ItemWork()>& setup) {
  IsolationReport report;
  SharedArray<ItemState> states(items);
  SharedArray<Progress> shared(1);
  Progress& progress = shared[0];
  for (std::size_t first = 0; first < items && report.failures.size() < limits.failures;) {
    progress.item.store(first);
    progress.in_setup.store(true);
    progress.end.store(ItemState::running);
    progress.beats.fetch_add(1);
    Child child(limits, first, progress, states, setup);
    child.watch();
    if (progress.end.load() == ItemState::done) break;
    if (child.stopped_too_late()) {
      first = progress.item.load();
      continue;
    }
    report.failures.push_back(child.failure());
    const IsolationFailure& failure = report.failures.back();
    if (failure.in_setup) {
      std::ranges::fill(states.span().subspan(first), failure.state);
      break;
    }
    states[failure.item] = failure.state;
    first = failure.item + 1;
  }
  report.states.assign(states.span().begin(), states.span().end());
  return report;
}

}  // namespace touchstone
