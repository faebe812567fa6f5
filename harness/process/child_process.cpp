#include "harness/process/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace touchstone {

void expect_one_thread() {
#if !defined(__SANITIZE_THREAD__)
  std::error_code error;
  const std::filesystem::directory_iterator threads("/proc/self/task", error);
  if (error) return;
  const auto count = std::distance(begin(threads), end(threads));
  if (count > 1) {
    throw std::logic_error(fmt::format(
        "a process of {} threads is about to fork workers; expected one thread", count));
  }
#endif
}

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

void begin_child(pid_t parent, int output) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);  // it died before it could be asked for
  prctl(PR_SET_DUMPABLE, 0);                     // no core dump, not even into a pipe
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP}) {
    std::signal(signal, SIG_DFL);
  }
  std::signal(SIGINT, SIG_IGN);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
}

LastWords::~LastWords() { close(descriptor_); }

void LastWords::listen(int milliseconds) {
  if (at_end_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(milliseconds, 1)));
    return;
  }
  pollfd waiting{.fd = descriptor_, .events = POLLIN, .revents = 0};
  if (poll(&waiting, 1, milliseconds) <= 0) return;
  std::array<char, 4096> bytes;
  const ssize_t got = read(descriptor_, bytes.data(), bytes.size());
  if (got > 0) {
    text_.append(bytes.data(), static_cast<std::size_t>(got));
    if (text_.size() > kept) text_.erase(0, text_.size() - kept);
  }
  at_end_ = got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN);
  heard_ = got > 0;
}

std::string LastWords::take() {
  do {
    heard_ = false;
    listen(0);
  } while (heard_);
  while (!text_.empty() && (text_.back() == '\n' || text_.back() == ' ')) text_.pop_back();
  return text_;
}

WordsPipe make_words_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  return {ends[0], ends[1]};
}

int kill_and_wait(pid_t pid) {
  int status = 0;
  kill(pid, SIGKILL);
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace touchstone
