// Forks a worker and exchanges requests and replies with it.
#include "harness/measure/worker.h"

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

#include "harness/base/clock.h"
#include "harness/base/random.h"
#include "harness/measure/hardware_counters.h"
#include "harness/measure/noise.h"

namespace touchstone::measure {
namespace {

constexpr int tick_milliseconds = 20;
// Seconds until a worker that closed its line must have ended.
constexpr double seconds_to_leave = 2;

// The heap, the mappings and the stack begin at a different place in each process, as they do from
// one start of a program to the next; otherwise forked workers would all have their parent's
// layout. (Mytkowicz, Diwan, Hauswirth, Sweeney, "Producing wrong data without doing anything
// obviously wrong!", ASPLOS 2009.)
class Layout {
 public:
  explicit Layout(base::Random& random) {
    for (int i = 0; i < 64; ++i) {
      const std::size_t size = 16 + 16 * random.below(512);
      kept_.emplace_back(size, '\1');
    }
    for (std::size_t i = 0; i < kept_.size(); i += 2) kept_[i] = {};  // makes holes
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    static_cast<void>(mmap(nullptr, page * (1 + random.below(256)), PROT_NONE,
                           MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  }

 private:
  std::vector<std::vector<char>> kept_;
};

// Calls `work` that many bytes further down the stack.
[[gnu::noinline]] void deeper(std::size_t bytes, const std::function<void()>& work) {
  volatile char* const room = static_cast<char*>(__builtin_alloca(bytes + 16));
  room[0] = 0;
  work();
  room[bytes] = 0;
}

// The system's counts for this process between `start` and `finish`.
class Usage {
 public:
  // The files are opened before the process is made undumpable, which hides them.
  Usage()
      : clear_(open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC)),
        status_(open("/proc/self/status", O_RDONLY | O_CLOEXEC)) {}

  // The memory in use now belongs to the harness; peaks are counted beyond it.
  void be_empty() {
#if defined(__GLIBC__)
    malloc_trim(0);  // otherwise the algorithm would use memory that the harness has freed
#endif
    own_kb_ = status().anonymous;
  }
  void start() {
    // This write restarts the peak (proc(5), clear_refs).
    can_reset_ = clear_ >= 0 && write(clear_, "5", 1) == 1;
    getrusage(RUSAGE_SELF, &before_);
    delay_ = run_delay();
    hardware_.start();
  }
  void finish(SampleReply& reply) const {
    reply.hardware = hardware_.counts();
    if (const auto delay = run_delay(); delay && delay_) reply.waited = *delay - *delay_;
    rusage after{};
    getrusage(RUSAGE_SELF, &after);
    reply.minor_faults = after.ru_minflt - before_.ru_minflt;
    reply.voluntary_switches = after.ru_nvcsw - before_.ru_nvcsw;
    reply.involuntary_switches = after.ru_nivcsw - before_.ru_nivcsw;
    if (!can_reset_ || own_kb_ < 0) return;
    const Status now = status();
    // The peak is that of all pages; the pages of files, programs among them, only ever grow.
    if (now.peak >= 0) {
      reply.peak_kb = std::max<std::int64_t>(now.peak - now.files - now.shared - own_kb_, 0);
    }
  }

 private:
  struct Status {  // kilobytes resident; -1 if the system does not report it
    std::int64_t peak = -1, anonymous = -1, files = 0, shared = 0;
  };
  Status status() const {
    std::array<char, 4096> text;
    const ssize_t got = status_ < 0 ? -1 : pread(status_, text.data(), text.size(), 0);
    if (got <= 0) return {};
    const std::string_view all(text.data(), static_cast<std::size_t>(got));
    Status status;
    take(all, "VmHWM:", status.peak);
    take(all, "RssAnon:", status.anonymous);
    take(all, "RssFile:", status.files);
    take(all, "RssShmem:", status.shared);
    return status;
  }
  static void take(std::string_view all, std::string_view key, std::int64_t& value) {
    const std::size_t at = all.find(key);
    if (at == std::string_view::npos) return;
    const std::size_t digits = all.find_first_of("0123456789", at);
    if (digits != std::string_view::npos) {
      std::from_chars(all.data() + digits, all.data() + all.size(), value);
    }
  }

  int clear_, status_;
  bool can_reset_ = false;
  std::int64_t own_kb_ = -1;
  rusage before_{};
  std::optional<double> delay_;
  HardwareCounters hardware_;
};

void serve(int line, const Worker::Make& make, Usage& usage) {
  usage.be_empty();
  const std::unique_ptr<Sampler> sampler = make();
  SampleReply reply;  // the first reply says that the sampler is made
  for (;;) {
    if (send(line, &reply, sizeof reply, MSG_NOSIGNAL) < 0) return;
    SampleRequest request;
    ssize_t got = 0;
    do {
      got = recv(line, &request, sizeof request, 0);
    } while (got < 0 && errno == EINTR);
    if (got != sizeof request) return;
    usage.start();
    reply = sampler->sample(request);
    usage.finish(reply);
    come_to_rest();
  }
}

// The work of the worker's process, in a memory layout of its own.
void be_worker(int line, const Worker::Make& make, const WorkerSettings& settings, Usage& usage) {
  base::Random random(settings.layout);
  const Layout layout(random);
  deeper(16 * random.below(1024), [&] { serve(line, make, usage); });
  _exit(EXIT_SUCCESS);
}

}  // namespace

Worker::Worker(const Make& make, const WorkerSettings& settings) {
  process::expect_one_thread();
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::system_error(errno, std::generic_category(), "socketpair");
  }
  line_ = ends[0];
  std::optional<Usage> usage;  // the usage of the child
  child_ = std::make_unique<process::ChildProcess>(
      process::ChildProcess::Settings{.memory = settings.memory,
                                      .before = [&] { usage.emplace(); }},
      [&] {
        ::close(ends[0]);
        be_worker(ends[1], make, settings, *usage);
      });
  ::close(ends[1]);
}

Worker::~Worker() { ::close(line_); }

std::optional<process::IsolationFailure> Worker::wait_until_made(double seconds) {
  if (wait(seconds)) return {};
  failure_.in_setup = true;
  return failure_;
}

std::optional<SampleReply> Worker::ask(const SampleRequest& request, double seconds) {
  if (!alive()) return {};
  if (send(line_, &request, sizeof request, MSG_NOSIGNAL) < 0) {
    end(false);
    return {};
  }
  return wait(seconds);
}

std::optional<SampleReply> Worker::wait(double seconds) {
  const base::Stopwatch watch;
  while (watch.seconds() <= seconds) {
    std::array<pollfd, 2> sources = {{{.fd = line_, .events = POLLIN, .revents = 0},
                                      {.fd = child_->words(), .events = POLLIN, .revents = 0}}};
    if (poll(sources.data(), sources.size(), tick_milliseconds) <= 0) continue;
    if (sources[1].revents != 0) child_->listen(0);
    if (sources[0].revents == 0) continue;
    SampleReply reply;
    const ssize_t got = recv(line_, &reply, sizeof reply, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got == sizeof reply) return reply;
    end(false);
    return {};
  }
  end(true);
  return {};
}

// A worker that closed its line has ended or is about to, unless it closed the line by mistake.
void Worker::end(bool late) {
  if (late) {
    child_->stop();
  } else {
    child_->wait(seconds_to_leave);
  }
  failure_ = child_->failure();
}

}  // namespace touchstone::measure
