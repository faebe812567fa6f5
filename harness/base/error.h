// Wrong requests and wrong input, told to the user with their place.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace touchstone {

// The request or an input file is wrong. main() prints the message and exits with status 2; nothing
// has been written by then. Readers check all of a file before anything is made of it.
class InputError : public std::runtime_error {
 public:
  // "what was found; what was expected", for a fault of the command line.
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  // The same for a place in a file: "FILE:LINE: message", or "FILE: message" where line is 0.
  InputError(const std::string& file, std::int64_t line, const std::string& message)
      : std::runtime_error(file + ":" + (line > 0 ? std::to_string(line) + ":" : "") + " " +
                           message) {}
};

}  // namespace touchstone
