#include "harness/process/worker_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/process/isolate.h"

namespace touchstone {
namespace {

// What goes before the bytes of a result.
struct Header {
  std::size_t job = 0;
  std::size_t size = 0;
  bool threw = false;  // the bytes say what
};

// What the processes share.
struct Board {
  std::atomic<std::size_t> next = 0;  // job that nobody has begun
  std::atomic<std::size_t> taken = 0;
  std::atomic<bool> stop = false;
};

void write_all(int descriptor, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t wrote = write(descriptor, at, size);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) _exit(EXIT_FAILURE);  // the parent is gone
    at += wrote;
    size -= static_cast<std::size_t>(wrote);
  }
}

[[noreturn]] void be_worker(pid_t parent, int output, std::size_t end, std::size_t lead,
                            Board& board, const std::function<JobWork()>& make) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);
  std::signal(SIGINT, SIG_IGN);  // the parent decides
  std::signal(SIGPIPE, SIG_IGN);
  Header header;
  const auto send = [&](const std::string& bytes) {
    header.size = bytes.size();
    write_all(output, &header, sizeof header);
    write_all(output, bytes.data(), bytes.size());
  };
  try {
    const JobWork work = make();
    for (;;) {
      header.job = board.next.fetch_add(1);
      if (header.job >= end) break;
      // Results that wait for an earlier one are held in memory: not too many of them.
      while (header.job > board.taken.load() + lead && !board.stop.load()) usleep(1000);
      if (board.stop.load()) break;
      send(work(header.job));
    }
    _exit(EXIT_SUCCESS);
  } catch (const std::exception& error) {
    header.threw = true;
    send(error.what());
  }
  _exit(EXIT_FAILURE);
}

// One worker, as its parent sees it. It is stopped when this goes.
class Worker {
 public:
  Worker(std::size_t end, std::size_t lead, Board& board, const std::function<JobWork()>& make) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
    std::fflush(nullptr);  // or the child would have a copy of what is not written yet
    const pid_t parent = getpid();
    pid_ = fork();
    const int error = errno;
    if (pid_ == 0) {
      close(ends[0]);
      be_worker(parent, ends[1], end, lead, board, make);
    }
    close(ends[1]);
    input_ = ends[0];
    if (pid_ < 0) throw std::system_error(error, std::generic_category(), "fork");
  }
  ~Worker() {
    if (input_ >= 0) close(input_);
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    wait_for_end();
  }
  Worker(Worker&& other) noexcept
      : pid_(std::exchange(other.pid_, -1)),
        input_(std::exchange(other.input_, -1)),
        bytes_(std::move(other.bytes_)) {}

  int input() const { return input_; }  // -1 when it has ended
  const std::string& bytes() const { return bytes_; }

  // Takes what it has sent. Results that are whole go to `store`.
  void receive(std::map<std::size_t, std::string>& store) {
    char buffer[1 << 16];
    const ssize_t got = read(input_, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) return;
    if (got <= 0) return end();
    bytes_.append(buffer, static_cast<std::size_t>(got));
    for (Header header; bytes_.size() >= sizeof header;) {
      std::memcpy(&header, bytes_.data(), sizeof header);
      if (bytes_.size() < sizeof header + header.size) return;
      std::string result = bytes_.substr(sizeof header, header.size);
      bytes_.erase(0, sizeof header + header.size);
      if (header.threw) throw std::runtime_error(fmt::format("job {}: {}", header.job, result));
      store.emplace(header.job, std::move(result));
    }
  }

 private:
  void end() {
    close(std::exchange(input_, -1));
    const int status = wait_for_end();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    throw std::runtime_error(WIFSIGNALED(status)
                                 ? fmt::format("a worker was killed by signal {} ({})",
                                               WTERMSIG(status), strsignal(WTERMSIG(status)))
                                 : fmt::format("a worker left by exit({})", WEXITSTATUS(status)));
  }
  int wait_for_end() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }

  pid_t pid_ = -1;
  int input_ = -1;
  std::string bytes_;
};

}  // namespace

void run_jobs(std::size_t first, std::size_t end, int workers, const std::function<JobWork()>& make,
              const std::function<bool(std::size_t job, std::string result)>& take) {
  if (first >= end) return;
  SharedArray<Board> shared(1);
  Board& board = shared[0];
  board.next = first;
  board.taken = first;
  const std::size_t lead = 8 * static_cast<std::size_t>(workers);
  std::vector<Worker> pool;
  pool.reserve(static_cast<std::size_t>(workers));
  for (int i = 0; i < workers; ++i) pool.emplace_back(end, lead, board, make);
  std::map<std::size_t, std::string> store;
  for (std::size_t next = first; next < end;) {
    std::vector<pollfd> waiting;
    std::vector<Worker*> of;
    for (Worker& worker : pool) {
      if (worker.input() < 0) continue;
      waiting.push_back({.fd = worker.input(), .events = POLLIN, .revents = 0});
      of.push_back(&worker);
    }
    if (waiting.empty()) throw std::logic_error("the workers left without doing all jobs");
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "poll");
    }
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      if (waiting[i].revents != 0) of[i]->receive(store);
    }
    for (auto at = store.begin(); at != store.end() && at->first == next; at = store.erase(at)) {
      board.taken = ++next;
      if (!take(at->first, std::move(at->second))) {
        board.stop = true;
        return;  // the pool stops them
      }
    }
  }
}

}  // namespace touchstone
