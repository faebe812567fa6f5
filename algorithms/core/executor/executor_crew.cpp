// Part of the executor: the hand-over of tasks to threads, and their waiting.
#include "algorithms/core/executor/executor_crew.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// Waits for some tens of cycles, in which the other thread of a processor's core can work.
void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

}  // namespace

std::unique_ptr<ExecutorThreads> make_crew(int width, bool may_spin, ExecutorThreads::Begin begin) {
  return std::make_unique<ExecutorCrew>(width, may_spin, std::move(begin));
}

ExecutorCrew::ExecutorCrew(int width, bool may_spin, Begin begin)
    : ExecutorThreads(least_shared_seconds),
      width_(width),
      may_spin_(may_spin),
      begin_(std::move(begin)),
      wake_rule_(may_spin) {}

ExecutorCrew::~ExecutorCrew() {
  {
    const std::lock_guard lock(mutex_);
    state_.fetch_or(is_over);
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ExecutorCrew::start_threads() {
  ranges_ = std::vector<Range>(static_cast<std::size_t>(width_));
  for (int worker = 1; worker < width_; ++worker) {
    threads_.emplace_back(&ExecutorCrew::work_as, this, worker);
  }
}

void ExecutorCrew::cut(std::size_t tasks) {
  const std::size_t share = tasks / ranges_.size(), larger = tasks % ranges_.size();
  std::size_t first = 0;
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    ranges_[i].next.store(first, std::memory_order_relaxed);
    first += share + (i < larger ? 1 : 0);
    ranges_[i].end = first;
  }
}

void ExecutorCrew::wake() {
  { const std::lock_guard lock(mutex_); }  // a thread that is about to sleep has seen the loop
  changed_.notify_all();
}

// Runs a task if there is one left. The first exception leaves no more tasks.
bool ExecutorCrew::run_next(int worker) {
  const auto own = static_cast<std::size_t>(worker);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    Range& range = ranges_[(own + i) % ranges_.size()];
    if (range.next.load(std::memory_order_relaxed) >= range.end) continue;
    const std::size_t task = range.next.fetch_add(1, std::memory_order_relaxed);
    if (task >= range.end) continue;
    try {
      (*body_)(task, worker);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      for (Range& left : ranges_) left.next.store(left.end, std::memory_order_relaxed);
    }
    return true;
  }
  return false;
}

ExecutorThreads::Share ExecutorCrew::share(std::size_t tasks, const Body& body, double seconds) {
  if (threads_.empty()) start_threads();
  const auto start = Clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  body_ = &body;
  cut(tasks);
  state_.fetch_add((std::uint64_t{1} << loop_bits) + is_open);
  Share own;
  if (seconds == 0) {  // the first task tells
    own.tasks += run_next(0) ? 1 : 0;
    seconds = passed() * static_cast<double>(tasks);
  }
  if (wake_rule_.wakes(asleep_.load() > 0, start, seconds)) wake();
  while (run_next(0)) ++own.tasks;
  own.seconds = passed();
  state_.fetch_and(~is_open);
  for (int waited = 0; (state_.load(std::memory_order_acquire) & all_inside) != 0; ++waited) {
    // Where threads share a processor, those inside need it.
    waited < 2'000 ? pause() : std::this_thread::yield();
  }
  wake_rule_.end_loop(Clock::now());
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return own;
}

// --- the threads of the crew ---

void ExecutorCrew::work_as(int worker) {
  begin_(worker);
  std::uint64_t loop = 0;
  while ((state_.load() & is_over) == 0) {
    if (!enter(loop)) {
      sleep(loop);
      continue;
    }
    while (run_next(worker)) {
    }
    state_.fetch_sub(one_inside, std::memory_order_release);
  }
}

// Waits awake for an open loop after this one, enters it and sets the number. Returns false if none
// comes for some time.
bool ExecutorCrew::enter(std::uint64_t& loop) {
  const auto end = Clock::now() + (may_spin_ ? WakeRule::awake_for : std::chrono::microseconds(0));
  for (;;) {
    for (int i = 0; i < 64; ++i) {
      std::uint64_t state = state_.load(std::memory_order_acquire);
      if ((state & is_over) != 0) return false;
      if ((state & is_open) != 0 && state >> loop_bits != loop) {
        if (!state_.compare_exchange_weak(state, state + one_inside)) continue;
        loop = state >> loop_bits;
        return true;
      }
      if (!may_spin_) break;
      pause();
    }
    if (Clock::now() >= end) return false;
  }
}

// Sleeps until it is woken for a loop after this one.
void ExecutorCrew::sleep(std::uint64_t loop) {
  std::unique_lock lock(mutex_);
  ++asleep_;
  changed_.wait(lock, [&] {
    const std::uint64_t state = state_.load();
    return (state & is_over) != 0 || ((state & is_open) != 0 && state >> loop_bits != loop);
  });
  --asleep_;
}

}  // namespace touchstone
