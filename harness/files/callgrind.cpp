// Reads the head of a file of Callgrind's.
#include "harness/files/callgrind.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>

#include "harness/base/error.h"

namespace touchstone::files {
namespace {

std::ifstream opened(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw base::InputError(file.string(), 0, "cannot be read");
  return stream;
}

}  // namespace

bool is_callgrind(const std::filesystem::path& file) {
  std::ifstream stream = opened(file);
  std::string line;
  std::getline(stream, line);
  return line == "# callgrind format";
}

CallgrindCount read_callgrind(const std::filesystem::path& file) {
  constexpr std::string_view trigger = "desc: Trigger: Client Request: ", command = "cmd: ",
                             sum = "summary: ";
  CallgrindCount count{.name = "", .instructions = -1};
  std::ifstream stream = opened(file);
  for (std::string line; count.instructions < 0 && std::getline(stream, line);) {
    if (line.starts_with(command)) {
      count.name = line.substr(std::min(line.find_first_not_of(" ", command.size()), line.size()));
    }
    if (line.starts_with(trigger)) count.name = line.substr(trigger.size());
    if (line.starts_with(sum)) {
      std::from_chars(line.data() + sum.size(), line.data() + line.size(), count.instructions);
    }
  }
  if (count.name.empty() || count.instructions < 0) {
    throw base::InputError(file.string(), 0, "no file of Callgrind's that has a name and a sum");
  }
  return count;
}

}  // namespace touchstone::files
