// Writes Markdown tables and whole text files.
#include "harness/base/markdown.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "harness/base/error.h"

namespace touchstone::base {

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string all = "|";
  for (std::string text : cells) {
    for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
      text.insert(at, "\\");
    }
    all += " " + text + " |";
  }
  return all + "\n";
}

std::string markdown_header(const std::vector<std::string>& names, std::size_t words) {
  std::string rule = "|";
  for (std::size_t i = 0; i < names.size(); ++i) rule += i < words ? "---|" : "---:|";
  return markdown_row(names) + rule + "\n";
}

std::string cell(double value) {
  return std::isnan(value) ? std::string("-") : fmt::format("{:.4g}", value);
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw InputError(file.string(), 0, fmt::format("cannot be written: {}", std::strerror(errno)));
  }
}

}  // namespace touchstone::base
