// Tables for a terminal.
#pragma once

#include <string>
#include <vector>

namespace touchstone::base {

// A table with the first column aligned left and the others right. A table wider than the page is
// split into several, each with the first column again.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string text(std::size_t page_width) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

// The terminal's width if standard output is a terminal, else 120 characters.
std::size_t page_width();

}  // namespace touchstone::base
