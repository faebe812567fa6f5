// Starts touchstone_read_model, waits for it, and says how it failed.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <thread>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/warning.h"
#include "harness/models/model.h"
#include "harness/models/model_stream.h"

namespace touchstone::models {

namespace fs = std::filesystem;

bool is_model_file(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::find(model_endings, ending) != model_endings.end();
}

namespace {

constexpr std::string_view program_name = "touchstone_read_model";

// A build and an installation have it in the same place, seen from the folder of the program.
fs::path installed_program() {
  const fs::path own = fs::read_symlink("/proc/self/exe");
  return own.parent_path().parent_path() / "lib/touchstone" / program_name;
}

struct Descriptor {
  int number = -1;
  Descriptor() = default;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { shut(); }
  void shut() {
    if (number >= 0) close(number);
    number = -1;
  }
};

struct Pipe {
  Descriptor out, in;
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw base::InputError(fmt::format("a pipe cannot be made: {}", std::strerror(errno)));
    }
    out.number = ends[0];
    in.number = ends[1];
  }
};

struct SpawnActions {
  posix_spawn_file_actions_t actions;
  SpawnActions() { posix_spawn_file_actions_init(&actions); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
};

class Run {
 public:
  Run(const std::string& file, const fs::path& program, const ModelProcess& limits)
      : file_(file), limits_(limits) {
    std::vector<std::string> words = {
        program.string(), file, std::to_string(limits.memory),
        std::to_string(static_cast<std::uint64_t>(std::ceil(limits.seconds)) + 1)};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    SpawnActions files;
    posix_spawn_file_actions_addopen(&files.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files.actions, answer_.in.number, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files.actions, words_.in.number, STDERR_FILENO);
    const int error =
        posix_spawn(&child_, words[0].c_str(), &files.actions, nullptr, argv.data(), environ);
    if (error != 0) {
      child_ = -1;
      throw base::InputError(
          file, 0,
          fmt::format("is read by {}, which cannot be run ({})", words[0], std::strerror(error)));
    }
    answer_.in.shut();
    words_.in.shut();
  }
  ~Run() {
    if (child_ > 0) stop();
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  // What the program wrote, once it ended well.
  std::string answer() {
    while (answer_.out.number >= 0 || words_.out.number >= 0) listen();
    int status = 0;
    while (waitpid(child_, &status, WNOHANG) == 0) {
      left_milliseconds();  // it may have shut its output and go on
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    child_ = -1;
    expect_well(status);
    return std::move(text_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw base::InputError(file_, 0, message);
  }

  void stop() {
    kill(child_, SIGKILL);
    while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
  }

  int left_milliseconds() {
    const double left = limits_.seconds - watch_.seconds();
    if (left > 0) return static_cast<int>(std::min(left * 1000, 1e6)) + 1;
    stop();
    fail(fmt::format("took Assimp more than {} s; expected a file that takes less",
                     limits_.seconds));
  }

  void listen() {
    std::array<pollfd, 2> waiting = {pollfd{answer_.out.number, POLLIN, 0},
                                     pollfd{words_.out.number, POLLIN, 0}};
    if (poll(waiting.data(), waiting.size(), left_milliseconds()) < 0 && errno != EINTR) {
      fail(fmt::format("the pipe from Assimp is lost ({})", std::strerror(errno)));
    }
    if (waiting[0].revents != 0 && !take(answer_.out, text_)) answer_.out.shut();
    if (waiting[1].revents != 0 && !take(words_.out, said_)) words_.out.shut();
    if (text_.size() > limits_.memory) {
      stop();
      fail(fmt::format("Assimp answers more than {} bytes; expected a smaller file",
                       limits_.memory));
    }
    constexpr std::size_t kept = 1000;
    if (said_.size() > kept) said_.resize(kept);
  }

  // False at the end.
  bool take(const Descriptor& from, std::string& to) {
    const ssize_t got = read(from.number, buffer_.data(), buffer_.size());
    if (got > 0) to.append(buffer_.data(), static_cast<std::size_t>(got));
    return got > 0 || (got < 0 && errno == EINTR);
  }

  void expect_well(int status) const {
    const std::string said = said_.empty() ? "" : ": " + base::shortened(said_, 400);
    if (WIFSIGNALED(status)) {
      const int signal = WTERMSIG(status);
      if (signal == SIGXCPU || signal == SIGKILL) {
        fail(fmt::format("Assimp was killed (SIG{}) while it read this file", name_of(signal)));
      }
      fail(fmt::format("Assimp crashed (SIG{}){}; expected a file that it reads", name_of(signal),
                       said));
    }
    switch (WEXITSTATUS(status)) {
      case exit_read: return;
      case exit_no_memory:
        fail(fmt::format("took Assimp more than {} MiB; expected a file that takes less",
                         limits_.memory >> 20));
      case exit_cannot_read: fail("Assimp cannot read it" + said);
      default: fail(fmt::format("Assimp ended with status {}{}", WEXITSTATUS(status), said));
    }
  }

  static std::string name_of(int signal) {
    const char* const name = sigabbrev_np(signal);
    return name == nullptr ? std::to_string(signal) : name;
  }

  std::string file_;
  ModelProcess limits_;
  Pipe answer_, words_;
  base::Stopwatch watch_;
  pid_t child_ = -1;
  std::string text_, said_;
  std::vector<char> buffer_ = std::vector<char>(1 << 16);
};

}  // namespace

Model read_model(const fs::path& path, const ModelProcess& process) {
  const std::string file = path.string();
  base::check_kind(path, "a model (.glb, .gltf, .dae, .fbx or .3ds)");
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw base::InputError(file, 0, "is a pipe; expected a regular file, for a model");
  }
  if (fs::file_size(path, error) > base::largest_file) {
    throw base::InputError(
        file, 0, fmt::format("more than {} bytes; expected at most so many", base::largest_file));
  }
#if defined(TOUCHSTONE_NO_ASSIMP)
  if (process.program.empty()) {
    throw base::InputError(file, 0,
                           "is read by Assimp, which this build lacks: " TOUCHSTONE_NO_ASSIMP);
  }
#endif
  const fs::path program = process.program.empty() ? installed_program() : process.program;
  Model model = parse_model(file, Run(file, program, process).answer());
  for (const std::string& warning : model.warnings) {
    base::warn(file, 0, "Assimp says: " + base::shortened(warning, 200));
  }
  if (model.skinned > 0) {
    base::warn(file, 0,
               fmt::format("{} skinned mesh{}, read in the bind pose", model.skinned,
                           model.skinned == 1 ? "" : "es"));
  }
  return model;
}

}  // namespace touchstone::models
