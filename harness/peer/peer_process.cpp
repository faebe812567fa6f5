// Starts a program and its watcher, and exchanges lines with it.
#include "harness/peer/peer_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "harness/base/clock.h"
#include "harness/process/child_process.h"

namespace touchstone::peer {
namespace {

constexpr int tick_milliseconds = 50;
// More processes than this at once are a fault of the program.
constexpr std::size_t most_processes = 256;

enum class Ended : std::uint8_t { by_itself, asked, memory, processes };

struct Report {
  Ended ended = Ended::by_itself;
  int status = 0;  // of waitpid
};

struct Pipe {
  int from = -1, to = -1;

  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "pipe");
    }
    from = ends[0];
    to = ends[1];
  }
  ~Pipe() {
    for (const int end : {from, to}) {
      if (end >= 0) close(end);
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

// --- the program ---

// The shell itself becomes the program where the command is one alone, so that its ending and its output are the
// program's own.
std::string for_shell(const std::string& command) {
  const bool is_one = command.find_first_of(";&|<>(){}`\n") == std::string::npos &&
                      command.substr(0, command.find(' ')).find('=') == std::string::npos &&
                      !command.starts_with(' ') && !command.starts_with("exec ");
  return is_one ? "exec " + command : command;
}

[[noreturn]] void become_program(const Program& program, int input, int output, pid_t watcher) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != watcher) _exit(EXIT_FAILURE);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGCHLD})
    std::signal(signal, SIG_DFL);
  // A limit of addresses is not one of memory to programs that reserve more than they use, as WebAssembly does. The
  // watcher counts what is used.
  rlimit addresses{};
  if (getrlimit(RLIMIT_AS, &addresses) == 0) {
    addresses.rlim_cur = addresses.rlim_max;
    setrlimit(RLIMIT_AS, &addresses);
  }
  const rlimit no_core{};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  close_range(STDERR_FILENO + 1, ~0U, 0);
  if (!program.folder.empty() && chdir(program.folder.c_str()) != 0) _exit(127);
  execl("/bin/sh", "sh", "-c", for_shell(program.command).c_str(), nullptr);
  _exit(127);
}

// --- the watcher ---

std::vector<pid_t> children_of(pid_t process) {
  std::vector<pid_t> children;
  std::ifstream file(fmt::format("/proc/{0}/task/{0}/children", process));
  for (pid_t child = 0; file >> child;) children.push_back(child);
  return children;
}

// The processes below this one. Those whose parents ended are its own children (PR_SET_CHILD_SUBREAPER).
std::vector<pid_t> all_below(pid_t process) {
  std::vector<pid_t> all = children_of(process);
  for (std::size_t i = 0; i < all.size() && all.size() <= 2 * most_processes; ++i) {
    const std::vector<pid_t> further = children_of(all[i]);
    all.insert(all.end(), further.begin(), further.end());
  }
  return all;
}

// Bytes of the process that no file backs.
std::size_t memory_of(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/statm", process));
  std::size_t size = 0, resident = 0, of_files = 0;
  file >> size >> resident >> of_files;
  return (resident - std::min(resident, of_files)) *
         static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Closes all files but the standard ones and these two.
void keep_open(int one, int other) {
  const auto [low, high] = std::minmax(one, other);
  const auto close_from = [](int first, int end) {
    if (first < end) close_range(static_cast<unsigned>(first), static_cast<unsigned>(end - 1), 0);
  };
  close_from(STDERR_FILENO + 1, low);
  close_from(low + 1, high);
  close_range(static_cast<unsigned>(high + 1), ~0U, 0);
}

// Ends all processes below this one.
void end_all(pid_t group) {
  kill(-group, SIGKILL);
  for (;;) {
    for (const pid_t child : children_of(getpid())) kill(child, SIGKILL);
    if (waitpid(-1, nullptr, 0) < 0 && errno == ECHILD) return;
  }
}

// Waits until the program ends, or has to.
Report watch(pid_t program, int life, const ProgramLimits& limits) {
  Report report;
  for (;;) {
    if (waitpid(program, &report.status, WNOHANG) == program) return report;
    pollfd waiting{.fd = life, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, tick_milliseconds) > 0) report.ended = Ended::asked;
    const std::vector<pid_t> processes = all_below(getpid());
    for (const pid_t child : children_of(getpid())) {
      if (child != program)
        waitpid(child, nullptr, WNOHANG);  // an orphan that ended is no process any more
    }
    std::size_t used = 0;
    for (const pid_t process : processes) used += memory_of(process);
    if (limits.use != nullptr) limits.use->add_memory(used);
    if (report.ended == Ended::asked) return report;
    if (used > limits.memory) report.ended = Ended::memory;
    if (processes.size() > most_processes) report.ended = Ended::processes;
    if (report.ended != Ended::by_itself) return report;
  }
}

[[noreturn]] void run_watcher(const Program& program, int input, int output, int life, int answer,
                              const ProgramLimits& limits) {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_IGN);
  std::signal(SIGCHLD, [](int) {});  // it ends the wait of poll()
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t watcher = getpid();
  const pid_t child = fork();
  if (child == 0) become_program(program, input, output, watcher);
  if (child < 0) _exit(EXIT_FAILURE);
  setpgid(child, child);
  keep_open(life, answer);
  const Report report = watch(child, life, limits);
  end_all(child);
  // If nobody reads it, nobody asked.
  if (write(answer, &report, sizeof report) != sizeof report) _exit(EXIT_FAILURE);
  _exit(EXIT_SUCCESS);
}

