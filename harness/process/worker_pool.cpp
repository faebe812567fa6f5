// Hands jobs to forked workers and takes their results in the order of the jobs.
#include "harness/process/worker_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "harness/process/child_process.h"

namespace touchstone::process {
namespace {

constexpr double seconds_to_leave = 10;  // time that a worker has to leave after it hung up

// The header in front of a result's bytes.
struct Header {
  std::size_t job = 0;
  std::size_t size = 0;
};

// The state that all processes share.
struct Board {
  std::atomic<std::size_t> next = 0;  // first job that no worker has begun
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

// Runs in a worker. `at_hand` is the job that it works on.
void do_jobs(int output, std::size_t end, std::size_t lead, Board& board, std::size_t& at_hand,
             const std::function<JobWork()>& make) {
  std::signal(SIGPIPE, SIG_IGN);
  const JobWork work = make();
  for (;;) {
    const std::size_t job = board.next.fetch_add(1);
    if (job >= end) break;
    // Results that wait for an earlier one are held in memory, so their number is limited.
    while (job > board.taken.load() + lead && !board.stop.load()) usleep(1000);
    if (board.stop.load()) break;
    at_hand = job;
    const std::string bytes = work(job);
    const Header header = {job, bytes.size()};
    write_all(output, &header, sizeof header);
    write_all(output, bytes.data(), bytes.size());
  }
  _exit(EXIT_SUCCESS);
}

// One worker, as its parent sees it.
class Worker {
 public:
  Worker(std::size_t end, std::size_t lead, Board& board, const std::function<JobWork()>& make) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
    input_ = ends[0];
    child_ = std::make_unique<ChildProcess>(ChildProcess::Settings{}, [&] {
      close(ends[0]);
      do_jobs(ends[1], end, lead, board, at_hand_[0], make);
    });
    close(ends[1]);
  }
  ~Worker() {
    if (input_ >= 0) close(input_);
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  int input() const { return input_; }  // -1 when the worker has ended
  int words() const { return child_->words(); }
  void listen() { child_->listen(0); }

  // Reads from the worker, and moves complete results to `store`.
  void receive(std::map<std::size_t, std::string>& store) {
    char buffer[1 << 16];
    const ssize_t got = read(input_, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) return;
    if (got <= 0) return end();
    bytes_.append(buffer, static_cast<std::size_t>(got));
    for (Header header; bytes_.size() >= sizeof header;) {
      std::memcpy(&header, bytes_.data(), sizeof header);
      if (bytes_.size() < sizeof header + header.size) return;
      store.emplace(header.job, bytes_.substr(sizeof header, header.size));
      bytes_.erase(0, sizeof header + header.size);
    }
  }

 private:
  void end() {
    close(input_);
    input_ = -1;
    child_->wait(seconds_to_leave);
    const IsolationFailure failure = child_->failure();
    if (failure.state == ItemState::crashed && failure.signal == 0 && failure.exit_code == 0) {
      return;
    }
    throw std::runtime_error(
        fmt::format("job {}: {}", at_hand_[0],
                    failure.state == ItemState::threw ? failure.words : failure.reason()));
  }

  SharedArray<std::size_t> at_hand_{1};
  std::unique_ptr<ChildProcess> child_;
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
  std::vector<std::unique_ptr<Worker>> pool;
  for (int i = 0; i < workers; ++i) {
    pool.push_back(std::make_unique<Worker>(end, lead, board, make));
  }
  std::map<std::size_t, std::string> store;
  for (std::size_t next = first; next < end;) {
    // Each live worker has two descriptors: its results and its output.
    std::vector<pollfd> waiting;
    std::vector<Worker*> of;
    for (const std::unique_ptr<Worker>& worker : pool) {
      if (worker->input() < 0) continue;
      waiting.push_back({.fd = worker->input(), .events = POLLIN, .revents = 0});
      waiting.push_back({.fd = worker->words(), .events = POLLIN, .revents = 0});
      of.push_back(worker.get());
    }
    if (waiting.empty()) throw std::logic_error("the workers left without doing all jobs");
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "poll");
    }
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (waiting[2 * i + 1].revents != 0) of[i]->listen();
      if (waiting[2 * i].revents != 0) of[i]->receive(store);
    }
    for (auto at = store.begin(); at != store.end() && at->first == next; at = store.erase(at)) {
      board.taken = ++next;
      if (!take(at->first, std::move(at->second))) {
        board.stop = true;
        return;  // the pool stops the workers
      }
    }
  }
}

}  // namespace touchstone::process
