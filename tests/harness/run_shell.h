// Runs a command of the shell, and keeps what it says.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace touchstone {

struct Ran {
  int status = -1;   // the exit status; -1 if a signal ended it
  std::string text;  // its output, of both streams
};

// Runs a command of the shell.
inline Ran run_shell(const std::string& command) {
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("popen");
  Ran ran;
  std::array<char, 4096> bytes;
  for (std::size_t got; (got = fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) {
    ran.text.append(bytes.data(), got);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) ran.status = WEXITSTATUS(status);
  return ran;
}

}  // namespace touchstone
