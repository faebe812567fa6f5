#include "harness/stats/markdown.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "harness/error.h"

namespace touchstone::stats {

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string all = "|";
  for (std::string cell : cells) {
    for (auto at = cell.find('|'); at != std::string::npos; at = cell.find('|', at + 2)) {
      cell.insert(at, "\\");
    }
    all += " " + cell + " |";
  }
  return all + "\n";
}

std::string markdown_header(const std::vector<std::string>& names, std::size_t words) {
  std::string rule = "|";
  for (std::size_t i = 0; i < names.size(); ++i) rule += i < words ? "---|" : "---:|";
  return markdown_row(names) + rule + "\n";
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw InputError(file.string(), 0, fmt::format("cannot be written: {}", std::strerror(errno)));
  }
}

}  // namespace touchstone::stats