// While one lives, a write to a pipe that nobody reads is an error and not a signal.
class BrokenPipes {
 public:
  BrokenPipes() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~BrokenPipes() { std::signal(SIGPIPE, before_); }
  BrokenPipes(const BrokenPipes&) = delete;
  BrokenPipes& operator=(const BrokenPipes&) = delete;

 private:
  void (*before_)(int);
};

std::string words_of(const Report& report, const ProgramLimits& limits) {
  switch (report.ended) {
    case Ended::asked: return "the program closed its output";
    case Ended::memory:
      return fmt::format("the program took more than {} MiB of memory", limits.memory >> 20);
    case Ended::processes:
      return fmt::format("the program had more than {} processes", most_processes);
    case Ended::by_itself: break;
  }
  if (WIFSIGNALED(report.status)) {
    const int signal = WTERMSIG(report.status);
    return fmt::format("the program was killed by signal {} ({})", signal, strsignal(signal));
  }
  return fmt::format("the program left with status {}", WEXITSTATUS(report.status));
}

}  // namespace

PeerProcess::PeerProcess(const Program& program, const ProgramLimits& limits) : limits_(limits) {
  Pipe input, output, life, report;
  if (limits.use != nullptr) limits.use->add_start();
  const pid_t watcher = fork();
  if (watcher < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (watcher == 0) {
    close(std::exchange(life.to, -1));
    run_watcher(program, input.from, output.to, life.from, report.to, limits);
  }
  watcher_ = watcher;
  input_ = std::exchange(input.to, -1);
  output_ = std::exchange(output.from, -1);
  life_ = std::exchange(life.to, -1);
  report_ = std::exchange(report.from, -1);
  for (const int end : {input_, output_}) fcntl(end, F_SETFL, O_NONBLOCK);
}

PeerProcess::~PeerProcess() {
  end();
  close(report_);
}

void PeerProcess::end() {
  for (int* file : {&input_, &output_, &life_}) {
    if (*file >= 0) close(std::exchange(*file, -1));
  }
  if (watcher_ < 0) return;
  while (waitpid(watcher_, nullptr, 0) < 0 && errno == EINTR) {
  }
  watcher_ = -1;
}

void PeerProcess::throw_ended() {
  // The watcher sees by itself that the program ended, a little later than this process does.
  pollfd waiting{.fd = report_, .events = POLLIN, .revents = 0};
  poll(&waiting, 1, 4 * tick_milliseconds);
  end();
  Report report;
  if (read(report_, &report, sizeof report) != sizeof report) {
    throw ProgramEnded("the program could not be started");
  }
  throw ProgramEnded(words_of(report, limits_));
}

void PeerProcess::take_lines(std::vector<std::string>& lines, std::size_t count) {
  std::size_t begin = 0;
  while (lines.size() < count) {
    const std::size_t end = buffer_.find('\n', std::max(begin, searched_));
    if (end == std::string::npos) break;
    lines.push_back(buffer_.substr(begin, end - begin));
    begin = end + 1;
  }
  buffer_.erase(0, begin);
  searched_ = lines.size() < count ? buffer_.size() : 0;
}

// Returns false at the end of the program's output.
bool PeerProcess::read_some() {
  std::array<char, 1 << 16> bytes;
  const ssize_t got = read(output_, bytes.data(), bytes.size());
  if (got > 0) buffer_.append(bytes.data(), static_cast<std::size_t>(got));
  return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

std::vector<std::string> PeerProcess::exchange(std::string_view text, std::size_t count,
                                               double seconds) {
  if (output_ < 0) throw ProgramEnded("the program was ended before");
  const BrokenPipes guard;
  const base::Stopwatch watch;
  std::vector<std::string> lines;
  for (;;) {
    take_lines(lines, count);
    if (lines.size() == count && text.empty()) return lines;
    if (lines.size() < count && buffer_.size() > limits_.line) {
      throw process::Garbage(fmt::format("a line of more than {} bytes", limits_.line));
    }
    if (watch.seconds() > seconds) {
      end();
      throw ProgramEnded(fmt::format("the program did not answer within {:g} s", seconds));
    }
    std::array<pollfd, 2> waiting = {
        pollfd{.fd = lines.size() < count ? output_ : -1, .events = POLLIN, .revents = 0},
        pollfd{.fd = text.empty() ? -1 : input_, .events = POLLOUT, .revents = 0}};
    poll(waiting.data(), waiting.size(), std::isfinite(seconds) ? tick_milliseconds : -1);
    if (waiting[1].revents != 0) {
      const ssize_t written = write(input_, text.data(), text.size());
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
      // A program that reads no more may have answered before.
      if (written < 0 && errno == EPIPE) text = {};
    }
    if (waiting[0].revents != 0 && !read_some()) {
      take_lines(lines, count);
      if (lines.size() < count) throw_ended();
    }
  }
}

std::string PeerProcess::bytes(std::size_t count) {
  while (buffer_.size() < count) {
    pollfd waiting{.fd = output_, .events = POLLIN, .revents = 0};
    poll(&waiting, 1, -1);
    if (waiting.revents != 0 && !read_some()) throw_ended();
  }
  std::string taken = buffer_.substr(0, count);
  buffer_.erase(0, count);
  searched_ = 0;
  return taken;
}

}  // namespace touchstone::peer
