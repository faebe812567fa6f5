// Runs items in children, watches their time, and starts a new child after each failure.
#include "harness/process/isolate.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <system_error>

#include "harness/base/clock.h"
#include "harness/process/child_process.h"

namespace touchstone::process {
namespace {

constexpr int tick_milliseconds = 20;

// The state that a child shares with its parent.
struct Progress {
  // Number of items begun since the parent made this, plus one for each child's setup. It goes up
  // whenever the child's time starts afresh.
  std::atomic<std::uint64_t> beats = 0;
  std::atomic<bool> in_setup = false;
  std::atomic<std::size_t> item = 0;  // item at hand
  std::atomic<bool> done = false;     // all items are done
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

// Runs in the child: the setup, then the items.
void work_through(std::size_t first, Progress& progress, SharedArray<ItemState>& states,
                  const std::function<ItemWork()>& setup) {
  const ItemWork work = setup();
  // This comes first, so that the setup's time does not count for an item.
  progress.beats.fetch_add(1);
  progress.in_setup.store(false);
  for (std::size_t item = first; item < states.size(); ++item) {
    progress.item.store(item);
    states[item] = ItemState::running;
    progress.beats.fetch_add(1);
    work(item);
    states[item] = ItemState::done;
  }
  progress.done.store(true);
  _exit(EXIT_SUCCESS);  // leaves before `work` is destroyed, which may hold broken data
}

// Returns when the child has ended, and stops it when it takes too long over one item. Returns
// false if it stopped the child just after the child had gone on to another item, which is not at
// fault.
bool watch(ChildProcess& child, const IsolationLimits& limits, const Progress& progress) {
  std::uint64_t beats = progress.beats.load();
  base::Stopwatch stopwatch;
  while (!child.has_ended()) {
    const double allowed = progress.in_setup.load() ? limits.setup_seconds : limits.item_seconds;
    if (const std::uint64_t now = progress.beats.load(); now != beats) {
      beats = now;
      stopwatch.restart();
    }
    if (stopwatch.seconds() > allowed) {
      child.stop();
      return progress.beats.load() == beats;
    }
    child.listen(tick_milliseconds);
  }
  return true;
}

}  // namespace

IsolationReport isolate(std::size_t items, const IsolationLimits& limits,
                        const std::function<ItemWork()>& setup) {
  IsolationReport report;
  SharedArray<ItemState> states(items);
  SharedArray<Progress> shared(1);
  Progress& progress = shared[0];
  for (std::size_t first = 0; first < items && report.failures.size() < limits.failures;) {
    progress.item.store(first);
    progress.in_setup.store(true);
    progress.beats.fetch_add(1);
    ChildProcess child({.memory = limits.memory},
                       [&] { work_through(first, progress, states, setup); });
    const bool in_time = watch(child, limits, progress);
    if (progress.done.load()) break;
    if (!in_time) {
      first = progress.item.load();
      continue;
    }
    IsolationFailure& failure = report.failures.emplace_back(child.failure());
    failure.item = progress.item.load();
    failure.in_setup = progress.in_setup.load();
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

// Children append lines to a temporary file and note where each one is. What a child wrote of a line that it did
// not finish is not noted, and so left out.

namespace {

[[noreturn]] void throw_error(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// A file that is gone when it is closed.
class TemporaryFile {
 public:
  TemporaryFile() {
    if (file_ == nullptr) throw_error("temporary file");
  }

  std::int64_t end() const {
    const std::int64_t at = lseek(descriptor(), 0, SEEK_END);
    if (at < 0) throw_error("temporary file");
    return at;
  }

  void write(std::string_view text, std::int64_t at) const {
    while (!text.empty()) {
      const auto written = pwrite(descriptor(), text.data(), text.size(), at);
      if (written < 0) throw_error("temporary file");
      text.remove_prefix(static_cast<std::size_t>(written));
      at += written;
    }
  }

  std::string read(std::int64_t at, std::size_t size) const {
    std::string text(size, '\0');
    for (std::size_t done = 0; done < size;) {
      errno = EIO;  // a file that is shorter than it was sets none
      const auto some = pread(descriptor(), text.data() + done, size - done,
                              at + static_cast<std::int64_t>(done));
      if (some <= 0) throw_error("temporary file");
      done += static_cast<std::size_t>(some);
    }
    return text;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  int descriptor() const { return fileno(file_.get()); }

  std::unique_ptr<std::FILE, Close> file_{std::tmpfile()};
};

struct Place {
  std::int64_t begin = 0;
  std::size_t size = 0;  // with the line break; 0 if there is no line
};

}  // namespace

LinesReport isolated_lines(std::size_t items, const IsolationLimits& limits,
                           const std::function<MakeLine()>& setup,
                           const std::function<void(const std::string& line)>& take) {
  const TemporaryFile file;
  SharedArray<Place> places(items);
  IsolationReport report = isolate(items, limits, [&]() -> ItemWork {
    return [&, make = setup(), end = file.end()](std::size_t item) mutable {
      const std::optional<std::string> line = make(item);
      if (!line) return;
      file.write(*line + '\n', end);
      places[item] = {end, line->size() + 1};
      end += static_cast<std::int64_t>(places[item].size);
    };
  });
  LinesReport lines{0, std::move(report.failures)};
  for (std::size_t item = 0; item < items; ++item) {
    if (report.states[item] != ItemState::done || places[item].size == 0) continue;
    take(file.read(places[item].begin, places[item].size));
    ++lines.lines;
  }
  return lines;
}

}  // namespace touchstone::process
