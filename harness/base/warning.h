// Warnings: faults of input that do not end a command.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <set>
#include <string>

namespace touchstone::base {

// Prints "FILE:LINE: warning: MESSAGE" to standard error, or "FILE: warning: MESSAGE" if line is 0; once for each such
// line in a process, which may read a file several times, and at most a thousand of them.
inline void warn(const std::string& file, std::int64_t line, const std::string& message) {
  static std::mutex mutex;
  static std::set<std::string> printed;
  const std::string text =
      fmt::format("{}:{} warning: {}\n", file, line > 0 ? fmt::format("{}:", line) : "", message);
  const std::lock_guard lock(mutex);
  constexpr std::size_t most = 1000;
  if (printed.size() < most && printed.insert(text).second) fmt::print(stderr, "{}", text);
}

}  // namespace touchstone::base
