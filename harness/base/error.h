// Faults of requests and input, reported to the user with their place.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace touchstone::base {

// A fault of the request or of an input file. main() prints the message and exits with status 2;
// nothing has been written by then, because readers check a whole file before anything uses it.
class InputError : public std::runtime_error {
 public:
  // A fault of the command line: "the value found; the value expected".
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  // A fault at a place in a file: "FILE:LINE: message", or "FILE: message" if line is 0.
  InputError(const std::string& file, std::int64_t line, const std::string& message)
      : std::runtime_error(file + ":" + (line > 0 ? std::to_string(line) + ":" : "") + " " +
                           message) {}
};

}  // namespace touchstone::base
