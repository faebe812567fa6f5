// A program behind two pipes. A process of its own watches it, ends it with all that it started, and limits its memory.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "harness/peer/use.h"

namespace touchstone::peer {

// The program ended, or was ended; the text says how.
class ProgramEnded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What is run, and where.
struct Program {
  std::string command;           // for the shell
  std::filesystem::path folder;  // in which it runs; the current one if empty
};

struct ProgramLimits {
  std::size_t memory = std::size_t{4} << 30;  // bytes of all its processes
  std::size_t line = std::size_t{1} << 20;    // bytes of an answer
  Use* use = nullptr;                         // where its start and its memory are counted
};

class PeerProcess {
 public:
  static constexpr double no_limit = std::numeric_limits<double>::infinity();

  // Starts the program in a process group of its own. What it writes to standard error goes where that of this process
  // goes. Throws std::system_error.
  explicit PeerProcess(const Program& program, const ProgramLimits& limits = {});
  ~PeerProcess();  // ends the program
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  // Writes the text, and returns the next `count` lines of the program, which are read while the text is written. Throws
  // ProgramEnded if there will not be so many, or not within so many seconds, and process::Garbage for a line that is too
  // long.
  std::vector<std::string> exchange(std::string_view text, std::size_t count,
                                    double seconds = no_limit);
  // Returns the next `count` bytes behind the lines that were read. Throws ProgramEnded if there will not be so many.
  std::string bytes(std::size_t count);

 private:
  void take_lines(std::vector<std::string>& lines, std::size_t count);
  bool read_some();
  void end();
  [[noreturn]] void throw_ended();

  ProgramLimits limits_;
  pid_t watcher_ = -1;
  int input_ = -1, output_ = -1;  // of the program
  int life_ = -1;                 // the watcher ends the program when this is closed
  int report_ = -1;               // where the watcher writes how the program ended
  std::string buffer_;            // what was read, and is no whole line yet
  std::size_t searched_ = 0;      // bytes of the buffer without a line break
};

}  // namespace touchstone::peer
