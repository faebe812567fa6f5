// Forks a child, limits its memory, collects how it ended and its last words, and puts its ending
// into words.
#include "harness/process/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>
#include <thread>

#include "harness/base/clock.h"

namespace touchstone::process {

std::string_view to_string(ItemState state) {
  switch (state) {
    case ItemState::done: return "ok";
    case ItemState::threw: return "threw";
    case ItemState::crashed: return "crashed";
    case ItemState::timed_out: return "timed_out";
    case ItemState::garbage: return "garbage";
    case ItemState::not_run:
    case ItemState::running: break;
  }
  return "not_run";
}

Status status_of(ItemState state) {
  switch (state) {
    case ItemState::done: return Status::ok;
    case ItemState::timed_out: return Status::timed_out;
    case ItemState::garbage: return Status::garbage;
    default: return Status::crashed;
  }
}

std::string IsolationFailure::reason() const {
  std::string text;
  switch (state) {
    case ItemState::timed_out: text = "no answer in time"; break;
    case ItemState::threw: text = "threw"; break;
    case ItemState::garbage: text = "answered garbage"; break;
    default:
      text = signal != 0 ? fmt::format("killed by signal {} ({})", signal, strsignal(signal))
                         : fmt::format("left by exit({})", exit_code);
  }
  if (in_setup) text += " while it was set up";
  return words.empty() ? text : text + ": " + words;
}

namespace {

// Lets this process allocate `bytes` beyond what it holds now; further allocations fail.
void allow_memory(std::size_t bytes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static_cast<void>(bytes);
#else
  unsigned long long pages = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  if (pages == 0) return;
  const rlim_t used = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (bytes > RLIM_INFINITY - used || getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, used + bytes);
  setrlimit(RLIMIT_AS, &limit);
#endif
}

void become_child(pid_t parent, int output) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The parent may have died before prctl() asked for its signal.
  if (getppid() != parent) _exit(EXIT_FAILURE);
  prctl(PR_SET_DUMPABLE, 0);  // no core dump, not even into a pipe
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP}) {
    std::signal(signal, SIG_DFL);
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
}

}  // namespace

void expect_one_thread() {
#if !defined(__SANITIZE_THREAD__)
  std::error_code error;
  const std::filesystem::directory_iterator threads("/proc/self/task", error);
  if (error) return;
#if defined(TOUCHSTONE_EMULATED)
  constexpr std::ptrdiff_t of_emulator = 1;  // QEMU has a thread of its own
#else
  constexpr std::ptrdiff_t of_emulator = 0;
#endif
  const auto count = std::distance(begin(threads), end(threads)) - of_emulator;
  if (count > 1) {
    throw std::logic_error(fmt::format(
        "a process of {} threads is about to fork workers; expected one thread", count));
  }
#endif
}

ChildProcess::ChildProcess(const Settings& settings, const std::function<void()>& work) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::fflush(nullptr);  // otherwise the child would write the parent's buffered output again
  const pid_t parent = getpid();
  const pid_t child = fork();
  const int error = errno;
  if (child == 0) run(parent, ends[1], settings, work);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw std::system_error(error, std::generic_category(), "fork");
  }
  pid_ = child;
  words_ = ends[0];
}

// This function never returns: files, buffers and exit handlers of the parent are not the child's.
void ChildProcess::run(pid_t parent, int output, const Settings& settings,
                       const std::function<void()>& work) {
  const auto keep = [&](std::string_view what, ItemState state = ItemState::threw) {
    Thrown& thrown = thrown_[0];
    const std::size_t size = std::min(what.size(), thrown.text.size() - 1);
    std::copy_n(what.data(), size, thrown.text.data());
    thrown.state = state;
  };
  try {
    settings.before();
    become_child(parent, output);
    allow_memory(settings.memory);
    work();
    _exit(EXIT_SUCCESS);
  } catch (const Garbage& error) {
    keep(error.what(), ItemState::garbage);
  } catch (const std::exception& error) {
    keep(error.what());
  } catch (...) {
    keep("something that is no std::exception");
  }
  _exit(EXIT_FAILURE);
}

ChildProcess::~ChildProcess() {
  if (alive()) stop();
  close(words_);
}

void ChildProcess::listen(int milliseconds) {
  heard_ = false;
  if (words_at_end_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(milliseconds, 1)));
    return;
  }
  pollfd waiting{.fd = words_, .events = POLLIN, .revents = 0};
  if (poll(&waiting, 1, milliseconds) <= 0) return;
  std::array<char, 4096> bytes;
  const ssize_t got = read(words_, bytes.data(), bytes.size());
  if (got > 0) {
    text_.append(bytes.data(), static_cast<std::size_t>(got));
    if (text_.size() > kept_words) text_.erase(0, text_.size() - kept_words);
  }
  words_at_end_ = got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN);
  heard_ = got > 0;
}

bool ChildProcess::has_ended() {
  if (!alive()) return true;
  if (waitpid(pid_, &status_, WNOHANG) == 0) return false;
  pid_ = -1;
  return true;
}

void ChildProcess::wait(double seconds) {
  const base::Stopwatch watch;
  while (!has_ended()) {
    listen(1);
    if (watch.seconds() > seconds) {
      stop();
      stopped_ = false;  // the child had hung up and was not at work
    }
  }
}

void ChildProcess::stop() {
  kill(pid_, SIGKILL);
  while (waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  stopped_ = true;
}

IsolationFailure ChildProcess::failure() {
  do {
    listen(0);
  } while (heard_);
  while (!text_.empty() && (text_.back() == '\n' || text_.back() == ' ')) text_.pop_back();
  IsolationFailure failure;
  failure.words = text_;
  if (stopped_) {
    failure.state = ItemState::timed_out;
  } else if (thrown_[0].state != ItemState::not_run) {
    failure.state = thrown_[0].state;
    failure.words = thrown_[0].text.data() + (text_.empty() ? "" : ": " + text_);
  } else if (WIFSIGNALED(status_)) {
    failure.signal = WTERMSIG(status_);
  } else if (WIFEXITED(status_)) {
    failure.exit_code = WEXITSTATUS(status_);
  }
  return failure;
}

}  // namespace touchstone::process
