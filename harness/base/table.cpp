// Lays out tables.
#include "harness/base/table.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "harness/base/input_file.h"

namespace touchstone::base {
namespace {

// The number of UTF-8 characters, as fmt counts them when it pads a field.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & '\xc0') != '\x80'; }));
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string all = "|";
  for (const std::string& raw : cells) {
    std::string text = printable(raw);
    for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
      text.insert(at, "\\");
    }
    all += " " + text + " |";
  }
  return all + "\n";
}

}  // namespace

std::string Table::text(std::size_t page_width) const {
  std::vector<std::vector<std::string>> rows = rows_;
  for (auto& row : rows) std::ranges::transform(row, row.begin(), printable);
  const std::size_t columns = rows.front().size();
  std::vector<std::size_t> width(columns, 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], characters(row[i]));
  }
  constexpr std::size_t gap = 2;
  std::string text;
  for (std::size_t begin = 1; begin < columns;) {
    std::size_t end = begin;
    std::size_t used = width[0];
    while (end < columns && (end == begin || used + gap + width[end] <= page_width)) {
      used += gap + width[end++];
    }
    if (begin > 1) text += '\n';
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::string line = fmt::format("{:<{}}", rows[r][0], width[0]);
      for (std::size_t i = begin; i < end; ++i) {
        line += fmt::format("{:>{}}", i < rows[r].size() ? rows[r][i] : "", width[i] + gap);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + '\n';
      if (r == 0) text += std::string(used, '-') + '\n';
    }
    begin = end;
  }
  return text;
}

std::string Table::markdown() const {
  std::string rule = "|";
  for (std::size_t i = 0; i < rows_.front().size(); ++i) rule += i < words_ ? "---|" : "---:|";
  std::string all = markdown_row(rows_.front()) + rule + "\n";
  for (std::size_t i = 1; i < rows_.size(); ++i) all += markdown_row(rows_[i]);
  return all;
}

std::string cell(double value) {
  return std::isnan(value) ? std::string("-") : fmt::format("{:.4g}", value);
}

std::size_t page_width() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 &&
      size.ws_col >= 60) {
    return size.ws_col;
  }
  return 120;
}

}  // namespace touchstone::base
